// Reported standard errors against the spread between seeds, for whole renders as users make them:
// with paths from the camera, and with additional light paths, where one path reaches many
// pixels; with equal numbers of samples, and with --target-error.
//
// Two quotients are judged for each scene: for pixels, sqrt(E[se^2] / Var) with both relative to
// the pixel's luminance and averaged over pixels; and for the image's mean. Independent samples:
// within 10 % of 1. Sobol' points: not below .9, since their standard errors are upper bounds. The
// quotient's own error comes from leaving out one seed at a time; a scene fails if the quotient is
// outside by three of these errors (probability 1 in 700 for one exactly at the limit, and almost
// none for one that is right; a quotient of .8 with an error of .02 is always detected). Quotients
// that are not known to 5 % are printed but not judged: the variance of a few pixels with a rare,
// bright path.
//
// CARLO_ERROR_SEEDS: the number of seeds, instead of 100. CARLO_ERROR_SEEDS_ONLY: only scenes with
// this in their name.

#include "course/render/report.h"
#include "lab_scenes.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/production/adaptive.h"
#include "scene/needs.h"
#include "scene/sampler_kind.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace scene_tools;
using renderer::Technique;

constexpr int side = 32;
constexpr std::size_t pixels = std::size_t{side} * side, whole_image = pixels;

/// Value and squared standard error of each pixel, followed by those of the image's mean: in
/// luminance for pixels, since the errors of their channels are correlated.
using Render = std::vector<std::array<double, 2>>;

struct Way {
  const char* name;
  Technique technique;
  std::optional<double> target = {};
  renderer::Guidance guidance = renderer::Guidance::none;
  bool share = false;
};
const std::array<Way, 8> ways{
    {{"path", Technique::path},
     {"bidirectional", Technique::bidirectional},
     {"path to target", Technique::path, 0.2},
     {"both to target", Technique::bidirectional, 0.2},
     {"guided", Technique::path, {}, renderer::Guidance::always},
     {"both, guided", Technique::bidirectional, {}, renderer::Guidance::always},
     {"shared", Technique::path, {}, renderer::Guidance::none, true},
     {"guided, shared", Technique::path, {}, renderer::Guidance::always, true}}};

Render one_render(const Scene& scene, const Way& way, std::uint64_t seed, std::uint32_t spp = 64) {
  const auto integrator = renderer::make_path_integrator(scene, {.seed = seed,
                                                                 .spp = spp,
                                                                 .technique = way.technique,
                                                                 .guidance = way.guidance,
                                                                 .choices = {.share = way.share}});
  const RenderResult result =
      way.target
          ? render_adaptively(*integrator, side, side, {*way.target, spp, {}}, {.progress = false})
          : render(*integrator, side, side, {.spp = spp, .progress = false});
  Render all;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      all.push_back({result.film.mean(x, y, 1), result.film.variance(x, y, 1)});
  }
  const MeanRadiance mean = mean_of(result);
  all.push_back({mean.value[1], mean.standard_error[1] * mean.standard_error[1]});
  return all;
}

/// Sums over seeds for the quotients.
struct Moments {
  double count = 0, value = 0, square = 0, reported = 0;

  void add(const std::array<double, 2>& one, double weight) {  // -1 removes one again
    count += weight, value += weight * one[0];
    square += weight * one[0] * one[0], reported += weight * one[1];
  }
  double mean() const { return value / count; }
  double spread() const { return (square - value * value / count) / (count - 1); }
  double said() const { return reported / count; }
};

using AllMoments = std::array<Moments, whole_image + 1>;

/// sqrt(E[se^2] / Var) of the pixels first ... end - 1, without the render `without` if it is
/// given.
double quotient(const AllMoments& moments, const std::vector<double>& weights, std::size_t first,
                std::size_t end, const Render* without = nullptr) {
  double said = 0, spread = 0;
  for (std::size_t i = first; i < end; ++i) {
    Moments m = moments[i];
    if (without != nullptr) m.add((*without)[i], -1);
    said += weights[i] * m.said(), spread += weights[i] * m.spread();
  }
  return spread > 0 ? std::sqrt(said / spread) : 1;
}

struct Quotient {
  double value, error;
};

Quotient jackknife(const std::vector<Render>& renders, const std::vector<double>& weights,
                   std::size_t first, std::size_t end) {
  AllMoments moments;
  for (const Render& render : renders) {
    for (std::size_t i = first; i < end; ++i)
      moments[i].add(render[i], 1);
  }
  const auto count = static_cast<double>(renders.size());
  std::vector<double> without;
  double mean = 0, squares = 0;
  for (const Render& render : renders) {
    without.push_back(quotient(moments, weights, first, end, &render));
    mean += without.back() / count;
  }
  for (const double q : without)
    squares += (q - mean) * (q - mean);
  return {quotient(moments, weights, first, end), std::sqrt(squares * (count - 1) / count)};
}

/// One over the squared mean of each pixel; leaves out those far darker than the image.
std::vector<double> relative(const std::vector<Render>& renders) {
  std::vector<double> weights;
  for (std::size_t i = 0; i <= whole_image; ++i) {
    double mean = 0, image = 0;
    for (const Render& r : renders)
      mean += r[i][0], image += r[whole_image][0];
    const double n = static_cast<double>(renders.size()), floor = 0.01 * image / n;
    weights.push_back(1 / (mean / n * (mean / n) + floor * floor));
  }
  return weights;
}

void judge(const char* what, const Quotient& q, bool exact) {
  INFO(what << ": reported " << q.value << " +- " << q.error << " of the spread between seeds");
  if (q.error > 0.05) return;
  CHECK(q.value + 3 * q.error >= 0.9);
  if (exact) CHECK(q.value - 3 * q.error <= 1.1);
}

void measure(const Scene& scene, const std::string& name, const Way& way, std::uint64_t seeds,
             std::uint32_t spp = 64) {
  std::vector<Render> renders;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    renders.push_back(one_render(scene, way, seed, spp));
  const std::vector<double> weights = relative(renders);
  const Quotient pixel = jackknife(renders, weights, 0, pixels);
  const Quotient image = jackknife(renders, weights, whole_image, whole_image + 1);
  const bool exact = scene.sampler == SamplerKind::independent;
  fmt::print("{:<20} {:<12} {:<15} {:>6.3f} +- {:.3f} {:>6.3f} +- {:.3f}\n", name,
             name_of(scene.sampler), way.name, pixel.value, pixel.error, image.value, image.error);
  std::fflush(stdout);
  INFO(name << ", " << name_of(scene.sampler) << ", " << way.name);
  judge("pixels", pixel, exact);
  judge("the mean", image, exact);
}

Scene small(const std::string& name, SamplerKind sampler) {
  Scene scene = lab_scenes::load(name);
  resize(scene, side, side);
  scene.sampler = sampler;
  return scene;
}

void measure_all(const std::string& name, std::uint64_t seeds) {
  for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
    const Scene scene = small(name, sampler);
    const bool lights = needs(scene).area_lights() + needs(scene).point_lights > 0 &&
                        renderer::light_paths_suit(scene);
    const bool vector_kernel = renderer::LaneScene::suits(needs(scene), scene);
    for (const Way& way : ways) {
      if (way.share && !(vector_kernel && renderer::LaneScene(scene).can_share())) continue;
      if (way.technique == Technique::path || lights) measure(scene, name, way, seeds);
    }
  }
}

void show_titles() {
  fmt::print("{:<20} {:<12} {:<15} {:>15} {:>15}\n", "scene", "sampler", "technique", "pixels",
             "the mean");
}

std::uint64_t number_of_seeds() {
  const char* text = std::getenv("CARLO_ERROR_SEEDS");
  return text == nullptr ? 100 : std::strtoull(text, nullptr, 10);
}

TEST_CASE("Standard errors are the spread between seeds", "[error_seeds]") {
  show_titles();
  measure_all("cornell_phong", number_of_seeds());
}

// Light through the slit reaches several pixels on its way: counting these as independent would
// make the error of the mean a sixth too small.
TEST_CASE("The mean's standard error knows of paths that reach several pixels", "[error_seeds]") {
  const Scene scene = small("rare_paths", SamplerKind::independent);
  show_titles();
  measure(scene, "rare_paths", ways[1], 1600, 16);
}

TEST_CASE("Standard errors are the spread between seeds: all scenes", "[.all]") {
  const char* only = std::getenv("CARLO_ERROR_SEEDS_ONLY");
  show_titles();
  for (const std::string& name : lab_scenes::names()) {
    if (only == nullptr || name.find(only) != std::string::npos)
      measure_all(name, number_of_seeds());
  }
}

}  // namespace
