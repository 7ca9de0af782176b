#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "numeric/robust.h"
#include "numeric/vec.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

// The floor under lights and beside objects that hide the sky, by every technique.

namespace lab07 {
namespace {

using carlo::Vec2;
using carlo::Vec3;

/// A floor, z = 0 with normal +z, seen from above, with an object over it. The irradiance or
/// ambient occlusion of every point is known in closed form.
struct Scene {
  std::string name, note;
  bool light = true;    ///< the object shines with radiance 1; otherwise it hides the sky
  float half_size = 1;  ///< the image shows [-half_size, half_size]^2
  /// True if the ray from the floor's point p along wi meets the object.
  std::function<bool(Vec3 p, Vec3 wi)> hit;
  /// The irradiance of light, or the ambient occlusion, at p.
  std::function<double(Vec3 p)> exact;
  Vec3 centre{0};    ///< of the light,
  float radius = 0;  ///< and its size
};

using carlo::pi;

bool hits_ball(Vec3 centre, float radius, Vec3 p, Vec3 wi) {
  const Vec3 to_centre = centre - p;
  const float along = glm::dot(to_centre, wi);
  const Vec3 off = to_centre - along * wi;
  return along > 0 && glm::dot(off, off) < radius * radius;
}

bool hits_disk(Vec3 centre, float radius, Vec3 p, Vec3 wi) {
  if (!(wi.z > 0)) return false;
  const Vec3 at = p + (centre.z - p.z) / wi.z * wi - centre;
  return at.x * at.x + at.y * at.y < radius * radius;
}

/// True if the ray meets the wall x = -1, of height 1, that runs from y = -1 to 1.
bool hits_wall(Vec3 p, Vec3 wi) {
  if (!(wi.x < 0)) return false;
  const float t = (-1 - p.x) / wi.x;
  return p.z + t * wi.z < 1 && std::abs(p.y + t * wi.y) < 1;
}

Vec3 swapped(Vec3 v) {
  return {v.y, v.x, v.z};
}

/// The irradiance from a ball of radiance 1, entirely above the horizon: pi cos(theta) / H^2, with
/// H its distance in radii.
double ball_irradiance(Vec3 centre, double radius, Vec3 p) {
  const glm::dvec3 d = glm::dvec3(centre) - glm::dvec3(p);
  const double distance = glm::length(d);
  return pi * d.z / distance * (radius / distance) * (radius / distance);
}

/// The irradiance from a parallel disk.
double disk_irradiance(Vec3 centre, double radius, Vec3 p) {
  const glm::dvec3 d = glm::dvec3(centre) - glm::dvec3(p);
  const double offset2 = d.x * d.x + d.y * d.y, r2 = radius * radius, a = offset2 + d.z * d.z;
  return pi / 2 * (1 - (a - r2) / std::sqrt((a + r2) * (a + r2) - 4 * r2 * offset2));
}

/// The irradiance from a wall of height 1 and this width, at this distance from a point in front of
/// its edge.
double wall_irradiance(double distance, double width) {
  const double x = 1 / width, y = distance / width, r = std::hypot(x, y);
  return 0.5 * (std::atan(1 / y) - y / r * std::atan(1 / r));
}

double two_walls_irradiance(Vec3 p) {
  const double x = p.x, y = p.y;
  return wall_irradiance(x + 1, 1 + y) + wall_irradiance(x + 1, 1 - y) +
         wall_irradiance(y + 1, 1 + x) + wall_irradiance(y + 1, 1 - x);
}

/// A round light under the ceiling; a glowing ball; a ball that lies on the floor; two walls.
std::vector<Scene> scenes() {
  const Vec3 light(0, 0, 1), ball(0.2f, -0.2f, 1), stone(0, 0, 0.5f);
  constexpr float light_radius = 0.6f, ball_radius = 0.25f, stone_radius = 0.5f;
  return {
      {"Round light", "Irradiance under a disk of radius 0.6 at height 1", true, 2,
       [=](Vec3 p, Vec3 wi) { return hits_disk(light, light_radius, p, wi); },
       [=](Vec3 p) { return disk_irradiance(light, light_radius, p); }, light, light_radius},
      {"Glowing ball", "Irradiance under a ball of radius 0.25 at height 1", true, 2,
       [=](Vec3 p, Vec3 wi) { return hits_ball(ball, ball_radius, p, wi); },
       [=](Vec3 p) { return ball_irradiance(ball, ball_radius, p); }, ball, ball_radius},
      {"Ball on the floor", "Ambient occlusion by a ball of radius 0.5 that touches the floor",
       false, 1.5f, [=](Vec3 p, Vec3 wi) { return hits_ball(stone, stone_radius, p, wi); },
       [=](Vec3 p) { return 1 - ball_irradiance(stone, stone_radius, p) / pi; }, stone,
       stone_radius},
      {"Two walls",
       "Ambient occlusion in a corner, walls of height 1",
       false,
       1,
       [](Vec3 p, Vec3 wi) { return hits_wall(p, wi) || hits_wall(swapped(p), swapped(wi)); },
       [](Vec3 p) { return 1 - two_walls_irradiance(p) / pi; },
       {},
       0},
  };
}

constexpr int size = 96;

Vec3 floor_point(const Scene& scene, int column, int row) {
  const auto place = [&](int i) {
    return scene.half_size * (2 * (static_cast<float>(i) + 0.5f) / size - 1);
  };
  return {place(column), -place(row), 0};
}

struct Method {
  std::string name;
  Technique technique;
  /// How to sample at p.
  std::function<Sampling(const Scene& scene, Vec3 p)> at;
};

/// A lobe that points at the light and falls to 1/e at its rim; without a light one with n = 2
/// around the normal.
Sampling lobe_for(const Scene& scene, Vec3 p) {
  if (!scene.light) return {Technique::lobe, {0, 0, 1}, 2};
  const Vec3 to_light = scene.centre - p;
  const float ratio = glm::length(to_light) / scene.radius;
  const Vec3 w = glm::normalize(to_light);
  return {Technique::lobe, {-w.x, -w.y, w.z}, 2 * ratio * ratio};
}

std::vector<Method> methods() {
  const auto plain = [](Technique technique) {
    return [technique](const Scene&, Vec3) { return Sampling{technique}; };
  };
  return {{"uniform, by rejection", Technique::rejection, plain(Technique::rejection)},
          {"uniform, by inversion", Technique::uniform, plain(Technique::uniform)},
          {"cosine-weighted", Technique::cosine, plain(Technique::cosine)},
          {"lobe", Technique::lobe, lobe_for}};
}

std::vector<double> exact_image(const Scene& scene) {
  std::vector<double> image;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column)
      image.push_back(scene.exact(floor_point(scene, column, row)));
  }
  return image;
}

std::vector<double> render(const Scene& scene, const Method& method, std::int64_t count,
                           carlo::Rng rng) {
  constexpr Vec3 normal{0, 0, 1};
  std::vector<double> image;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const Vec3 p = floor_point(scene, column, row);
      const Sampling sampling = method.at(scene, p);
      if (scene.light) {
        const Radiance radiance = [&](Vec3 wi) { return scene.hit(p, wi) ? 1.0f : 0.0f; };
        image.push_back(irradiance(radiance, normal, sampling, count, rng));
      } else {
        const Visible visible = [&](Vec3 wi) { return !scene.hit(p, wi); };
        image.push_back(ambient_occlusion(visible, normal, sampling, count, rng));
      }
    }
  }
  return image;
}

/// Root mean square error over the image, relative to its mean.
double relative_error(const std::vector<double>& image, const std::vector<double>& exact) {
  double sum = 0, mean = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    sum += (image[i] - exact[i]) * (image[i] - exact[i]);
    mean += exact[i];
  }
  const auto n = static_cast<double>(image.size());
  return std::sqrt(sum / n) / (mean / n);
}

struct Result {
  Curve curve;
  std::vector<double> shown;  ///< the image of `shown_count` directions
  Measurement shown_run;
};

constexpr std::int64_t shown_count = 16;

Result measure(Notebook& notebook, const Scene& scene, const Method& method,
               const std::vector<double>& exact) {
  Result result{{method.name, {}}, {}, {}};
  for (const std::int64_t count : carlo::ladder(1, notebook.options().n / 1024)) {
    std::vector<double> image;
    double seconds = INFINITY;
    // Short renders are timed by the best of several.
    for (int round = 0; round < (count <= shown_count ? 4 : 1); ++round) {
      const carlo::Stopwatch watch;
      image = render(scene, method, count, notebook.rng());
      const double spent = watch.seconds();
      seconds = std::min(seconds, spent);
    }
    double mean = 0;
    for (const double value : image)
      mean += value / static_cast<double>(image.size());
    result.curve.runs.push_back({count, mean, relative_error(image, exact), seconds});
    if (count > shown_count) continue;
    result.shown = std::move(image);
    result.shown_run = result.curve.runs.back();
  }
  return result;
}

/// The closed form and each technique's result, with the same scale of grey.
std::string pictures_of(const Scene& scene, const std::vector<double>& exact,
                        const std::vector<Result>& results) {
  const double white = scene.light ? *std::max_element(exact.begin(), exact.end()) : 1;
  const auto picture = [&](const std::string& title, const std::string& note,
                           const std::vector<double>& image) {
    return carlo::image_tile(title, note, carlo::grey_image(image, size), white);
  };
  std::vector<std::string> row = {
      picture("exact", scene.light ? "irradiance" : "ambient occlusion", exact)};
  for (const Result& r : results) {
    row.push_back(picture(r.curve.name,
                          fmt::format("{} directions: error {} %, {}", r.shown_run.points,
                                      carlo::number_text(100 * r.shown_run.error, 3),
                                      carlo::duration_text(r.shown_run.seconds)),
                          r.shown));
  }
  return carlo::tiles(row, 11);
}

void add_rows(carlo::Table& table, const Scene& scene, const std::vector<Result>& results) {
  for (const Result& r : results) {
    const Measurement& last = r.curve.runs.back();
    table.add_row({scene.name, r.curve.name, last.points, last.estimate, last.error,
                   carlo::seconds_cell(last.seconds), 1 / (last.error * last.error * last.seconds),
                   slope_cell(r.curve.against_points()), slope_cell(r.curve.against_seconds())});
  }
}

}  // namespace

void images_experiment(Notebook& notebook) {
  notebook.begin("Irradiance and ambient occlusion");
  notebook.say(
      "A floor seen from above, 96 x 96 points, each with its own directions. A light gives "
      "irradiance, things that hide the sky give ambient occlusion; closed forms are known for all "
      "four, so errors are errors. The lobe points at the light, and has fallen to 1/e at its rim; "
      "under the sky it stands upright with n = 2. Seconds are the processor's, of one thread.");
  carlo::Table table({"scene", "technique", "directions", "mean", "relative error", "time",
                      "1/(error² time)", "slope against N", "slope against time"},
                     {"scene", "technique", "directions", "mean", "error", "seconds", "efficiency",
                      "slope_points", "slope_seconds"});
  std::vector<std::pair<std::string, std::vector<Curve>>> charts;
  const std::vector<Scene> all = scenes();
  double done = 0;
  for (const Scene& scene : all) {
    const std::vector<double> exact = exact_image(scene);
    std::vector<Result> results;
    for (const Method& method : methods()) {
      notebook.progress(done++, 4 * static_cast<double>(all.size()));
      notebook.attempt([&] { results.push_back(measure(notebook, scene, method, exact)); });
    }
    if (results.empty()) continue;
    add_rows(table, scene, results);
    notebook.raw_html(fmt::format("<h3>{}</h3>\n<p>{}.</p>\n", scene.name, scene.note) +
                      pictures_of(scene, exact, results));
    std::vector<Curve> curves;
    for (const Result& r : results)
      curves.push_back(r.curve);
    notebook.charts(carlo::error_charts(scene.name, "relative RMS error of the image", curves));
  }
  notebook.table("images", table, "Images of the most directions: error, cost and slopes");
}

}  // namespace lab07
