// Probes of lab 3's exercises that use random words: 3.5 to 3.8.

#include "03_rng/words.h"
#include "grader/worker/probe.h"
#include "random/rng.h"
#include "rng.h"

#include <csetjmp>
#include <csignal>
#include <limits>

using namespace lab03_tests;
using carlo::grader::Rows;

namespace {

sigjmp_buf after_division;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

extern "C" void leave_division(int) {
  siglongjmp(after_division, 1);
}

/// Calls f; returns false if it divided a whole number by zero, on processors that trap this. f's
/// resources are lost then, so a probe that gets false should do little more than report it.
template <class F>
bool divides_well(const F& f) {
  struct sigaction action {};
  struct sigaction before {};
  action.sa_handler = leave_division;
  sigaction(SIGFPE, &action, &before);
  const bool good = sigsetjmp(after_division, 1) == 0;  // NOLINT(cert-err52-cpp)
  if (good) f();
  sigaction(SIGFPE, &before, nullptr);
  return good;
}

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double divided_by_zero = -std::numeric_limits<double>::infinity();

/// Thrown by a source that was asked for far too many words.
struct Exhausted {};

}  // namespace

PROBE("Lab 3.5 unit", "float",
      "(of the words 0 to 4095, of n words between, of the last 4096 words)") {
  Rows rows{1, {}};
  for (const std::uint32_t word : words_to_convert(params.n))
    rows.values.push_back(lab03::unit_float(word));
  return rows;
}

PROBE("Lab 3.5 between", "float",
      "(of the words 0 to 4095, of n words between, of the last 4096 words)") {
  Rows rows{1, {}};
  const auto a = static_cast<float>(params["a"]);
  const auto b = static_cast<float>(params["b"]);
  for (const std::uint32_t word : words_to_convert(params.n))
    rows.values.push_back(lab03::float_between(word, a, b));
  return rows;
}

PROBE("Lab 3.6 integers", "number", "words drawn",
      "(nan: far too many words were asked for; -inf: from a division by zero on)") {
  carlo::Rng rng(params.seed);
  const auto u = static_cast<std::int32_t>(params.whole("u"));
  const auto v = static_cast<std::int32_t>(params.whole("v"));
  std::int64_t drawn = 0;
  const lab03::Words source = [&] {
    if (++drawn > 64 * params.n + 1000) throw Exhausted();
    return rng.next_u32();
  };
  Rows rows{2, std::vector<double>(static_cast<std::size_t>(2 * params.n), divided_by_zero)};
  std::size_t i = 0;
  divides_well([&] {
    for (; i < rows.values.size(); i += 2) {
      const std::int64_t before = drawn;
      try {
        const double value = lab03::integer_between(u, v, source);
        rows.values[i + 1] = static_cast<double>(drawn - before);
        rows.values[i] = value;
      } catch (const Exhausted&) {
        rows.values[i] = rows.values[i + 1] = missing;
      }
    }
  });
  return rows;
}

// For each of words_to_deal(n): the number made of it, or NaN if another word was requested.
PROBE("Lab 3.6 words dealt", "number",
      "(one for each word close to a multiple of 2^32 / 6; nan: another word was asked for)") {
  const auto u = static_cast<std::int32_t>(params.whole("u"));
  const auto v = static_cast<std::int32_t>(params.whole("v"));
  Rows rows{1, {}};
  for (const std::uint32_t word : words_to_deal(params.n)) {
    bool asked = false;
    const lab03::Words source = [&] {
      if (asked) throw Exhausted();
      asked = true;
      return word;
    };
    try {
      rows.values.push_back(lab03::integer_between(u, v, source));
    } catch (const Exhausted&) {
      rows.values.push_back(missing);
    }
  }
  return rows;
}

// n cells with counts and expectations in "count0", "expected0", ...
PROBE("Lab 3.7 counts", "statistic", "p_lower", "p_upper") {
  std::vector<std::int64_t> counts;
  std::vector<double> expected;
  for (std::int64_t i = 0; i < params.n; ++i) {
    counts.push_back(params.whole("count" + std::to_string(i)));
    expected.push_back(params["expected" + std::to_string(i)]);
  }
  const lab03::TestResult result = lab03::chi_square(counts, expected);
  return {3, {result.statistic, result.p_lower, result.p_upper}};
}

// The test of n words that follow from the seed.
PROBE("Lab 3.7 words", "statistic", "p_lower", "p_upper") {
  const std::vector<std::uint32_t> words = random_words(params.seed, params.n);
  const auto result = lab03::equidistribution(words, static_cast<int>(params.whole("lowest")),
                                              static_cast<int>(params.whole("bits")));
  return {3, {result.statistic, result.p_lower, result.p_upper}};
}

// The words 0, 1, 2, ... n - 1: every field of low bits occurs equally often.
PROBE("Lab 3.7 counting words", "statistic", "p_lower", "p_upper") {
  std::vector<std::uint32_t> words(static_cast<std::size_t>(params.n));
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = static_cast<std::uint32_t>(i);
  const auto result = lab03::equidistribution(words, 0, static_cast<int>(params.whole("bits")));
  return {3, {result.statistic, result.p_lower, result.p_upper}};
}

PROBE("Lab 3.8 length", "squared length", "(-inf: a division by zero)") {
  double length = divided_by_zero;
  divides_well([&] {
    length = static_cast<double>(lab03::spectral_2d(static_cast<std::uint64_t>(params.whole("a")),
                                                    static_cast<std::uint64_t>(params.whole("c"))));
  });
  return {1, {length}};
}
