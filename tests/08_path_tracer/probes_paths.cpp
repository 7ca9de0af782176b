// Probes of lab 8's exercises 8.4 and 8.6 to 8.8: paths through whole worlds.

#include "08_path_tracer/views.h"
#include "grader/worker/probe.h"
#include "path_tracer.h"
#include "random/rng.h"

#include <cmath>
#include <map>

using namespace lab08_tests;
using carlo::grader::Params;
using carlo::grader::RowWriter;

namespace {

void add(RowWriter& rows, Rgb c) {
  rows.add({number(c.r), number(c.g), number(c.b)});
}

Rgb rgb(const Params& params) {
  return {static_cast<float>(params["r"]), static_cast<float>(params["g"]),
          static_cast<float>(params["b"])};
}

/// A world and the ray that looks into it.
struct View {
  carlo::Scene scene;
  carlo::Ray ray;
};

View view_of(const Params& params) {
  const carlo::Ray inside{{0, 0, 1}, {0.6f, 0, -0.8f}};
  const auto degrees = static_cast<float>(params["degrees"]);
  const carlo::Ray at_centre{{0, 0, 1.5f}, glm::normalize(Vec3(0.2f, 0, -1))};
  const carlo::Ray down{{0.3f, 0, 0.9f}, glm::normalize(Vec3(-0.3f, 0, -0.9f))};
  const carlo::Ray low{{-0.9f, 0, 0.3f}, glm::normalize(Vec3(0.9f, 0, -0.3f))};
  switch (static_cast<Place>(params.whole("place"))) {
    case in_furnace:
      return {furnace(rgb(params)), inside};
    case with_glass:
      return {furnace_with_glass(rgb(params)), inside};
    case on_ball:
      return {ball({carlo::Phong{Rgb(static_cast<float>(params["kd"])),
                                 Rgb(static_cast<float>(params["ks"])),
                                 static_cast<float>(params["exponent"])},
                    false}),
              towards_pole(degrees)};
    case on_floor:
      return {light_scene(static_cast<Light>(params.whole("light"))), down};
    case mirror_ball:
      return {ball({carlo::Mirror{rgb(params)}, false}), towards_pole(degrees)};
    case glass_ball:
      return {ball({carlo::Dielectric{1.5f, 1}, false}), towards_pole(degrees)};
    case in_mirrors: {
      carlo::Scene scene = furnace(Rgb(0));
      scene.materials[0].model = carlo::Mirror{rgb(params)};
      return {scene, inside};
    }
    case behind_glass:
      return {furnace_with_glass(Rgb(0)), at_centre};
    case wall_in_mirror:
      return {furnace_with_mirror(rgb(params)), at_centre};
    case by_mirror:
      return {mirrored_light(), low};
    case by_pane:
      return {light_behind_pane(), low};
  }
  return {};
}

/// Independent numbers that record reads: how often each place was read, and how many reads were
/// not where a vertex has its numbers.
class NotedDimensions final : public lab08::Dimensions {
 public:
  explicit NotedDimensions(carlo::Rng& rng) : rng_(&rng) {}
  void seek(unsigned place) override { place_ = place; }
  float next_1d() override {
    read(place_++);
    return rng_->uniform_float();
  }
  lab08::Vec2 next_2d() override {
    const float x = next_1d();
    const float y = next_1d();
    return {x, y};
  }

  double read_twice() const { return twice_; }
  double read_on_film() const { return film_; }
  double reads() const { return static_cast<double>(read_.size()); }

 private:
  void read(unsigned place) {
    twice_ += read_[place]++ == 1 ? 1 : 0;
    film_ += place < lab08::film_dimensions ? 1 : 0;
  }
  carlo::Rng* rng_;
  unsigned place_ = 0;
  std::map<unsigned, int> read_;
  double twice_ = 0, film_ = 0;
};

}  // namespace

PROBE("Lab 8.4 p_emit", "reflects", "emits", "does both", "both, in other channels", "neither",
      "emits and is glossy") {
  RowWriter rows;
  const auto ask = [&](carlo::Scene scene, Rgb emitted) {
    scene.shapes[0].radiance = emitted;
    const lab08::World world(std::move(scene));
    const auto surface = world.intersect({{0, 0, 0}, {0, 0, 1}});
    rows.add({surface ? number(lab08::p_emit(*surface)) : -1});
  };
  ask(furnace(Rgb(0.5f)), Rgb(0));
  ask(furnace(Rgb(0)), Rgb(1));
  ask(furnace(Rgb(0.5f)), Rgb(1));
  ask(furnace({0, 0, 0.1f}), {0, 0.2f, 0});
  ask(furnace(Rgb(0)), Rgb(0));
  carlo::Scene glossy = furnace(Rgb(0));
  glossy.materials[0].model = carlo::Phong{Rgb(0), Rgb(0.5f), 10};
  ask(glossy, Rgb(1));
  return rows.take();
}

// `method`: 0 the lecture's, 1 corrected (8.4); 2 direct (8.6); 3 specular (8.7).
PROBE("Lab 8 paths", "red", "green", "blue") {
  const View view = view_of(params);
  const lab08::World world(view.scene);
  carlo::Rng rng(params.seed);
  const bool with_emission = params.whole("emission") == 1;
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    switch (params.whole("method")) {
      case 0:
        add(rows, lab08::trace_path_lecture(world, view.ray, rng));
        break;
      case 1:
        add(rows, lab08::trace_path(world, view.ray, rng));
        break;
      case 2:
        add(rows, lab08::trace_direct(world, view.ray, with_emission, rng));
        break;
      default:
        add(rows, lab08::trace_specular(world, view.ray, with_emission, rng));
    }
  }
  return rows.take();
}

PROBE("Lab 8.7 fresnel", "reflectance") {
  return {1,
          {number(lab08::fresnel(static_cast<float>(params["cos"]),
                                 static_cast<float>(params["eta"])))}};
}

// The refracted direction of light at this angle in the plane of x and z; 0 if there is none.
PROBE("Lab 8.7 refract", "is refracted", "wt.x", "wt.y", "wt.z") {
  const auto degrees = static_cast<float>(params["degrees"]) * 3.14159265f / 180;
  const Vec3 wo(std::sin(degrees), 0, std::cos(degrees));
  const auto wt = lab08::refract({0, 0, 1}, wo, static_cast<float>(params["eta"]));
  return {4, wt ? std::vector<double>{1, number(wt->x), number(wt->y), number(wt->z)}
                : std::vector<double>{0, 0, 0, 0}};
}

// A surface as met by a ray from above, or from inside.
PROBE("Lab 8.7 specular", "wi.x", "wi.y", "wi.z", "weight.r", "weight.g", "weight.b", "pdf",
      "(row 1: the mirror; then glass, for u = 1/128, 3/128, 5/128 and so on)") {
  const carlo::Dielectric glass{1.5f, 1};
  const carlo::Mirror mirror{{0.5f, 0.6f, 0.7f}};
  const float degrees = static_cast<float>(params["degrees"]) * 3.14159265f / 180;
  lab08::Surface surface{{0, 0, 0}, {0, 0, 1}, {std::sin(degrees), 0, std::cos(degrees)},
                         Rgb(0),    nullptr,   params.whole("front") == 1,
                         {}};
  RowWriter rows;
  const auto write = [&](const lab08::BsdfSample& next) {
    rows.add({number(next.wi.x), number(next.wi.y), number(next.wi.z), number(next.weight.r),
              number(next.weight.g), number(next.weight.b), number(next.pdf)});
  };
  write(lab08::sample_mirror(mirror, surface));
  for (int i = 0; i < 64; ++i)
    write(lab08::sample_glass(glass, surface, (static_cast<float>(i) + 0.5f) / 64));
  return rows.take();
}

PROBE("Lab 8.8 heuristic", "weight") {
  // JSON has no infinity: -1 stands for it.
  const auto q = params["q"] < 0 ? HUGE_VALF : static_cast<float>(params["q"]);
  return {1, {number(lab08::power_heuristic(static_cast<float>(params["p"]), q))}};
}

// The density at the floor's origin of the points that rays in a few directions meet; and the same
// from the geometry alone: distance^2, cosine at the hit, its area if it is a light, and the
// probability of choosing that.
PROBE("Lab 8.8 light pdf", "light_pdf", "distance^2", "cosine there", "area of the light", "chance",
      "(a row a ray from the floor; area 0: it meets no light)") {
  const lab08::World world(light_scene(static_cast<Light>(params.whole("light"))));
  const auto from = world.intersect({Vec3(0.3f, 0, 0.9f), glm::normalize(Vec3(-0.3f, 0, -0.9f))});
  RowWriter rows;
  for (int i = 0; from && i < 40; ++i) {
    const Vec3 d = glm::normalize(
        Vec3(0.04f * static_cast<float>(i) - 0.8f, 0.02f * static_cast<float>(i % 7), 1));
    const auto to = world.intersect(world.leave(*from, d));
    if (!to) {
      rows.add({0, 1, 1, 0, 1});
      continue;
    }
    const lab08::Light* light = world.light_of(*to);
    const Vec3 way = to->p - from->p;
    const bool emits = light != nullptr && to->front;
    rows.add({number(lab08::light_pdf(world, *from, *to)), number(glm::dot(way, way)),
              number(glm::dot(to->n, to->wo)), emits ? number(light->area()) : 0,
              light != nullptr ? number(light->chance()) : 1});
  }
  return rows.take();
}

PROBE("Lab 8.8 paths", "red", "green", "blue", "numbers read twice", "read on the film",
      "numbers read") {
  const View view = view_of(params);
  const lab08::World world(view.scene);
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    NotedDimensions dimensions(rng);
    const Rgb L =
        lab08::path_radiance(world, view.ray, static_cast<int>(params.whole("depth")), dimensions);
    rows.add({number(L.r), number(L.g), number(L.b), dimensions.read_twice(),
              dimensions.read_on_film(), dimensions.reads()});
  }
  return rows.take();
}
