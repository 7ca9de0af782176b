// Checks of exercises 3.1, 3.2 and 3.4: sequences that are known to the last bit.

#include "03_rng/sequences.h"
#include "03_rng/words.h"

#include <array>
#include <cmath>
#include <utility>

using namespace carlo::grader;
using namespace lab03_tests;

namespace {

const Diagnosis state_before{"returns-state-before-step",
                             "every number comes one call late: the state before the step is "
                             "returned."};
const Diagnosis wrong_modulus{"wrong-modulus",
                              "the numbers are those of another modulus: 2^31, or 2^32 - 1. "
                              "Unsigned 32-bit arithmetic is modulo 2^32 by itself."};
const Diagnosis one_step_off{"jump-off-by-one", "the jump is one step too long or too short."};
const Diagnosis step_by_step{"jumps-step-by-step",
                             "the time grows with n: the steps are made one by one."};
const Diagnosis summand_late{"jump-summand-after-factor",
                             "the summand of the doubled map needs the old factor; here it is "
                             "updated after the factor."};

constexpr std::uint32_t a = 1664525, b = 1013904223;

/// x -> (a x + b) mod c, from x0; the numbers after the first step or, if `late`, from x0 on.
std::vector<double> lcg(std::uint64_t x, std::int64_t n, std::uint64_t c = std::uint64_t{1} << 32,
                        bool late = false) {
  return generate(n, [&] {
    const std::uint64_t old = x;
    x = (a * x + b) % c;
    return static_cast<double>(late ? old : x);
  });
}

/// The number after n steps, by doubling; with the mistake, the new factor goes into the new
/// summand.
std::uint32_t after(std::uint32_t x0, std::uint64_t n, bool summand_after_factor = false) {
  std::uint32_t x = x0, factor = a, summand = b;
  for (std::uint64_t left = n; left != 0; left /= 2) {
    if (left % 2 == 1) x = factor * x + summand;
    const std::uint32_t squared = factor * factor;
    summand = (summand_after_factor ? squared : factor) * summand + summand;
    factor = squared;
  }
  return x;
}

Rows jumped(const std::string& name, std::uint32_t x0, std::uint64_t steps, std::size_t n) {
  Params params{.n = static_cast<std::int64_t>(n), .numbers = {{"x0", x0}}};
  set_wide_word(params, "steps", steps);
  return probe(name, params,
               {.rows = n,
                .finite = false,
                .of = fmt::format("{} step{} from x_0 = {}", steps, steps == 1 ? "" : "s", x0)});
}

void judge_jump(const std::string& name, std::uint32_t x0, std::uint64_t steps) {
  const std::uint32_t start = after(x0, steps);
  const Rows rows = jumped(name, x0, steps, 1);
  const auto number = [](std::uint32_t x) { return static_cast<double>(a * x + b); };
  Suspects suspects;
  if (steps > 1) {
    suspects = {{number(after(x0, steps - 1)), one_step_off},
                {number(after(x0, steps + 1)), one_step_off},
                {number(after(x0, steps, true)), summand_late}};
  }
  Verdict verdict =
      equals(fmt::format("the number after a jump of {} step{}", steps, steps == 1 ? "" : "s"),
             rows.at(0, 0), number(start), 0, suspects);
  if (std::isnan(rows.at(0, 0))) {
    verdict.measured = "not reached in time";
    verdict.diagnoses.push_back(step_by_step);
  }
  judge(verdict);
}

/// PCG32 as in its authors' C code, with several ways to get it wrong.
struct Pcg {
  enum class Slip {
    none,
    rotate_left,
    rotate_by_low_bits,
    no_rotation,
    no_xor,
    shift_of_18_only,
    cut_before_shift,
    output_after_step,
    plain_seed,
    no_first_step,
    no_last_step,
    plain_increment,
    even_increment,
    stream_or_one
  };
  Slip slip = Slip::none;
  std::uint64_t state = 0, increment = 1;

  Pcg(std::uint64_t seed, std::uint64_t stream, Slip slip_ = Slip::none) : slip(slip_) {
    increment = slip == Slip::plain_increment  ? stream
                : slip == Slip::even_increment ? 2 * stream
                : slip == Slip::stream_or_one  ? stream | 1
                                               : (stream << 1) | 1;
    if (slip == Slip::plain_seed) {
      state = seed;
      return;
    }
    if (slip != Slip::no_first_step) next();
    state += seed;
    if (slip != Slip::no_last_step) next();
  }

  std::uint32_t next() {
    const std::uint64_t old = state;
    state = old * 6364136223846793005ULL + increment;
    return output(slip == Slip::output_after_step ? state : old);
  }

  std::uint32_t output(std::uint64_t from) const {
    const auto turns =
        static_cast<std::uint32_t>(slip == Slip::rotate_by_low_bits ? from & 31 : from >> 59);
    const std::uint32_t mixed = mix(from);
    if (slip == Slip::no_rotation) return mixed;
    if (slip == Slip::rotate_left) return (mixed << turns) | (mixed >> ((32 - turns) & 31));
    return (mixed >> turns) | (mixed << ((32 - turns) & 31));
  }

  std::uint32_t mix(std::uint64_t from) const {
    if (slip == Slip::no_xor) return static_cast<std::uint32_t>((from >> 18) >> 27);
    const std::uint64_t strong = (from >> 18) ^ from;
    if (slip == Slip::shift_of_18_only) return static_cast<std::uint32_t>(strong);
    if (slip == Slip::cut_before_shift) return static_cast<std::uint32_t>(strong) >> 27;
    return static_cast<std::uint32_t>(strong >> 27);
  }
};

std::vector<double> pcg(std::uint64_t seed, std::uint64_t stream, std::int64_t n,
                        Pcg::Slip slip = Pcg::Slip::none) {
  Pcg generator(seed, stream, slip);
  return generate(n, [&] { return static_cast<double>(generator.next()); });
}

const std::vector<std::pair<Pcg::Slip, Diagnosis>>& pcg_diagnoses() {
  using Slip = Pcg::Slip;
  static const std::vector<std::pair<Slip, Diagnosis>> all = {
      {Slip::rotate_left, {"rotates-left", "the 32 bits are rotated to the left."}},
      {Slip::rotate_by_low_bits,
       {"rotates-by-low-bits",
        "the lowest five bits are used as the rotation; it is given by "
        "the top five."}},
      {Slip::no_rotation, {"rotation-missing", "the 32 bits are not rotated."}},
      {Slip::no_xor,
       {"xor-missing", "the state shifted by 18 is not combined with the state itself."}},
      {Slip::shift_of_18_only, {"second-shift-missing", "the shift by 27 is left out."}},
      {Slip::cut_before_shift,
       {"cut-before-the-shift",
        "the state is cut to 32 bits before the shift by 27, which leaves five bits; the shift "
        "comes first."}},
      {Slip::output_after_step,
       {"output-from-new-state", "the output is made from the state after the step."}},
      {Slip::plain_seed,
       {"seed-taken-as-state",
        "the seed is used as the state; the generator has to step before "
        "and after adding it."}},
      {Slip::no_first_step,
       {"first-step-missing", "the step before the seed is added is left out."}},
      {Slip::no_last_step, {"last-step-missing", "the step after the seed was added is left out."}},
      {Slip::plain_increment,
       {"increment-not-odd", "the increment is the stream itself; 2 stream + 1 is always odd."}},
      {Slip::even_increment,
       {"increment-not-odd", "the increment is 2 stream; 2 stream + 1 is always odd."}},
      {Slip::stream_or_one,
       {"streams-in-pairs",
        "the increment is the stream with its lowest bit set: streams 2 i and 2 i + 1 are the "
        "same. It is 2 stream + 1."}}};
  return all;
}

std::vector<Alternative> pcg_slips(std::uint64_t seed, std::uint64_t stream, std::int64_t n) {
  std::vector<Alternative> slips;
  for (const auto& [slip, diagnosis] : pcg_diagnoses())
    slips.push_back({pcg(seed, stream, n, slip), diagnosis});
  return slips;
}

Rows pcg_rows(std::uint64_t seed, std::uint64_t stream, std::int64_t n) {
  Params params{.n = n};
  set_wide_word(params, "seed", seed);
  set_wide_word(params, "stream", stream);
  return probe("Lab 3.4 numbers", params,
               {.rows = static_cast<std::size_t>(n),
                .of = fmt::format("{} numbers, seed {:#x}, stream {:#x}", n, seed, stream)});
}

}  // namespace

// Press, Teukolsky, Vetterling, Flannery, "Numerical Recipes in C", 2nd edition, section 7.1.
TEST_CASE("Lab 3.1: the sequence printed in Numerical Recipes comes out", "[lab03][ex1]") {
  const std::vector<double> expected = {0x3C6EF35F, 0x47502932, 0xD1CCF6E9, 0xAAF95334, 0x6252E503,
                                        0x9F2EC686, 0x57FE6C2D, 0xA3D95FA8, 0x81FDBEE7, 0x94F0AF1A};
  const Rows rows = probe("Lab 3.1 numbers", {.n = 10, .numbers = {{"x0", 0}}}, {.rows = 10});
  judge(sequence_is("the numbers from x_0 = 0", rows.values, expected,
                    {{lcg(0, 10, std::uint64_t{1} << 32, true), state_before},
                     {lcg(0, 10, std::uint64_t{1} << 31), wrong_modulus},
                     {lcg(0, 10, 0xFFFFFFFF), wrong_modulus}},
                    Digits::hexadecimal));
}

TEST_CASE("Lab 3.1: x_{n+1} = (a x_n + b) mod 2^32 from any seed", "[lab03][ex1]") {
  for (const double x0 : {1.0, 2147483648.0, 4294967295.0, 123456789.0}) {
    const auto seed = static_cast<std::uint64_t>(x0);
    const Rows rows =
        probe("Lab 3.1 numbers", {.n = 10'000, .numbers = {{"x0", x0}}}, {.rows = 10'000});
    judge(sequence_is(fmt::format("the numbers from x_0 = {}", seed), rows.values,
                      lcg(seed, 10'000),
                      {{lcg(seed, 10'000, std::uint64_t{1} << 32, true), state_before},
                       {lcg(seed, 10'000, std::uint64_t{1} << 31), wrong_modulus},
                       {lcg(seed, 10'000, 0xFFFFFFFF), wrong_modulus}}));
  }
}

// 2^28 single steps take a quarter of a second; jumps take microseconds. The limit is far from
// both.
TEST_CASE("Lab 3.2: a jump takes O(log n) steps", "[lab03][ex2][efficiency]") {
  const Rows rows = probe("Lab 3.2 cost", {}, {});
  judge(holds("the time of jumps over 2^28 numbers", rows.at(0, 0) <= 0.05,
              fmt::format("{:.3g} s", rows.at(0, 0)), "less than 0.05 s", {step_by_step}));
}

TEST_CASE("Lab 3.2: a jump of n steps ends where n calls of next() end", "[lab03][ex2]") {
  for (const std::uint64_t steps : {0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u, 100u, 65536u, 1'000'003u})
    judge_jump("Lab 3.2 jump", 42, steps);
  judge_jump("Lab 3.2 jump", 4294967295, 12345);
}

TEST_CASE("Lab 3.2: the sequence goes on after a jump", "[lab03][ex2]") {
  const Rows rows = jumped("Lab 3.2 jump", 7, 1000, 100);
  judge(sequence_is(
      "the numbers after a jump of 1000 steps", rows.values, lcg(after(7, 1000), 100),
      {{lcg(after(7, 999), 100), one_step_off}, {lcg(after(7, 1001), 100), one_step_off}}));
}

// The period is 2^32: a whole one changes nothing, and one step less is a step back.
TEST_CASE("Lab 3.2: jumps may be longer than the period", "[lab03][ex2]") {
  for (const std::uint64_t steps :
       {std::uint64_t{0xFFFFFFFF}, std::uint64_t{1} << 32, (std::uint64_t{1} << 32) + 5,
        (std::uint64_t{1} << 63) + 11, ~std::uint64_t{0}})
    judge_jump("Lab 3.2 long jump", 42, steps);
}

// The demonstration program of the reference implementation, www.pcg-random.org, prints these for
// seed 42 and stream 54.
TEST_CASE("Lab 3.4: the numbers of PCG's demonstration program come out", "[lab03][ex4]") {
  const std::vector<double> expected = {0xa15c02b7, 0x7b47f409, 0xba1d3330,
                                        0x83d2f293, 0xbfa4784b, 0xcbed606e};
  judge(sequence_is("the numbers of seed 42, stream 54", pcg_rows(42, 54, 6).values, expected,
                    pcg_slips(42, 54, 6), Digits::hexadecimal));
}

TEST_CASE("Lab 3.4: any seed and any stream, for thousands of numbers", "[lab03][ex4]") {
  const std::array<std::array<std::uint64_t, 2>, 5> cases = {
      {{0, 0},
       {1, 1},
       {~std::uint64_t{0}, 3},
       {0x0123456789ABCDEF, 0xFEDCBA987654321},
       {5, ~std::uint64_t{0}}}};
  std::vector<Rows> all;
  for (const auto& [seed, stream] : cases)
    all.push_back(pcg_rows(seed, stream, 5000));
  // Some mistakes look alike for some seeds: only those that fit all sequences are reported.
  std::vector<std::pair<Pcg::Slip, Diagnosis>> fitting;
  for (const auto& candidate : pcg_diagnoses()) {
    bool fits = true;
    for (std::size_t i = 0; i < cases.size(); ++i)
      fits = fits && all[i].values == pcg(cases[i][0], cases[i][1], 5000, candidate.first);
    if (fits) fitting.push_back(candidate);
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto [seed, stream] = cases[i];
    Verdict verdict = sequence_is(fmt::format("the numbers of seed {}, stream {}", seed, stream),
                                  all[i].values, pcg(seed, stream, 5000), {}, Digits::hexadecimal);
    if (!verdict.passed) {
      for (const auto& [slip, diagnosis] : fitting)
        verdict.diagnoses.push_back(diagnosis);
    }
    judge(verdict);
  }
}
