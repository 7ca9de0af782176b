#pragma once

#include "common/noise_integrator.h"
#include "random/rng.h"
#include "render/blocks.h"
#include "render/driver.h"
#include "render/splats.h"
#include "renderer/production/part.h"

#include <cmath>
#include <cstdint>
#include <optional>

namespace common_test {

/// Noise over five orders of magnitude, from the camera and from lights, for tests of shards.
class ShardNoise final : public NoiseIntegrator {
 public:
  static constexpr int width = 37, height = 21;  // 6 tiles

  explicit ShardNoise(bool with_lights) : lights_(with_lights) {}

  double light_paths() const override { return lights_ ? 1 : 0; }

  /// Each path reaches two pixels.
  void trace_light_paths(const carlo::LightPaths& paths, carlo::Splats& splats,
                         carlo::Counts& counts) const override {
    for (std::uint64_t i = paths.first; i < paths.first + paths.count; ++i) {
      carlo::Rng rng(5, i);
      const auto one = static_cast<std::size_t>(rng.uniform_float() * width * height);
      const auto units = static_cast<std::int64_t>(1e6f * std::pow(rng.uniform_float(), 4.0f));
      splats.add(one, {units, units, units});
      splats.add(width * height - 1 - one, {units, units, units});
      const double splat = static_cast<double>(units) * splats.unit();
      counts.splat_covariance += 2 * splat * splat;
      ++counts.light_paths;
    }
  }
  double splat_unit(std::uint64_t paths) const override {
    return 1e-6 * static_cast<double>(paths) / 100;
  }

 private:
  void sample(const carlo::Tile& tile, int x, int y, carlo::BlockSum& sum,
              carlo::Counts& counts) const override {
    for (std::uint32_t s = 0; s < tile.samples; ++s) {
      carlo::Rng rng(3, static_cast<std::uint64_t>(y * width + x) << 32 | (tile.first_sample + s));
      const float u = rng.uniform_float();
      sum.add({std::pow(10.0f, 5 * u - 4), u, 0}, counts);
    }
  }

  bool lights_;
};

inline carlo::BlockGrid noise_grid(std::uint32_t spp) {
  const std::uint32_t block = carlo::block_size(spp);
  return {ShardNoise::width, ShardNoise::height, block, spp / block};
}

/// `spp` samples of the noise, or a share of them.
inline carlo::RenderResult render_noise(const ShardNoise& noise, std::uint32_t spp, int threads = 2,
                                        std::optional<carlo::BlockRange> share = {},
                                        const carlo::RenderResult* earlier = nullptr) {
  return carlo::render(
      noise, ShardNoise::width, ShardNoise::height,
      {.spp = spp, .threads = threads, .progress = false, .earlier = earlier, .share = share});
}

/// The header of a shard of the noise, for what has been rendered of it.
inline carlo::PartHeader noise_header(const ShardNoise& noise, std::uint32_t spp,
                                      const carlo::Shard& shard,
                                      const carlo::RenderResult& result) {
  carlo::PartHeader part;
  for (const std::string& name : carlo::part_setting_names())
    part.settings[name] = "1";
  part.settings["planned_spp"] = std::to_string(spp);
  part.settings["kernel"] = "noise";
  part.scene = "noise.xml";
  part.needs = "nothing";
  part.grid = noise_grid(spp);
  part.light_paths = noise.light_paths() > 0;
  part.shard = shard;
  part.blocks =
      carlo::blocks_done(result.film, carlo::share_of(shard, part.grid, part.light_paths));
  part.counts = result.counts;
  part.covariance = result.covariance;
  part.microseconds = 1000 + shard.index;
  part.threads = result.threads;
  return part;
}

/// True if two films have the same sums.
inline bool same_sums(const carlo::Film& a, const carlo::Film& b) {
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const carlo::PixelSums& p = a.sums(x, y);
      const carlo::PixelSums& q = b.sums(x, y);
      if (p.sum != q.sum || p.squares != q.squares || p.blocks != q.blocks ||
          p.samples != q.samples) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace common_test
