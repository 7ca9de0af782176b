#include "experiments.h"
#include "fast_fill.h"
#include "generators.h"
#include "support/wall_clock.h"

#include <algorithm>
#include <cstdlib>
#include <random>

// Nanoseconds per number, with each generator filling an array.

namespace lab03 {
namespace {

constexpr std::size_t block = 4096;

/// The least time per number over several rounds, each of at least `round_seconds`.
template <class F>
double seconds_a_number(F& fill, double round_seconds) {
  std::vector<std::uint32_t> words(block);
  double best = 1;
  volatile std::uint32_t sink = 0;
  for (int round = 0; round < 5; ++round) {
    const carlo::WallClock clock;
    double spent = 0, filled = 0;
    do {
      fill(words);
      filled += static_cast<double>(block);
      spent = clock.seconds();
    } while (spent < round_seconds);
    best = std::min(best, spent / filled);
    sink = words.back();
  }
  (void)sink;
  return best;
}

/// A loop over a generator whose call the compiler can inline.
template <class G>
auto loop(G generator) {
  return [generator](std::span<std::uint32_t> out) mutable {
    for (std::uint32_t& word : out)
      word = static_cast<std::uint32_t>(generator());
  };
}

}  // namespace

void speed_experiment(Notebook& notebook) {
  notebook.begin("Nanoseconds a number");
  const double round_seconds = notebook.options().quick ? 0.002 : 0.01;
  carlo::Table table({"generator", "time a number", "numbers a second"},
                     {"generator", "seconds", "per_second"});
  const auto measure = [&](const std::string& name, auto make) {
    notebook.attempt([&] {
      auto fill = make();
      const double seconds = seconds_a_number(fill, round_seconds);
      table.add_row({name, carlo::seconds_cell(seconds), 1 / seconds});
    });
  };
  for (const char* key : {"lcg", "lfg-24-55-add", "lfg-24-55-sub", "lfg-24-55-xor", "pcg32",
                          "xoshiro128", "splitmix64", "philox"}) {
    const Generator& generator = find_generator(key);
    measure(generator.name, [&] { return generator.make(1); });
  }
  const std::string level = has_avx2() ? ", AVX2" : ", no AVX2";
  const auto filling = [](auto generator) {
    return [generator](std::span<std::uint32_t> out) mutable { generator.fill(out); };
  };
  measure("LCG, 32 leapfrogging lanes" + level, [&] { return filling(LeapfrogLcg(1)); });
  measure("xoshiro128++, 8 lanes" + level, [&] { return filling(Xoshiro128x8(1)); });
  measure("Philox, 8 blocks" + level, [&] { return filling(PhiloxBlocks(1)); });
  measure("std::minstd_rand0", [] { return loop(std::minstd_rand0(1)); });
  measure("std::mt19937", [] { return loop(std::mt19937(1)); });
  measure("std::mt19937_64", [] { return loop(std::mt19937_64(1)); });
  measure("std::ranlux24", [] { return loop(std::ranlux24(1)); });
  // NOLINTNEXTLINE(concurrency-mt-unsafe,cert-msc30-c,cert-msc50-cpp)
  measure("rand()", [] { return loop([] { return std::rand(); }); });
  measure("std::random_device", [] {
    return [](std::span<std::uint32_t> out) {
      static std::random_device device;
      for (std::uint32_t& word : out)
        word = device();
    };
  });
  notebook.say(
      "Arrays of 4096 words, filled over and over; the best of five rounds. The standard library's "
      "generators stand for comparison, std::random_device asks the system or the processor for "
      "true randomness. Seeding counts too: std::mt19937 fills 624 words before the first number.");
  notebook.table("speed", table, "Time a 32-bit number, one thread");
}

}  // namespace lab03
