#include "noise_integrator.h"
#include "random/rng.h"
#include "render/driver.h"
#include "render/splats.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using namespace carlo;

/// Uniform noise around 1 + x; optionally with a bad sample in one place.
class Noise final : public common_test::NoiseIntegrator {
 public:
  int throw_at = -1, nan_at = -1;

 private:
  void sample(const Tile& tile, int x, int y, BlockSum& sum, Counts& counts) const override {
    for (std::uint32_t s = 0; s < tile.samples; ++s) {
      Rng rng(1, static_cast<std::uint64_t>((y * 1000 + x) * 1000) + tile.first_sample + s);
      if (x == throw_at) throw std::runtime_error("from a worker");
      const float value = x == nan_at ? std::numeric_limits<float>::quiet_NaN()
                                      : static_cast<float>(x) + 2 * rng.uniform_float();
      sum.add(Rgb(value), counts);
    }
  }
};

RenderResult run(const Noise& noise, std::uint32_t spp, int threads) {
  return render(noise, 37, 21, {.spp = spp, .threads = threads, .progress = false});
}

TEST_CASE("The image has the same bits for 1, 2 and 7 threads") {
  const Noise noise;
  const RenderResult one = run(noise, 24, 1);
  for (const int threads : {2, 7}) {
    const RenderResult many = run(noise, 24, threads);
    CHECK(many.film.mean().pixels == one.film.mean().pixels);
    CHECK(many.film.standard_error().pixels == one.film.standard_error().pixels);
    CHECK(many.counts.paths == 37u * 21 * 24);
  }
}

TEST_CASE("Every pixel gets exactly the samples asked for, whatever their number") {
  const Noise noise;
  for (const std::uint32_t spp : {1u, 3u, 7u, 8u, 100u, 128u}) {
    const RenderResult result = run(noise, spp, 2);
    CHECK(result.film.samples() == std::uint64_t{37} * 21 * spp);
    CHECK(result.film.blocks(36, 20) * result.film.block() == spp);
  }
}

TEST_CASE("Blocks are a power of two that divides the samples, and at least eight if possible") {
  CHECK(block_size(1) == 1);
  CHECK(block_size(7) == 1);
  CHECK(block_size(64) == 8);
  CHECK(block_size(100) == 4);
  CHECK(block_size(4096) == 64);
  CHECK(block_size(1u << 20) == 64);
}

TEST_CASE("An exception in a worker thread reaches the caller") {
  Noise noise;
  noise.throw_at = 30;
  CHECK_THROWS_AS(run(noise, 8, 2), std::runtime_error);
}

TEST_CASE("Samples that are not finite are counted and left out") {
  Noise noise;
  noise.nan_at = 5;
  const RenderResult result = run(noise, 8, 2);
  CHECK(result.counts.bad == 21u * 8);
  CHECK(result.film.mean(5, 3, 0) == 0);
  CHECK(std::isfinite(result.film.mean(6, 3, 0)));
}

TEST_CASE("Ctrl-C ends the render and keeps what is finished") {
  Noise noise;
  noise.interrupt_at = 20;  // 6 tiles per pass; the second tile of the other seven passes
  const RenderResult result = run(noise, 64, 1);
  CHECK(result.interrupted);
  CHECK(result.film.blocks(0, 0) == 8);
  CHECK(result.film.blocks(36, 20) == 1);
}

TEST_CASE("A time limit gives every pixel at least two blocks") {
  const Noise noise;
  const RenderResult result =
      render(noise, 20, 20, {.spp = 1, .seconds = 0.0, .threads = 2, .progress = false});
  CHECK(result.film.blocks(0, 0) == 2);
  CHECK(std::isfinite(result.film.variance(19, 19, 0)));
}

/// Lit from the camera by the part of 1 that MIS weights leave to it, and by light paths, a quarter
/// of one for each sample of a pixel, by the rest.
class Shared final : public common_test::NoiseIntegrator {
 public:
  explicit Shared(int side) : pixels_(static_cast<std::size_t>(side * side)) {}

  double light_paths() const override { return .25; }
  void trace_light_paths(const LightPaths& paths, Splats& splats, Counts&) const override {
    for (std::uint64_t i = paths.first; i < paths.first + paths.count; ++i) {
      for (std::size_t pixel = 0; pixel < pixels_; ++pixel) {
        const auto units = std::llround((1 - camera_part(paths.share)) / splats.unit());
        splats.add(pixel, {units, units, units});
      }
    }
  }
  double splat_unit(std::uint64_t) const override { return 0x1p-30; }

 private:
  std::size_t pixels_;
  static double camera_part(double share) { return 1 / (1 + .25 * share); }
  void sample(const Tile& tile, int, int, BlockSum& sum, Counts& counts) const override {
    const double part = camera_part(tile.light_path_share);
    for (std::uint32_t i = 0; i < tile.samples; ++i)
      sum.add(Rgb(static_cast<float>(part)), counts);
  }
};

// The one light path of a single sample counts for four, on both sides of the weights; 3 x 3 pixels
// have 3 of 2.25.
TEST_CASE("Weights know how many light paths a small image has") {
  for (const int side : {1, 2, 3, 8}) {
    const Shared integrator(side);
    for (const std::uint32_t spp : {1u, 2u, 16u}) {
      const RenderResult result =
          render(integrator, side, side, {.spp = spp, .threads = 1, .progress = false});
      INFO(side << " x " << side << ", " << spp);
      CHECK(std::abs(result.film.mean(side - 1, 0, 0) - 1) < 1e-6);
    }
  }
}

}  // namespace
