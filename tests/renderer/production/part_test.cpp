#include "renderer/production/part.h"

#include "common/temporary_folder.h"
#include "random/rng.h"
#include "renderer/production/exact_sum_text.h"
#include "renderer/production/merge.h"
#include "renderer/production/part_tile.h"
#include "shard_noise.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace carlo;
using namespace common_test;
namespace fs = std::filesystem;

TEST_CASE("Sets of blocks are text and back, and know what is missing") {
  const BlockSet set({{20, 30}, {5, 5}, {2, 7}, {7, 9}});
  CHECK(set.text() == "2-9 20-30");
  CHECK(BlockSet::from_text(set.text()) == set);
  CHECK(BlockSet::from_text("") == BlockSet());
  CHECK(set.count() == 17);
  CHECK(set.end() == 30);
  CHECK(set.missing(32).text() == "0-2 9-20 30-32");
  CHECK(set.missing(30).text() == "0-2 9-20");
  CHECK(BlockSet().missing(3).text() == "0-3");
  CHECK(set.count_in({8, 22}) == 3);
  CHECK(set.count_in({9, 20}) == 0);
  CHECK(set.of_tiles(4) == std::vector<std::uint32_t>{5, 4, 4, 4});
  Rng rng(23, 0);
  for (int round = 0; round < 200; ++round) {
    std::vector<BlockRange> ranges;
    const auto tiles = 1 + static_cast<std::uint64_t>(rng.uniform_float() * 9);
    std::vector<std::uint32_t> expected(tiles);
    for (std::uint64_t begin = 0; begin < 60;) {
      const std::uint64_t end = begin + static_cast<std::uint64_t>(rng.uniform_float() * 20);
      ranges.push_back({begin, end});
      for (; begin < end; ++begin)
        ++expected[begin % tiles];
      begin += 1 + static_cast<std::uint64_t>(rng.uniform_float() * 9);
    }
    CHECK(BlockSet(ranges).of_tiles(tiles) == expected);
  }
  for (const char* spoilt : {" ", "1", "1-", "-1", "2-1", "1-1", "1-2 ", "1-3 3-4", "1-3 2-4",
                             "4-5 1-2", "1-2,3-4", "1-99999999999999999999", "+1-2", "1-2  4-5"}) {
    INFO(spoilt);
    CHECK(!BlockSet::from_text(spoilt));
  }
}

TEST_CASE("A shard is I/N") {
  CHECK(shard_of("3/64") == Shard{3, 64});
  CHECK(shard_of("1048576/1048576").count == most_shards);
  for (const char* spoilt : {"", "3", "/", "3/", "/3", "0/3", "4/3", "-1/3", "1/1048577", "1/3/5",
                             "a/b", "1.5/3", " 1/3", "1/ 3", "1 of 3"}) {
    INFO(spoilt);
    CHECK_THROWS_AS(shard_of(spoilt), Error);
  }
}

TEST_CASE("Exact sums are text and back") {
  ExactSum sum;
  for (const double x : {1.0, -1e20, 3e-7}) {
    sum.add(x);
    CHECK(exact_sum_of(to_text(sum)) == sum);
  }
  for (const char* spoilt : {"", "1 2 3 4 5 6", "1 2 3 4 5 6 7 8", "1 2 3 4 5 6 a",
                             "1 2 3 4 5 6 -7", "1 2 3 4 5 6 7 ", "1 2 3 4 5 6 4294967296"}) {
    INFO(spoilt);
    CHECK(!exact_sum_of(spoilt));
  }
}

/// Pixels that have gathered terms of any size and sign, or nothing.
std::vector<PixelSums> random_pixels(Rng& rng, std::size_t count) {
  std::vector<PixelSums> pixels(count);
  for (PixelSums& pixel : pixels) {
    const int terms = static_cast<int>(rng.uniform_float() * 4);
    for (int i = 0; i < terms; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double size =
            std::ldexp(rng.uniform_float(), static_cast<int>(rng.uniform_float() * 2000) - 1000);
        pixel.sum[c].add(rng.uniform_float() < .5f ? size : -size);
        pixel.squares[c].add(std::ldexp(rng.uniform_float(), i));
      }
    }
  }
  return pixels;
}

TEST_CASE("A tile's sums survive as bytes, whatever they are; other bytes are found out") {
  Rng rng(21, 0);
  for (const std::size_t count : {1u, 5u, 80u, 256u}) {
    const std::vector<PixelSums> pixels = random_pixels(rng, count);
    std::vector<unsigned char> bytes;
    append_tile(bytes, pixels);
    CHECK(bytes.size() <= most_tile_bytes(count));
    std::vector<PixelSums> read(count);
    REQUIRE(add_tile(bytes, read));
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(read[i].sum == pixels[i].sum);
      CHECK(read[i].squares == pixels[i].squares);
    }
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 40)
      CHECK(!add_tile(std::span(bytes).first(length), read));
    bytes.push_back(0);
    CHECK(!add_tile(bytes, read));
  }
}

/// Shards 1/2 and 2/2 of the noise in files, and ways to corrupt the second.
struct Pair {
  Pair() : noise(false) {
    for (const std::uint32_t i : {1u, 2u}) {
      const RenderResult result =
          render_noise(noise, 64, 2, share_of({i, 2}, noise_grid(64), false));
      headers.push_back(noise_header(noise, 64, {i, 2}, result));
      films.push_back(result.film);
      write_part(path(i), headers.back(), films.back());
    }
  }
  fs::path path(std::uint32_t i) const { return scratch.path() / fmt::format("{}.part", i); }
  /// Writes the second with another header.
  void change(const std::function<void(PartHeader&)>& changed) {
    PartHeader header = headers[1];
    changed(header);
    write_part(path(2), header, films[1]);
  }
  /// Writes the second with other bytes.
  void spoil(const std::function<void(std::string&)>& spoilt) {
    std::string bytes = read_file(path(2));
    spoilt(bytes);
    write_file(path(2), bytes);
  }
  /// Returns the error of merging both; empty if there is none.
  std::string complaint() const {
    try {
      Merge({path(1), path(2)}).run();
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }

  TemporaryFolder scratch;
  ShardNoise noise;
  std::vector<PartHeader> headers;
  std::vector<Film> films;
};

TEST_CASE("Another render's part is refused by name") {
  using Change = std::function<void(PartHeader&)>;
  const std::vector<std::pair<Change, std::string>> changes = {
      {[](PartHeader& p) { p.settings["scene_digest"] = "2"; }, "its scene is 2, the other's 1"},
      {[](PartHeader& p) { p.settings["seed"] = "2"; }, "its seed is 2, the other's 1"},
      {[](PartHeader& p) { p.settings["sampler"] = "2"; }, "its sampler is 2"},
      {[](PartHeader& p) { p.settings["max_depth"] = "2"; }, "its max_depth is 2"},
      {[](PartHeader& p) { p.settings["kernel"] = "2"; }, "its kernel is 2, the other's noise"},
      {[](PartHeader& p) { p.settings["version"] = "2"; }, "its version is 2"},
      {[](PartHeader& p) {
         p.settings["planned_spp"] = "72";
         p.grid.passes = 9;
       },
       "its planned_spp is 72, the other's 64"},
      {[](PartHeader& p) { p.grid.width = 36; }, "its film is 36 x 21"},
      {[](PartHeader& p) {
         p.grid.block = 4;
         p.grid.passes = 16;
       },
       "its film is 37 x 21 in 16 blocks of 4"},
  };
  Pair pair;
  CHECK(pair.complaint().empty());
  pair.change([](PartHeader& p) { p.settings["definitions"] = "2"; });  // they are in the scene
  CHECK(pair.complaint().empty());
  for (const auto& [change, expected] : changes) {
    pair.change(change);
    INFO(pair.complaint());
    CHECK(pair.complaint().find(expected) != std::string::npos);
    CHECK(pair.complaint().starts_with(pair.path(2).string()));
  }
}

TEST_CASE("Samples that two parts hold are refused by name") {
  Pair pair;
  const auto complaint = [](const std::vector<fs::path>& paths) -> std::string {
    try {
      const Merge merge(paths);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  CHECK(complaint({pair.path(1), pair.path(2), pair.path(1)}) ==
        pair.path(1).string() + " is given twice");
  fs::copy_file(pair.path(1), pair.path(3));
  CHECK(complaint({pair.path(2), pair.path(3), pair.path(1)}) ==
        fmt::format("{} holds the same samples as {}: give one of them", pair.path(1).string(),
                    pair.path(3).string()));
  const RenderResult third =
      render_noise(pair.noise, 64, 2, share_of({2, 3}, noise_grid(64), false));
  write_part(pair.path(3), noise_header(pair.noise, 64, {2, 3}, third), third.film);
  CHECK(complaint({pair.path(1), pair.path(3)}) ==
        fmt::format("{} overlaps with {}: 8 of its 16 blocks of samples are in both",
                    pair.path(3).string(), pair.path(1).string()));
  CHECK(complaint({}).find("which parts") != std::string::npos);
}

TEST_CASE("A part that is none, cut short or spoilt is refused by name") {
  using Spoil = std::function<void(std::string&)>;
  const std::vector<std::pair<Spoil, std::string>> changes = {
      {[](std::string& b) { b.clear(); }, "it is no part"},
      {[](std::string& b) { b = "P6 1 1 255 abc and so on"; }, "it is no part"},
      {[](std::string& b) { b.replace(11, 1, "1"); }, "another version of Carlo ('carlo part 1')"},
      {[](std::string& b) { b.resize(20); }, "cut short"},
      {[](std::string& b) { b.resize(200); }, "cut short"},
      {[](std::string& b) { b.resize(b.size() / 2); }, "cut short"},
      {[](std::string& b) { b.pop_back(); }, "cut short"},
      {[](std::string& b) { b += "x"; }, "something was added"},
      {[](std::string& b) { b[20] = '\x7f'; }, "its header claims"},
      {[](std::string& b) { b[60] ^= 1; }, "header checksum mismatch"},
      {[](std::string& b) { b[b.size() - 1000] ^= 4; }, "checksum mismatch in the sums"},
      {[](std::string& b) { b[b.size() - 3] ^= 4; }, "checksum mismatch in the sums"},
      {[](std::string& b) { std::swap(b[b.size() - 999], b[b.size() - 1009]); },
       "checksum mismatch in the sums"},
  };
  for (const auto& [change, expected] : changes) {
    Pair pair;
    pair.spoil(change);
    INFO(pair.complaint() << " / " << expected);
    CHECK(pair.complaint().find(expected) != std::string::npos);
    CHECK(pair.complaint().find(pair.path(2).string()) != std::string::npos);
    CHECK(pair.complaint().find('\n') == std::string::npos);
  }
  Pair pair;
  fs::remove(pair.path(2));
  CHECK(pair.complaint().find("no such file") != std::string::npos);
}

TEST_CASE("A part that claims what cannot be is refused by name") {
  using Change = std::function<void(PartHeader&)>;
  const std::vector<std::pair<Change, std::string>> changes = {
      {[](PartHeader& p) { p.settings.erase("seed"); }, "setting 'seed' is missing"},
      {[](PartHeader& p) { p.settings["planned_spp"] = "all"; },
       "are not the all that were planned"},
      {[](PartHeader& p) { p.settings["planned_spp"] = "65"; }, "are not the 65 that were planned"},
      {[](PartHeader& p) { p.grid.passes = 2, p.settings["planned_spp"] = "16"; },
       "it has blocks up to 48 of 12"},
      {[](PartHeader& p) {
         p.shard = Shard{3, 2};
       },
       "it is shard 3/2"},
  };
  for (const auto& [change, expected] : changes) {
    Pair pair;
    pair.change(change);
    INFO(pair.complaint() << " / " << expected);
    CHECK(pair.complaint().find(expected) != std::string::npos);
  }
}

TEST_CASE("Every byte of a part counts") {
  Pair pair;
  const std::string bytes = read_file(pair.path(2));
  Rng rng(22, 0);
  for (int round = 0; round < 100; ++round) {
    std::string spoilt = bytes;
    const auto at =
        static_cast<std::size_t>(rng.uniform_float() * static_cast<float>(bytes.size()));
    const auto bit = static_cast<int>(rng.uniform_float() * 8);
    spoilt[at] = static_cast<char>(spoilt[at] ^ (1 << bit));
    write_file(pair.path(2), spoilt);
    INFO(at << " " << bit);
    CHECK(!pair.complaint().empty());
  }
}

}  // namespace
