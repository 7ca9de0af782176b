#include "common/noise_integrator.h"
#include "common/temporary_folder.h"
#include "random/rng.h"
#include "render/splats.h"
#include "renderer/production/adaptive.h"
#include "renderer/production/resume.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace carlo;
using common_test::TemporaryFolder;
namespace fs = std::filesystem;

constexpr int width = 37, height = 21;  // not multiples of tiles or units

/// Pixels that differ in brightness and, a hundredfold, in variance; about .1 reaches each of them
/// by light paths.
class Flicker final : public common_test::NoiseIntegrator {
 public:
  double light_paths() const override { return 1; }
  double splat_unit(std::uint64_t /*paths*/) const override { return 0x1p-20; }
  void trace_light_paths(const LightPaths& paths, Splats& splats, Counts& counts) const override {
    constexpr std::uint64_t pixels = std::uint64_t{width} * height;
    for (std::uint64_t path = paths.first; path < paths.first + paths.count; ++path) {
      Rng rng(stream_seed(6, paths.stream), path);
      const double splat = 0.1 * (0.5 + rng.uniform()) * static_cast<double>(pixels);
      const auto units = static_cast<std::int64_t>(splat / splats.unit());
      splats.add(path % pixels, {units, units, units});
    }
    counts.light_paths += paths.count;
    counts.rays += paths.count;
  }

 private:
  void sample(const Tile& tile, int x, int y, BlockSum& sum, Counts& counts) const override {
    for (std::uint32_t s = 0; s < tile.samples; ++s) {
      Rng rng(stream_seed(5, tile.stream),
              static_cast<std::uint64_t>(y * width + x) << 32 | (tile.first_sample + s));
      const float u = rng.uniform_float();
      const float spread = static_cast<float>(1 + x % 10) / 10;
      sum.add(static_cast<float>(1 + y) * Rgb(1 + spread * (u - 0.5f), u, spread), counts);
    }
  }
};

constexpr double target = 0.02;
constexpr std::uint32_t most = 2048;

AdaptiveOptions options(const EarlierAdaptive* earlier = nullptr) {
  return {.threads = 2, .progress = false, .earlier = earlier};
}

AdaptiveResult run(const Flicker& flicker, std::uint32_t spp = most,
                   const EarlierAdaptive* earlier = nullptr) {
  return render_adaptively(flicker, width, height, {target, spp, {}}, options(earlier));
}

RenderSettings settings() {
  Scene scene;
  scene.width = width;
  scene.height = height;
  RenderSettings result = render_settings(scene, "flicker", 3, adaptive_strata, {});
  result["target_error"] = "0.02";
  return result;
}

ExrFile file_of(const AdaptiveResult& result) {
  ExrFile file{result.film.mean(), result.film.standard_error()};
  add_sums(file, settings(), *result.state, result.counts);
  return file;
}

EarlierAdaptive read(const fs::path& path) {
  const EarlierRender earlier(path);
  earlier.require_same(settings());
  CHECK(earlier.target_error() == target);
  return {earlier.adaptive_state(), earlier.counts()};
}

/// Returns the result after writing it to a file and reading it back.
EarlierAdaptive written_and_read(const AdaptiveResult& result) {
  const TemporaryFolder folder;
  write_exr(folder.path() / "a.exr", file_of(result));
  return read(folder.path() / "a.exr");
}

void check_same(const AdaptiveResult& a, const AdaptiveResult& b) {
  CHECK(a.film.mean().pixels == b.film.mean().pixels);
  CHECK(a.film.standard_error().pixels == b.film.standard_error().pixels);
  CHECK(a.film.samples() == b.film.samples());
  CHECK(a.counts.paths == b.counts.paths);
  CHECK(a.counts.light_paths == b.counts.light_paths);
  CHECK(a.counts.rays == b.counts.rays);
  CHECK(a.summary.within == b.summary.within);
  CHECK(a.summary.decided_only == b.summary.decided_only);
  CHECK(a.summary.capped == b.summary.capped);
}

TEST_CASE("An interrupted adaptive render that is resumed has the bits of an undisturbed one") {
  const Flicker undisturbed;
  const AdaptiveResult whole = run(undisturbed);
  REQUIRE(whole.summary.least < whole.summary.most);
  const int calls = undisturbed.calls;
  // In the first round, in the second (a round is 12 jobs of 8 calls), in a late one, in the last.
  for (const int call : {1, 60, 100, 191, calls / 2, calls - 1}) {
    INFO("call " << call << " of " << calls);
    Flicker flicker;
    flicker.interrupt_at = call;
    const AdaptiveResult part = run(flicker);
    REQUIRE(part.interrupted);
    const EarlierAdaptive start = written_and_read(part);
    CHECK(start.state.film().mean().pixels == part.film.mean().pixels);
    check_same(run(Flicker(), most, &start), whole);
  }
}

/// Checks that two states are the same to the last bit; returns the number of units for which only
/// one half has decided.
int check_same_state(const AdaptiveState& a, const AdaptiveState& b) {
  CHECK(a.level == b.level);
  CHECK(a.floors == b.floors);
  CHECK(a.expected_paths == b.expected_paths);
  REQUIRE(a.units.size() == b.units.size());
  int one_half = 0;
  for (std::size_t i = 0; i < a.units.size(); ++i) {
    CHECK(a.units[i].fell == b.units[i].fell);
    CHECK(a.units[i].noise == b.units[i].noise);
    one_half += a.units[i].fell[0] != a.units[i].fell[1] ? 1 : 0;
  }
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t i = 0; i < a.halves[half].size(); ++i) {
      const HalfPixel &p = a.halves[half][i], &q = b.halves[half][i];
      CHECK(p.finished() == q.finished());
      CHECK(p.seen().mean() == q.seen().mean());
      CHECK(p.seen().variance() == q.seen().variance());
      CHECK(p.estimate(3).samples() == q.estimate(3).samples());
    }
  }
  return one_half;
}

TEST_CASE("All that an adaptive render decides by survives in its file") {
  const Flicker undisturbed;
  run(undisturbed);
  int one_half = 0;
  for (const int eighth : {3, 4, 5, 6, 7}) {
    Flicker flicker;
    flicker.interrupt_at = undisturbed.calls * eighth / 8;
    const AdaptiveResult part = run(flicker);
    CHECK(part.state->units[0].noise[0] > 0);
    one_half += check_same_state(written_and_read(part).state, *part.state);
  }
  CHECK(one_half >= 1);
}

TEST_CASE("An adaptive render may be interrupted as often as one likes") {
  const AdaptiveResult whole = run(Flicker());
  AdaptiveResult part = run(Flicker(), 64);
  int times = 0;
  for (; times < 100; ++times) {
    const EarlierAdaptive start = written_and_read(part);
    Flicker flicker;
    flicker.interrupt_at = 45;
    part = run(flicker, most, &start);
    if (!part.interrupted) break;
  }
  CHECK(times >= 5);
  check_same(part, whole);
}

TEST_CASE("Checkpoints of an adaptive render are renders to go on from") {
  const AdaptiveResult whole = run(Flicker());
  std::vector<AdaptiveResult> kept;
  AdaptiveOptions often = options();
  often.checkpoint = [&](const AdaptiveResult& r) { kept.push_back(r); };
  often.checkpoint_seconds = 0;
  check_same(render_adaptively(Flicker(), width, height, {target, most, {}}, often), whole);
  REQUIRE(kept.size() >= 6);
  for (const AdaptiveResult& checkpoint : kept) {
    const EarlierAdaptive start = written_and_read(checkpoint);
    check_same(run(Flicker(), most, &start), whole);
  }
}

TEST_CASE("An adaptive render that its limit ended goes on with a higher one") {
  for (const std::uint32_t limit : {64u, 96u, 300u}) {
    const EarlierAdaptive start = written_and_read(run(Flicker(), limit));
    check_same(run(Flicker(), most, &start), run(Flicker(), most));
  }
}

TEST_CASE("A finished adaptive render has nothing to go on with") {
  const AdaptiveResult whole = run(Flicker(), 1u << 16);
  REQUIRE(whole.summary.capped == 0);
  const EarlierAdaptive start = written_and_read(whole);
  const Flicker flicker;
  check_same(run(flicker, 1u << 16, &start), whole);
  CHECK(flicker.calls == 0);
}

TEST_CASE("An adaptive render does not go on from another one") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.exr";
  const AdaptiveResult result = run(Flicker(), 256);
  // With a limit of 32 samples per pixel the rounds differ.
  const EarlierAdaptive start{*result.state}, few{*run(Flicker(), 32).state};
  CHECK_THROWS_AS(run(Flicker(), most, &few), Error);
  CHECK_THROWS_AS(run(Flicker(), 32, &start), Error);
  CHECK_THROWS_AS(
      render_adaptively(Flicker(), width, height + 1, {target, most, {}}, options(&start)), Error);

  ExrFile retouched = file_of(result);
  retouched.image.at(5, 5).r += 1;
  write_exr(path, retouched);
  CHECK_THROWS_AS(EarlierRender(path).adaptive_state(), Error);

  const auto refused = [&](const char* name, const char* text) {
    ExrFile file = file_of(result);
    file.attributes[name] = text;
    write_exr(path, file);
    CHECK_THROWS_AS(EarlierRender(path).adaptive_state(), Error);
  };
  for (const char* text : {"", "-1", "nan", "3x"}) {
    refused("adaptive_round", text);
    refused("adaptive_floor_A", text);
  }
  refused("adaptive_round", "1e9");
  refused("adaptive_round", "2.5");

  const auto refused_value = [&](const std::string& channel, double value, const char* word) {
    ExrFile file = file_of(result);
    const auto bits = std::bit_cast<std::uint64_t>(value);
    file.counts.at("adaptive.A." + channel + ".0")[0] = static_cast<std::uint32_t>(bits);
    file.counts.at("adaptive.A." + channel + ".1")[0] = static_cast<std::uint32_t>(bits >> 32);
    write_exr(path, file);
    CHECK_THROWS_WITH(EarlierRender(path).adaptive_state(),
                      Catch::Matchers::ContainsSubstring(word));
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {0x1p700, 0x1p54, -1.0, 1.5, nan}) {
    refused_value("R.samples", value, "samples");
    refused_value("seen.samples", value, "samples");
  }
  refused_value("seen.sum", nan, "sum");
  refused_value("seen.squares", -1, "squared");

  ExrFile incomplete = file_of(result);
  incomplete.counts.erase("adaptive.B.Y.sum.1");
  write_exr(path, incomplete);
  CHECK_THROWS_AS(EarlierRender(path), Error);
}

/// Renders a share of the round after `start`; the second share is interrupted and continued.
EarlierAdaptive round_share(const EarlierAdaptive& start, const Shard& share) {
  EarlierAdaptive before{start.state};
  AdaptiveOptions how = options(&before);
  how.share = share;
  Flicker flicker;
  if (share.index == 2) flicker.interrupt_at = 5;
  const AdaptiveGoal goal{target, most, {}};
  AdaptiveResult result = render_adaptively(flicker, width, height, goal, how);
  if (result.interrupted) {
    before = {*result.state, result.counts};
    result = render_adaptively(Flicker(), width, height, goal, how);
  }
  result.state = std::make_shared<const AdaptiveState>(round_part(*result.state, start.state));
  result.film = result.state->film();
  return written_and_read(result);
}

/// Renders a round in shares and takes its decisions.
AdaptiveResult shared_round(const EarlierAdaptive& start, std::uint32_t shares) {
  EarlierAdaptive all = start;
  for (std::uint32_t i = 1; i <= shares; ++i) {
    const EarlierAdaptive part = round_share(start, {i, shares});
    add_round_part(all.state, part.state);
    all.counts += part.counts;
    if (i > 1) continue;
    CHECK_THROWS_WITH(add_round_part(all.state, part.state),
                      Catch::Matchers::ContainsSubstring("there already"));
  }
  AdaptiveOptions decision = options(&all);
  decision.one_round = true;
  const Flicker idle;
  AdaptiveResult result = render_adaptively(idle, width, height, {target, most, {}}, decision);
  CHECK(idle.calls == 0);  // nothing is left to render
  return result;
}

TEST_CASE("An adaptive render whose rounds are shared out has the bits of one that is not") {
  const AdaptiveResult whole = run(Flicker());
  for (const std::uint32_t shares : {1u, 3u, 50u}) {
    INFO(shares << " shares");
    EarlierAdaptive result{AdaptiveState(width, height)};
    int rounds = 0;
    while (!all_rounds_done(result.state, most)) {
      result = written_and_read(shared_round(result, shares));
      ++rounds;
    }
    CHECK(rounds > 3);
    check_same_state(result.state, *whole.state);
    CHECK(result.state.film().mean().pixels == whole.film.mean().pixels);
    CHECK(result.counts.paths == whole.counts.paths);
    CHECK(result.counts.light_paths == whole.counts.light_paths);
  }
  AdaptiveState other(width, height);
  other.level = 1;
  AdaptiveState base(width, height);
  CHECK_THROWS_WITH(add_round_part(base, other),
                    Catch::Matchers::ContainsSubstring("it is of round 1"));
}

}  // namespace
