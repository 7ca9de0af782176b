#include "renderer/production/resume.h"

#include "common/noise_integrator.h"
#include "common/temporary_folder.h"
#include "random/rng.h"
#include "render/driver.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace carlo;
using common_test::TemporaryFolder;
namespace fs = std::filesystem;

constexpr int width = 37, height = 21;  // 6 tiles

/// Samples over five orders of magnitude.
class Noise final : public common_test::NoiseIntegrator {
  void sample(const Tile& tile, int x, int y, BlockSum& sum, Counts& counts) const override {
    for (std::uint32_t s = 0; s < tile.samples; ++s) {
      Rng rng(3, static_cast<std::uint64_t>(y * width + x) << 32 | (tile.first_sample + s));
      const float u = rng.uniform_float();
      sum.add({std::pow(10.0f, 5 * u - 4), u, 0}, counts);
    }
  }
};

RenderResult run(const Noise& noise, std::uint32_t spp, const RenderResult* earlier = nullptr) {
  return render(noise, width, height,
                {.spp = spp, .threads = 2, .progress = false, .earlier = earlier});
}

Scene scene() {
  Scene s;
  s.width = width;
  s.height = height;
  return s;
}

RenderSettings settings() {
  return render_settings(scene(), "noise", 3, 64, {"a=1"});
}

void write(const fs::path& path, const RenderResult& result) {
  ExrFile file{result.film.mean(), result.film.standard_error()};
  add_sums(file, settings(), result.film, result.counts);
  write_exr(path, file);
}

RenderResult read(const fs::path& path) {
  const EarlierRender earlier(path);
  earlier.require_same(settings());
  RenderResult result{.film = earlier.film(), .counts = earlier.counts()};
  return result;
}

bool same(const Film& a, const Film& b) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (!(a.sums(x, y).sum[c] == b.sums(x, y).sum[c])) return false;
        if (!(a.sums(x, y).squares[c] == b.sums(x, y).squares[c])) return false;
      }
    }
  }
  return a.samples() == b.samples();
}

TEST_CASE("An interrupted render that is resumed has the bits of an undisturbed one") {
  const TemporaryFolder scratch;
  const RenderResult whole = run(Noise(), 64);
  for (const int tile : {2, 6, 20, 47}) {  // of 48
    Noise noise;
    noise.interrupt_at = tile;
    const RenderResult part = run(noise, 64);
    REQUIRE(part.interrupted);
    write(scratch.path() / "a.exr", part);
    const RenderResult start = read(scratch.path() / "a.exr");
    CHECK(same(start.film, part.film));
    const RenderResult resumed = run(Noise(), 64, &start);
    CHECK(same(resumed.film, whole.film));
    CHECK(resumed.counts.paths == whole.counts.paths);
    CHECK(resumed.film.mean().pixels == whole.film.mean().pixels);
  }
}

TEST_CASE(
    "Renders by a version that did not count light paths are refused, not continued without") {
  const TemporaryFolder scratch;
  const RenderResult result = run(Noise(), 64);
  for (const char* lacking : {"light_paths", "light_path_ties"}) {
    ExrFile file{result.film.mean(), result.film.standard_error()};
    add_sums(file, settings(), result.film, result.counts);
    file.attributes.erase(lacking);
    write_exr(scratch.path() / "a.exr", file);
    CHECK_THROWS_WITH(
        read(scratch.path() / "a.exr"),
        Catch::Matchers::ContainsSubstring(fmt::format("setting '{}' is missing", lacking)));
  }
}

TEST_CASE("What -D gave is in the render") {
  const TemporaryFolder scratch;
  const fs::path path = scratch.path() / "a.exr";
  const RenderResult result = run(Noise(), 64);
  write(path, result);
  const std::vector<std::string> given{"a=1"};
  CHECK(EarlierRender(path).definitions() == given);
  const auto with = [&](const char* text) {
    ExrFile file{result.film.mean(), result.film.standard_error()};
    add_sums(file, settings(), result.film, result.counts);
    file.attributes["definitions"] = text;
    write_exr(path, file);
    return EarlierRender(path).definitions();
  };
  CHECK(with("{\"definitions\": [\"a=1\"]}") == given);
  for (const char* spoilt :
       {"", "[]", "[\"a=1\"]", "[1]", "[", "{}", "{\"definitions\": 1}", "[], 1"}) {
    INFO(spoilt);
    CHECK_THROWS_AS(with(spoilt), Error);
  }
}

TEST_CASE("A finished render is extended: the same mean, an error estimate from its own blocks") {
  const TemporaryFolder scratch;
  write(scratch.path() / "a.exr", run(Noise(), 64));
  const RenderResult start = read(scratch.path() / "a.exr");
  const RenderResult extended = run(Noise(), 256, &start);
  const RenderResult whole = run(Noise(), 256);
  CHECK(extended.film.block() == 8);
  CHECK(whole.film.block() == 32);
  CHECK(extended.film.samples() == whole.film.samples());
  CHECK(extended.film.mean().pixels == whole.film.mean().pixels);
}

TEST_CASE("A checkpoint is a render to go on from") {
  const TemporaryFolder scratch;
  int count = 0;
  const Noise noise;
  const RenderResult whole = render(noise, width, height,
                                    {.spp = 64,
                                     .threads = 2,
                                     .progress = false,
                                     .checkpoint =
                                         [&](const RenderResult& r) {
                                           if (++count == 3) write(scratch.path() / "a.exr", r);
                                         },
                                     .checkpoint_seconds = 0});
  CHECK(count == 7);  // eight passes; after the last comes the result
  const RenderResult start = read(scratch.path() / "a.exr");
  CHECK(start.film.samples() == std::uint64_t{width} * height * 24);
  CHECK(same(run(noise, 64, &start).film, whole.film));
}

TEST_CASE("Nobody goes on from another render, nor from what is no render") {
  const TemporaryFolder scratch;
  const fs::path path = scratch.path() / "a.exr";
  const RenderResult result = run(Noise(), 8);
  write(path, result);
  for (const char* name :
       {"scene_digest", "seed", "sampler", "max_depth", "planned_spp", "kernel"}) {
    RenderSettings other = settings();
    other[name] += "1";
    CHECK_THROWS_AS(EarlierRender(path).require_same(other), Error);
  }

  ExrFile retouched{result.film.mean(), result.film.standard_error()};
  add_sums(retouched, settings(), result.film, result.counts);
  retouched.image.at(5, 5).r += 1;
  write_exr(path, retouched);
  CHECK_THROWS_AS(EarlierRender(path).film(), Error);

  write_exr(path, {result.film.mean()});
  CHECK_THROWS_AS(EarlierRender(path), Error);
  write(path, result);
  const std::string bytes = read_file(path);
  for (const std::size_t length : {std::size_t{0}, std::size_t{100}, bytes.size() / 2}) {
    write_file(path, bytes.substr(0, length));
    CHECK_THROWS_AS(EarlierRender(path), Error);
  }
}

}  // namespace
