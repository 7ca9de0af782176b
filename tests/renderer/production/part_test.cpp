#include "renderer/production/part.h"

#include "common/temporary_folder.h"
#include "random/rng.h"
#include "renderer/production/merge.h"
#include "renderer/production/state_exr.h"
#include "shard_noise.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <filesystem>
#include <functional>
#include <optional>
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
    CHECK(sum_of_words(words_of(sum)) == sum);
  }
  for (const char* spoilt : {"", "1 2 3 4 5 6", "1 2 3 4 5 6 7 8", "1 2 3 4 5 6 a",
                             "1 2 3 4 5 6 -7", "1 2 3 4 5 6 7 ", "1 2 3 4 5 6 4294967296"}) {
    INFO(spoilt);
    CHECK(!sum_of_words(spoilt));
  }
}

/// Shards 1/2 and 2/2 of the noise in files, with ways to spoil the second.
struct Pair {
  Pair() : noise(false) {
    for (const std::uint32_t i : {1u, 2u}) {
      results.push_back(render_noise(noise, 64, 2, share_of({i, 2}, noise_grid(64), false)));
      parts.push_back(noise_part(noise, 64, {i, 2}, results.back()));
      write_part(path(i), noise_settings(64), parts.back(), results.back());
    }
  }
  fs::path path(std::uint32_t i) const { return scratch.path() / fmt::format("{}.exr", i); }
  /// Writes the second with changed settings or claims.
  void change(const std::function<void(RenderSettings&)>& changed) {
    RenderSettings settings = noise_settings(64);
    changed(settings);
    write_part(path(2), settings, parts[1], results[1]);
  }
  void claim(const std::function<void(RenderSettings&, Part&)>& changed) {
    RenderSettings settings = noise_settings(64);
    Part part = parts[1];
    changed(settings, part);
    write_part(path(2), settings, part, results[1]);
  }
  /// Writes the second with changed bytes.
  void spoil(const std::function<void(std::string&)>& spoilt) {
    std::string bytes = read_file(path(2));
    spoilt(bytes);
    write_file(path(2), bytes);
  }
  /// The error of merging both; "" if there is none.
  std::string complaint() const {
    try {
      merged = Merge({path(1), path(2)}).run();
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }

  TemporaryFolder scratch;
  ShardNoise noise;
  std::vector<Part> parts;
  std::vector<RenderResult> results;
  mutable std::optional<RenderResult> merged;
};

TEST_CASE("Another render's part is refused by name") {
  using Change = std::function<void(RenderSettings&)>;
  const std::vector<std::pair<Change, std::string>> changes = {
      {[](auto& s) { s["scene_digest"] = "2"; }, "its scene is 2, the other's 1"},
      {[](auto& s) { s["seed"] = "2"; }, "its seed is 2, the other's 1"},
      {[](auto& s) { s["sampler"] = "2"; }, "its sampler is 2"},
      {[](auto& s) { s["max_depth"] = "2"; }, "its max_depth is 2"},
      {[](auto& s) { s["kernel"] = "2"; }, "its kernel is 2, the other's noise"},
      {[](auto& s) { s["version"] = "2"; }, "its version is 2"},
      {[](auto& s) { s["planned_spp"] = "72"; }, "its planned_spp is 72, the other's 64"},
  };
  Pair pair;
  CHECK(pair.complaint().empty());
  pair.change([](auto& s) { s["definitions"] = "[\"a=1\"]"; });  // -D is part of the scene
  CHECK(pair.complaint().empty());
  for (const auto& [change, expected] : changes) {
    pair.change(change);
    INFO(pair.complaint());
    CHECK(pair.complaint().find(expected) != std::string::npos);
    CHECK(pair.complaint().starts_with(pair.path(2).string()));
  }
  // The film's size is that of the file.
  RenderResult wider{.film = Film(38, 21, 8)};
  write_part(pair.path(2), noise_settings(64), pair.parts[1], wider);
  CHECK(pair.complaint().find("its film is 38 x 21, the other's 37 x 21") != std::string::npos);
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
  write_part(pair.path(3), noise_settings(64), noise_part(pair.noise, 64, {2, 3}, third), third);
  CHECK(complaint({pair.path(1), pair.path(3)}) ==
        fmt::format("{} overlaps with {}: 8 of its 16 blocks of samples are in that, too",
                    pair.path(3).string(), pair.path(1).string()));
  CHECK(complaint({}).find("which parts") != std::string::npos);
}

TEST_CASE("A part that is none, cut short or spoilt is refused by name") {
  using Spoil = std::function<void(std::string&)>;
  const std::vector<std::pair<Spoil, std::string>> changes = {
      {[](std::string& b) { b.clear(); }, "it is no EXR"},
      {[](std::string& b) { b = "P6 1 1 255 abc and so on"; }, "it is no EXR"},
      {[](std::string& b) { b.resize(20); }, "cut short"},
      {[](std::string& b) { b.resize(200); }, "cut short"},
      {[](std::string& b) { b.resize(b.size() / 2); }, "cannot read"},
      {[](std::string& b) { b.resize(b.size() - 1); }, "cannot read"},
      {[](std::string& b) { b.replace(b.find("\"threads\""), 5, "\"thread"); }, "cannot read"},
      {[](std::string& b) { b[b.find("\"parts\":\"1") + 9] = '2'; }, "it is spoilt"},
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
  // An image without sums, and a render that is not a part.
  write_exr(pair.path(2), {pair.results[1].film.mean()});
  CHECK(pair.complaint().find("not the sums") != std::string::npos);
  ExrFile whole{.image = pair.results[1].film.mean()};
  add_state(whole, noise_settings(64), pair.results[1].film, pair.results[1].counts);
  write_state(pair.path(2), whole);
  CHECK(pair.complaint().find("it is no part of a render") != std::string::npos);
}

TEST_CASE("A part that claims what cannot be is refused by name") {
  using Change = std::function<void(RenderSettings&, Part&)>;
  const std::vector<std::pair<Change, std::string>> changes = {
      {[](auto& s, auto&) { s.erase("version"); }, "does not tell its version"},
      {[](auto& s, auto&) { s["planned_spp"] = "all"; }, "its planned_spp is 'all'"},
      {[](auto& s, auto&) { s["planned_spp"] = "65"; }, "are not the 65 that were planned"},
      {[](auto& s, auto&) { s["planned_spp"] = "16"; }, "it has blocks up to 48 of 12"},
      {[](auto&, auto& p) {
         p.shard = Shard{3, 2};
       },
       "it is shard 3/2"},
      {[](auto&, auto& p) { p.least_light_chance = 2; }, "its chance to ask a light is 2"},
  };
  for (const auto& [change, expected] : changes) {
    Pair pair;
    pair.claim(change);
    INFO(pair.complaint() << " / " << expected);
    CHECK(pair.complaint().find(expected) != std::string::npos);
  }
}

TEST_CASE("A byte of a part that is another is found, or says nothing") {
  Pair pair;
  REQUIRE(pair.complaint().empty());
  const RenderResult right = *pair.merged;
  const std::string bytes = read_file(pair.path(2));
  Rng rng(22, 0);
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    std::string spoilt = bytes;
    const auto at =
        static_cast<std::size_t>(rng.uniform_float() * static_cast<float>(bytes.size()));
    const auto bit = static_cast<int>(rng.uniform_float() * 8);
    spoilt[at] = static_cast<char>(spoilt[at] ^ (1 << bit));
    write_file(pair.path(2), spoilt);
    INFO(at << " " << bit);
    const std::string complaint = pair.complaint();
    CHECK(complaint.find('\n') == std::string::npos);
    // OpenEXR has attributes that we do not use, such as a date.
    if (complaint.empty()) CHECK(same_sums(pair.merged->film, right.film));
    found += complaint.empty() ? 0 : 1;
  }
  CHECK(found >= 180);
}

}  // namespace
