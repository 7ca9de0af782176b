#include "renderer/production/adaptive.h"

#include "common/noise_integrator.h"
#include "course/render/pixel_maps.h"
#include "random/rng.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace carlo;

/// Pixels of mean 1 with spikes: a sample is 1/p with probability p, else 0; p is 1/8 on the left
/// half of the film and 1/2 on the right.
class Spikes final : public common_test::NoiseIntegrator {
 public:
  explicit Spikes(std::uint64_t seed) : seed_(seed) {}
  static constexpr int width = 16, height = 8;

 private:
  void sample(const Tile& tile, int x, int y, BlockSum& sum, Counts& counts) const override {
    Rng rng(stream_seed(seed_, tile.stream),
            static_cast<std::uint64_t>(y * width + x) << 32 | tile.first_sample);
    const float p = x < width / 2 ? 0.125f : 0.5f;
    for (std::uint32_t s = 0; s < tile.samples; ++s)
      sum.add(Rgb(rng.uniform_float() < p ? 1 / p : 0), counts);
  }

  std::uint64_t seed_;
};

AdaptiveResult run(const Spikes& spikes, double target, std::uint32_t spp = 1u << 16,
                   int threads = 1) {
  return render_adaptively(spikes, Spikes::width, Spikes::height, {target, spp, {}},
                           {.threads = threads, .progress = false});
}

TEST_CASE("Adaptive sampling biases neither the image nor its standard errors") {
  // 1000 renders of 16 x 8 pixels, judged by halves. The sums of errors and of (error^2 - variance)
  // have standard errors found from the renders themselves; each z fails by chance once in 16 000
  // (4 sigma). Power: a bias of .3 % of the mean would show. (A single set of samples that decides
  // for itself is biased by more than 1 % here: the test below.)
  constexpr int renders = 1000;
  for (const int left : {1, 0}) {
    double sum = 0, squares = 0, excess = 0, excess_squares = 0;
    for (int r = 0; r < renders; ++r) {
      const AdaptiveResult result = run(Spikes(static_cast<std::uint64_t>(r)), 0.3);
      double error = 0, over = 0;
      for (int y = 0; y < Spikes::height; ++y) {
        for (int x = left ? 0 : 8; x < (left ? 8 : 16); ++x) {
          const double e = result.film.mean(x, y, 0) - 1;
          error += e / 64;
          over += (e * e - result.film.variance(x, y, 0)) / 64;
        }
      }
      sum += error;
      squares += error * error;
      excess += over;
      excess_squares += over * over;
    }
    INFO((left ? "left" : "right"));
    CHECK(std::abs(sum) <= 4 * std::sqrt(squares));
    CHECK(std::abs(excess) <= 4 * std::sqrt(excess_squares));
    CHECK(std::sqrt(squares) / renders <= 0.0006);
  }
}

TEST_CASE("Samples that decide for themselves when to stop would be biased") {
  // The same pixels without halves, sampled until their own estimate is good enough.
  double sum = 0, squares = 0;
  constexpr int pixels = 20000;
  for (int i = 0; i < pixels; ++i) {
    Rng rng(7, static_cast<std::uint64_t>(i));
    GroupedMean mean;
    const auto group = [&](int samples) {
      std::array<double, 8> blocks{};
      for (double& b : blocks) {
        for (int s = 0; s < samples; ++s)
          b += (rng.uniform() < 0.125 ? 8.0 : 0.0) / samples;
      }
      mean.add(blocks, samples);
    };
    for (int samples = 4; mean.samples() < 4096; samples = static_cast<int>(mean.samples()) / 8) {
      group(samples);
      if (std::sqrt(mean.variance()) <= 0.3 * std::fmax(mean.mean(), 0.01)) break;
    }
    sum += mean.mean() - 1;
    squares += (mean.mean() - 1) * (mean.mean() - 1);
  }
  CHECK(std::abs(sum) >= 5 * std::sqrt(squares));
}

TEST_CASE("An adaptive image has the same bits for 1, 2, 3 and 7 threads") {
  const AdaptiveResult one = run(Spikes(1), 0.1);
  for (const int threads : {2, 3, 7}) {
    const AdaptiveResult many = run(Spikes(1), 0.1, 1u << 16, threads);
    CHECK(many.film.mean().pixels == one.film.mean().pixels);
    CHECK(many.film.standard_error().pixels == one.film.standard_error().pixels);
    CHECK(samples_map(many.film).pixels == samples_map(one.film).pixels);
    CHECK(many.counts.paths == one.counts.paths);
  }
}

TEST_CASE("The target is met in nine pixels of ten, and noisy pixels get the samples") {
  // 128 pixels, 20 renders: the fraction within is .95 by design, its standard error .004.
  double within = 0;
  std::uint64_t left = 0, right = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const AdaptiveResult result = run(Spikes(100 + seed), 0.1);
    CHECK(result.summary.capped == 0);
    CHECK(result.summary.within >= 0.9);
    for (int y = 0; y < Spikes::height; ++y) {
      for (int x = 0; x < Spikes::width; ++x) {
        within += std::abs(result.film.mean(x, y, 0) - 1) <= 0.1 ? 1 : 0;
        if (x < 4) left += result.film.samples(x, y);
        if (x >= 12) right += result.film.samples(x, y);
      }
    }
  }
  CHECK(within / (20 * 128) >= 0.93);
  // Away from the border the variances are 7 and 1; samples grow in steps of up to 1.5.
  const double ratio = static_cast<double>(left) / static_cast<double>(right);
  CHECK(ratio >= 7 / 1.5);
  CHECK(ratio <= 7 * 1.5);
}

/// White everywhere, like samples that have missed a light of this probability.
class MissedLight final : public common_test::NoiseIntegrator {
 public:
  explicit MissedLight(double probability) : probability_(probability) {}
  double least_light_probability() const override { return probability_; }

 private:
  void sample(const Tile& tile, int, int, BlockSum& sum, Counts& counts) const override {
    for (std::uint32_t s = 0; s < tile.samples; ++s)
      sum.add(Rgb(1), counts);
  }

  double probability_;
};

TEST_CASE("No pixel is done before each light has been asked ten times around it") {
  // 144 pixels of n samples per half, n = 32, 48, 64 ...: a light of probability 1/1600 has been
  // sampled ten times when n is 128, whatever the noise. One of 1e-9 is too rare to wait for, which
  // the summary shows.
  const auto finished = [](double probability) {
    return render_adaptively(MissedLight(probability), 16, 16, {.01, 1 << 16, {}},
                             {.threads = 1, .progress = false})
        .summary;
  };
  CHECK(finished(1).least == 64);
  CHECK(finished(1.0 / 1600).least == 256);
  CHECK(finished(1.0 / 1600).light_samples >= 10);
  CHECK(finished(1e-9).least == 2048);
  CHECK(finished(1e-9).light_samples < 10);
}

TEST_CASE("No pixel gets more samples than spp, whatever the target") {
  for (const std::uint32_t spp : {32u, 100u, 1000u}) {
    const AdaptiveResult result = run(Spikes(1), 1e-6, spp);
    CHECK(result.summary.most <= spp);
    CHECK(result.summary.least * 3 >= spp);
    CHECK(result.summary.capped == 1);
    CHECK(result.film.samples() == result.counts.paths);
  }
}

TEST_CASE("A time limit leaves every pixel an estimate, and Ctrl-C what is finished") {
  const AdaptiveResult limited = render_adaptively(Spikes(1), 16, 8, {0.001, 1u << 16, 0.0},
                                                   {.threads = 2, .progress = false});
  CHECK(limited.summary.least == 64);
  CHECK(std::isfinite(limited.film.variance(15, 7, 0)));
  Spikes spikes(1);
  spikes.interrupt_at = 12;  // in the second job of the two in the first round
  const AdaptiveResult cut = run(spikes, 0.1);
  CHECK(cut.interrupted);
  CHECK(cut.summary.most == 32);
  CHECK(std::isfinite(cut.film.variance(0, 0, 0)));
}

TEST_CASE("Targets that make no sense are refused") {
  for (const double target : {0.0, -0.1, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(run(Spikes(1), target), Error);
  }
  CHECK_THROWS_AS(run(Spikes(1), 0.1, 31), Error);
}

TEST_CASE("The map of samples runs from the darkest colour to the brightest") {
  Film film(3, 1, 1);
  const std::array<double, 3> one = {1, 1, 1}, none = {0, 0, 0};
  film.set_estimate(0, 0, one, none, 64);
  film.set_estimate(1, 0, one, none, 512);
  film.set_estimate(2, 0, one, none, 4096);
  const Image map = samples_map(film);
  CHECK(map.at(0, 0).g < map.at(1, 0).r);
  CHECK(map.at(1, 0).g < map.at(2, 0).g);
  CHECK(film.samples() == 64 + 512 + 4096);
}

TEST_CASE("A film keeps an estimate that was made elsewhere") {
  Film film(2, 1, 8);
  film.set_estimate(1, 0, {0.25, 3, 0}, {0.125, 1e-3, 0}, 1000);
  CHECK(film.mean(1, 0, 0) == 0.25);
  CHECK(std::abs(std::sqrt(film.variance(1, 0, 0)) - 0.125) <= 1e-9);
  CHECK(std::abs(std::sqrt(film.variance(1, 0, 1)) - 1e-3) <= 1e-9);
  CHECK(film.variance(1, 0, 2) == 0);
  CHECK(film.samples(1, 0) == 1000);
  CHECK(film.samples(0, 0) == 0);
}

}  // namespace
