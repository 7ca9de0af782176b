// Tests standard errors: over many independent renders, compares the mean of a pixel's squared
// standard error, E[se^2], with the variance of its value. The README calls standard errors
// unbiased for independent samples, and upper bounds for stratified ones, and for Sobol' points
// from 32 samples on. With fewer, products of two digits, one of each coordinate, which make up an
// edge across the pixel, have twice the variance of independent points, and no block shows it.
//
// The test judges the fraction of pixel channels whose quotient E[se^2]/Var is below .8. With 1000
// renders the quotient's own error is about 5 % where values are normal; it pushes the fraction
// over its limit of 1 % by chance only where the true quotients of many pixels are near .8. Pixels
// that differ in a few rare samples say nothing about their variance (their quotients are noise),
// and are left out: those whose fourth moment shows that the variance is known to no better than 15
// %.
//
// CARLO_ERROR_BARS_RENDERS: another number of renders. CARLO_ERROR_BARS_ONLY: only tests with this
// in their name, which is scene/sampler/spp.

#include "image/film.h"
#include "lab_scenes.h"
#include "render/driver.h"
#include "render/scene_film.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"
#include "scene/sampler_kind.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace carlo;

constexpr int size = 16;
constexpr std::size_t channels = 3;
constexpr double low = 0.8, share_allowed = 0.01;

/// According to the README: the number of samples from which standard errors are unbiased, or upper
/// bounds.
std::uint32_t bound_spp(SamplerKind kind) {
  switch (kind) {
    case SamplerKind::sobol:
      return 32;
    case SamplerKind::independent:
    case SamplerKind::stratified:
      return 4;
  }
  return 0;
}

/// Sums over renders, for one channel of a pixel.
struct Sums {
  double mean = 0, m2 = 0, m4 = 0, se2 = 0;
};

/// True if a block of samples is missing, in a merge that lacks some shards.
constexpr bool is_missing(std::uint32_t block) {
  return block % 8 == 1 || block % 8 == 2 || block % 8 == 5;
}

/// All renders of one scene, sampler, kernel and number of samples; only in parts if requested.
class Renders {
 public:
  Renders(const Scene& scene, std::uint32_t spp, renderer::Kernel kernel, bool partial)
      : spp_(spp),
        partial_(partial),
        integrator_(
            renderer::make_path_integrator(scene, {.seed = 1, .spp = spp, .kernel = kernel})) {}

  std::string kernel() const { return integrator_->name().substr(0, 6); }

  /// E[se^2]/Var of every channel whose variance is known, sorted.
  std::vector<double> quotients(std::uint32_t renders) const {
    std::vector<std::vector<double>> quotients(size);
    tbb::parallel_for(0, size, [&](int row) {
      quotients[static_cast<std::size_t>(row)] = row_quotients(row, renders);
    });
    std::vector<double> all;
    for (const auto& part : quotients)
      all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  std::vector<double> row_quotients(int row, std::uint32_t renders) const {
    std::vector<std::array<double, 2>> values(std::size_t{size} * channels * renders);
    for (std::uint32_t r = 0; r < renders; ++r)
      render_row(row, r + 1, &values[std::size_t{r} * size * channels]);
    std::vector<double> result;
    for (std::size_t i = 0; i < size * channels; ++i) {
      if (const double q = quotient(values, i, renders); q > 0) result.push_back(q);
    }
    return result;
  }

  /// Value and squared standard error of each channel of a row.
  void render_row(int row, std::uint32_t stream, std::array<double, 2>* values) const {
    const std::uint32_t block = block_size(spp_);
    Film film(size, 1, block);
    std::array<std::array<double, 3>, size> means;
    Counts counts;
    for (std::uint32_t first = 0; first < spp_; first += block) {
      if (partial_ && is_missing(first / block)) continue;
      integrator_->render({.x0 = 0,
                           .y0 = row,
                           .x1 = size,
                           .y1 = row + 1,
                           .first_sample = first,
                           .samples = block,
                           .stream = stream},
                          means, counts);
      for (int x = 0; x < size; ++x)
        film.add_block(x, 0, means[static_cast<std::size_t>(x)]);
    }
    for (int x = 0; x < size; ++x) {
      for (std::size_t c = 0; c < channels; ++c)
        *values++ = {film.mean(x, 0, c), film.variance(x, 0, c)};
    }
  }

  /// 0 where the variance is 0 or unknown.
  static double quotient(const std::vector<std::array<double, 2>>& values, std::size_t i,
                         std::uint32_t renders) {
    double mean = 0, se2 = 0, m2 = 0, m4 = 0;
    for (std::size_t r = 0; r < renders; ++r)
      mean += values[r * size * channels + i][0] / renders;
    for (std::size_t r = 0; r < renders; ++r) {
      const auto& [value, error2] = values[r * size * channels + i];
      const double d2 = (value - mean) * (value - mean);
      m2 += d2 / renders, m4 += d2 * d2 / renders, se2 += error2 / renders;
    }
    if (!(std::sqrt(m2) > 1e-5 * mean)) return 0;  // rounding
    if ((m4 / (m2 * m2) - 1) / renders > 0.15 * 0.15) return 0;
    return se2 / (m2 * renders / (renders - 1));
  }

  std::uint32_t spp_;
  bool partial_;
  std::unique_ptr<Integrator> integrator_;
};

struct Line {
  std::string scene, sampler, kernel;
  std::uint32_t spp;
  std::size_t known, below;
  double least, first_percent, median;
};

void show_heading() {
  fmt::print("{:<20} {:<12} {:<7} {:>4} {:>6} {:>7} {:>6} {:>6} {:>7}\n", "scene", "sampler",
             "kernel", "spp", "known", "<.8, %", "least", "1 %", "median");
}

void show(const Line& l) {
  fmt::print(
      "{:<20} {:<12} {:<7} {:>4} {:>6} {:>7.2f} {:>6.2f} {:>6.2f} {:>7.2f}\n", l.scene, l.sampler,
      l.kernel, l.spp, l.known,
      100. * static_cast<double>(l.below) / static_cast<double>(std::max<std::size_t>(l.known, 1)),
      l.least, l.first_percent, l.median);
  std::fflush(stdout);
}

std::uint32_t renders_of(std::uint32_t usual) {
  const char* text = std::getenv("CARLO_ERROR_BARS_RENDERS");
  return text == nullptr ? usual : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

bool asked_for(const std::string& scene, SamplerKind kind, std::uint32_t spp) {
  const char* only = std::getenv("CARLO_ERROR_BARS_ONLY");
  const std::string name = fmt::format("{}/{}/{}", scene, name_of(kind), spp);
  return only == nullptr || name.find(only) != std::string::npos;
}

void measure(const std::string& name, const std::vector<std::uint32_t>& samples,
             std::uint32_t renders, bool partial = false) {
  Scene scene = lab_scenes::load(name);
  resize(scene, size, size);
  for (const SamplerKind kind : sampler_kinds) {
    scene.sampler = kind;
    for (const auto kernel : {renderer::Kernel::scalar, renderer::Kernel::best}) {
      for (const std::uint32_t spp : samples) {
        if (!asked_for(name, kind, spp)) continue;
        const Renders all(scene, spp, kernel, partial);
        if (kernel == renderer::Kernel::best && all.kernel() == "scalar") continue;
        const std::vector<double> q = all.quotients(renders);
        if (q.empty()) continue;
        const auto below =
            static_cast<std::size_t>(std::lower_bound(q.begin(), q.end(), low) - q.begin());
        show({name, std::string(name_of(kind)), all.kernel(), spp, q.size(), below, q.front(),
              q[q.size() / 100], q[q.size() / 2]});
        if (spp < bound_spp(kind)) continue;
        INFO(name << ", " << name_of(kind) << ", " << all.kernel() << ", " << spp << " spp");
        CHECK(static_cast<double>(below) <= share_allowed * static_cast<double>(q.size()));
      }
    }
  }
}

TEST_CASE("Standard errors are what they say", "[error_bars]") {
  show_heading();
  measure("antialiasing", {32}, renders_of(800));
}

TEST_CASE("Standard errors are what they say where shares are missing", "[error_bars]") {
  show_heading();
  measure("antialiasing", {64}, renders_of(800), true);
}

TEST_CASE("Standard errors are what they say where shares are missing: all scenes", "[.all]") {
  show_heading();
  for (const std::string& name : lab_scenes::names())
    measure(name, {64}, renders_of(1000), true);
}

TEST_CASE("Standard errors are what they say: all scenes", "[.all]") {
  show_heading();
  for (const std::string& name : lab_scenes::names())
    measure(name, {2, 4, 8, 16, 32, 64}, renders_of(1000));
}

}  // namespace
