// Shares of a render and their merges; tests/renderer/merge_test.sh tests the programs.

#include "renderer/production/merge.h"

#include "common/temporary_folder.h"
#include "course/render/report.h"
#include "random/rng.h"
#include "shard_noise.h"

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

namespace {

using namespace carlo;
using namespace common_test;
namespace fs = std::filesystem;

/// Writes the parts of all N shards of the noise. Some are interrupted, written, read and
/// continued.
std::vector<fs::path> write_shards(const fs::path& folder, std::uint32_t count, std::uint32_t spp,
                                   bool lights, Rng& rng) {
  std::vector<fs::path> parts;
  for (std::uint32_t i = 1; i <= count; ++i) {
    ShardNoise noise(lights);
    const Shard shard{i, count};
    const BlockRange share = share_of(shard, noise_grid(spp), lights);
    const int threads = 1 + static_cast<int>(i % 2);
    if (share.count() > 0 && rng.uniform_float() < .5f) {
      noise.interrupt_at =
          1 + static_cast<int>(rng.uniform_float() * static_cast<float>(share.count()));
    }
    const fs::path path = folder / fmt::format("{}-of-{}.part", i, count);
    RenderResult result = render_noise(noise, spp, threads, share);
    REQUIRE(result.interrupted == (noise.interrupt_at > 0));
    write_part(path, noise_header(noise, spp, shard, result), result.film);
    if (result.interrupted) {
      const PartFile file(path);
      RenderResult start{.film = Film(noise.width, noise.height, noise_grid(spp).block),
                         .counts = file.header().counts,
                         .covariance = file.header().covariance};
      file.add_to(start.film);
      CHECK(same_sums(start.film, result.film));
      CHECK(file.header().blocks.count() < share.count());
      noise.interrupt_at = -1;
      result = render_noise(noise, spp, threads, share, &start);
      write_part(path, noise_header(noise, spp, shard, result), result.film);
    }
    parts.push_back(path);
  }
  return parts;
}

/// Merges the parts in a random order, some of them first into intermediate parts.
Merge merge_at_random(std::vector<fs::path> parts, const fs::path& folder, Rng& rng) {
  const auto below = [&](std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(rng.uniform_float() * static_cast<float>(n)));
  };
  for (int round = 0; parts.size() > 1; ++round) {
    for (std::size_t i = parts.size(); i > 1; --i)
      std::swap(parts[i - 1], parts[below(i)]);
    const std::size_t taken = 1 + below(parts.size());
    Merge merge({parts.end() - static_cast<std::ptrdiff_t>(taken), parts.end()});
    if (taken == parts.size()) return merge;
    parts.resize(parts.size() - taken);
    parts.push_back(folder / fmt::format("merged{}.part", round));
    write_part(parts.back(), merge.header(), merge.run().film);
  }
  return Merge(parts);
}

TEST_CASE(
    "Parts merged in any order and grouping have the bits of the render that was not shared out") {
  Rng rng(11, 0);
  for (const bool lights : {false, true}) {
    const RenderResult whole = render_noise(ShardNoise(lights), 64);
    for (const std::uint32_t count : {1u, 2u, 7u, 48u, 64u}) {  // of 48 blocks
      const TemporaryFolder scratch;
      const auto parts = write_shards(scratch.path(), count, 64, lights, rng);
      for (int round = 0; round < 4; ++round) {
        INFO(lights << " " << count << " " << round);
        const Merge merge = merge_at_random(parts, scratch.path(), rng);
        REQUIRE(merge.complete());
        const RenderResult merged = merge.run();
        CHECK(same_sums(merged.film, whole.film));
        CHECK(merged.covariance == whole.covariance);
        CHECK(merged.counts.paths == whole.counts.paths);
        CHECK(merged.counts.light_paths == whole.counts.light_paths);
        CHECK(merged.counts.splat_covariance == whole.counts.splat_covariance);
        CHECK(mean_of(merged).standard_error == mean_of(whole).standard_error);
        CHECK(merge.header().parts == count);
        CHECK(merge.header().microseconds == 1000 * count + count * (count + 1) / 2);
      }
    }
  }
}

TEST_CASE("Shares of different N merge where they fit") {
  const TemporaryFolder scratch;
  Rng rng(12, 0);
  const auto halves = write_shards(scratch.path(), 2, 64, false, rng);
  const auto quarters = write_shards(scratch.path(), 4, 64, false, rng);
  const Merge merge({quarters[3], halves[0], quarters[2]});
  CHECK(merge.complete());
  CHECK(same_sums(merge.run().film, render_noise(ShardNoise(false), 64).film));
}

TEST_CASE("The shares of any N are all of a render's blocks, and as many each but for one") {
  for (const std::uint32_t count : {1u, 2u, 3u, 7u, 8u, 47u, 48u, 49u, 1000u}) {
    for (const bool lights : {false, true}) {
      const BlockGrid grid = noise_grid(64);
      std::uint64_t end = 0, least = grid.blocks(), most = 0;
      for (std::uint32_t i = 1; i <= count; ++i) {
        const BlockRange share = share_of({i, count}, grid, lights);
        CHECK(share.begin == end);
        end = share.end;
        least = std::min(least, share.count());
        most = std::max(most, share.count());
        if (lights && count <= grid.passes) CHECK(share.begin % grid.tiles() == 0);
      }
      CHECK(end == grid.blocks());
      CHECK(most - least <= (lights && count <= grid.passes ? grid.tiles() : 1));
    }
  }
  // The largest render: its sums do not overflow.
  const BlockGrid grid{8192, 4096, 1, 1 << 28};
  CHECK(share_of({most_shards, most_shards}, grid, false).end == grid.blocks());
}

TEST_CASE("What a killed shard has is known from its film") {
  const BlockGrid grid = noise_grid(64);
  for (std::uint64_t begin = 0; begin < grid.blocks(); begin += 5) {
    for (std::uint64_t end = begin; end <= grid.blocks(); end += 7) {
      const BlockRange share{begin, end};
      const RenderResult all = render_noise(ShardNoise(false), 64, 2, share);
      CHECK(blocks_done(all.film, share) == BlockSet({share}));
      CHECK((all.film.samples() > 0) == (share.count() > 0));
    }
  }
}

TEST_CASE(
    "Where shares are missing, means and standard errors are those of the blocks that are there") {
  const TemporaryFolder scratch;
  Rng rng(13, 0);
  std::vector<fs::path> parts = write_shards(scratch.path(), 16, 64, false, rng);  // 3 blocks each
  for (const std::size_t gone : {14u, 9u, 8u, 3u})
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(gone));
  const Merge merge(parts);
  CHECK(!merge.complete());
  CHECK(merge.share() == .75);
  CHECK(merge.missing() == "25 % of the samples (shards 4/16, 9/16, 10/16, 15/16)");
  const RenderResult merged = merge.run();
  const ShardNoise noise(false);
  const BlockGrid grid = noise_grid(64);
  for (int y = 0; y < grid.height; y += 5) {
    for (int x = 0; x < grid.width; x += 3) {
      const auto tile = static_cast<std::uint64_t>(y / 16 * grid.columns() + x / 16);
      std::vector<double> means;
      for (std::uint32_t pass = 0; pass < grid.passes; ++pass) {
        const std::uint64_t number = pass * grid.tiles() + tile;
        if (merge.header().blocks.count_in({number, number + 1}) == 0) continue;
        std::array<std::array<double, 3>, 1> mean;
        Counts counts;
        noise.render({x, y, x + 1, y + 1, pass * grid.block, grid.block}, mean, counts);
        means.push_back(mean[0][0]);
      }
      double sum = 0, squares = 0;
      for (const double m : means)
        sum += m;
      const auto n = static_cast<double>(means.size());
      for (const double m : means)
        squares += (m - sum / n) * (m - sum / n);
      REQUIRE(merged.film.blocks(x, y) == means.size());
      CHECK(merged.film.mean(x, y, 0) == Catch::Approx(sum / n));
      CHECK(merged.film.variance(x, y, 0) == Catch::Approx(squares / (n * (n - 1))));
    }
  }
}

TEST_CASE("Pixels that light paths tie together: a render's error bar, shared out or not") {
  const RenderResult whole = render_noise(ShardNoise(true), 64);
  const MeanRadiance apart = mean_radiance(whole.film), tied = mean_of(whole);
  const auto samples = static_cast<double>(whole.film.samples());
  const double all = luminance(apart.value);
  const double relative = whole.counts.splat_covariance / (samples * samples * all * all);
  REQUIRE(relative > 0);
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(tied.standard_error[c] ==
          Catch::Approx(std::hypot(apart.standard_error[c], std::sqrt(relative) * apart.value[c])));
  }
  // Half of the passes: twice the variance. All passes, but half of the first one's tiles: about
  // the same, because each block contributes the covariances of its pass.
  const auto added = [](const RenderResult& r) {
    const MeanRadiance one = mean_radiance(r.film), both = mean_of(r);
    return (std::pow(both.standard_error[0], 2) - std::pow(one.standard_error[0], 2)) /
           std::pow(one.value[0], 2);
  };
  const RenderResult half = render_noise(ShardNoise(true), 64, 2, BlockRange{0, 24});
  CHECK(added(half) / added(whole) == Catch::Approx(2).epsilon(.2));
  const RenderResult some = render_noise(ShardNoise(true), 64, 2, BlockRange{3, 48});
  CHECK(added(some) / added(whole) == Catch::Approx(1).epsilon(.2));
}

TEST_CASE("An interrupted pass counts its light paths once") {
  const RenderResult whole = render_noise(ShardNoise(true), 64);
  for (const int tile : {1, 3, 6, 7, 20, 48}) {
    ShardNoise noise(true);
    noise.interrupt_at = tile;
    const RenderResult part = render_noise(noise, 64);
    noise.interrupt_at = -1;
    const RenderResult resumed = render_noise(noise, 64, 2, {}, &part);
    CHECK(resumed.counts.light_paths == whole.counts.light_paths);
    CHECK(resumed.covariance == whole.covariance);
    CHECK(same_sums(resumed.film, whole.film));
  }
}

}  // namespace
