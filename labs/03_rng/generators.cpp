#include "generators.h"

#include "random/hash.h"
#include "random/rng.h"
#include "support/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <csignal>
#include <random>
#include <vector>

namespace lab03 {

Xoshiro128::Xoshiro128(std::uint64_t seed) : s_{} {
  SplitMix64 words(seed);
  for (std::size_t i = 0; i < 4; i += 2) {
    const std::uint64_t word = words.next();
    s_[i] = static_cast<std::uint32_t>(word);
    s_[i + 1] = static_cast<std::uint32_t>(word >> 32);
  }
}

namespace {

using Randu = std::linear_congruential_engine<std::uint32_t, 65539, 0, 2147483648u>;

/// A stream from a state and a function that returns one word of it. Works on a copy of the state,
/// which cannot alias `out`, so that it stays in registers.
template <class State, class Next>
Fill stream(State state, Next next) {
  return [state = std::move(state), next](std::span<std::uint32_t> out) mutable {
    State local = state;
    for (std::uint32_t& word : out)
      word = next(local);
    state = local;
  };
}

/// A stream of a generator with its own fill().
template <class G>
Fill filling(G generator) {
  return [generator = std::move(generator)](std::span<std::uint32_t> out) mutable {
    generator.fill(out);
  };
}

std::uint32_t low(std::uint64_t word) {
  return static_cast<std::uint32_t>(word);
}

Generator lagged(Lags lags, Combine combine) {
  const char* names[] = {"+", "−", "xor"};
  const char* keys[] = {"add", "sub", "xor"};
  const auto which = static_cast<std::size_t>(combine);
  return {fmt::format("lfg-{}-{}-{}", lags.j, lags.k, keys[which]),
          fmt::format("LFG ({}, {}) {}", lags.j, lags.k, names[which]), 32, lags,
          [lags, combine](std::uint64_t seed) {
            return filling(LaggedFibonacci(lags, combine, first_words(seed, lags.k)));
          }};
}

std::vector<Generator> all_generators() {
  const Lags usual{24, 55};
  std::vector<Generator> all = {
      {"lcg", "LCG (lecture)", 32, usual,
       [](std::uint64_t seed) { return filling(Lcg(low(carlo::mix(seed)))); }},
      // An odd seed gives RANDU its full period.
      {"randu", "RANDU", 31, usual,
       [](std::uint64_t seed) {
         return stream(Randu((low(carlo::mix(seed)) >> 1) | 1),
                       [](Randu& g) { return low(g() << 1); });
       }},
      {"minstd", "MINSTD", 31, usual,
       [](std::uint64_t seed) {
         return stream(std::minstd_rand0(low(carlo::mix(seed)) >> 1),
                       [](std::minstd_rand0& g) { return low(std::uint64_t{g()} << 1); });
       }},
  };
  for (const Lags lags : {Lags{7, 10}, {5, 17}, {6, 31}, {24, 55}, {31, 63}}) {
    for (const Combine combine : {Combine::add, Combine::subtract, Combine::exclusive_or})
      all.push_back(lagged(lags, combine));
  }
  const std::vector<Generator> modern = {
      {"mt19937", "mt19937", 32, usual,
       [](std::uint64_t seed) {
         return stream(std::mt19937(low(carlo::mix(seed))),
                       [](std::mt19937& g) { return low(g()); });
       }},
      {"pcg32", "PCG32", 32, usual, [](std::uint64_t seed) { return filling(Pcg32(seed, 0)); }},
      {"xoshiro128", "xoshiro128++", 32, usual,
       [](std::uint64_t seed) {
         return stream(Xoshiro128(seed), [](Xoshiro128& g) { return g.next(); });
       }},
      {"philox", "Philox4x32-10", 32, usual,
       [](std::uint64_t seed) {
         return stream(carlo::Rng(seed), [](carlo::Rng& g) { return g.next_u32(); });
       }},
      {"splitmix64", "splitmix64", 32, usual,
       [](std::uint64_t seed) {
         return stream(SplitMix64(carlo::mix(seed)),
                       [](SplitMix64& g) { return low(g.next() >> 32); });
       }},
  };
  all.insert(all.end(), modern.begin(), modern.end());
  return all;
}

}  // namespace

const std::vector<Generator>& generators() {
  static const std::vector<Generator> all = all_generators();
  return all;
}

const Generator& find_generator(std::string_view key) {
  std::string keys;
  for (const Generator& generator : generators()) {
    if (generator.key == key) return generator;
    keys += fmt::format(" {}", generator.key);
  }
  throw carlo::Error(fmt::format("there is no generator '{}'; there are:{}", key, keys));
}

namespace {

/// Writes all bytes; returns false when nobody reads any more.
bool write_all(const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(STDOUT_FILENO, bytes, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      if (errno == EPIPE) return false;
      throw carlo::Error(fmt::format("standard output: cannot write ({})",
                                     std::generic_category().message(errno)));
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

void little_end_first(std::vector<std::uint32_t>& words) {
  if constexpr (std::endian::native == std::endian::big) {
    for (std::uint32_t& word : words)
      word = word >> 24 | (word >> 8 & 0xFF00) | (word << 8 & 0xFF0000) | word << 24;
  }
}

}  // namespace

void write_raw_stream(const std::string& key, std::uint64_t seed) {
  const Fill fill = find_generator(key).make(seed);
  if (::isatty(STDOUT_FILENO) != 0) {
    throw carlo::Error(
        "--stream writes raw words: send them into a program, such as "
        "`| dieharder -a -g 200`");
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::vector<std::uint32_t> words(1 << 14);
  do {
    fill(words);
    little_end_first(words);
  } while (write_all(reinterpret_cast<const char*>(words.data()), words.size() * sizeof words[0]));
}

}  // namespace lab03
