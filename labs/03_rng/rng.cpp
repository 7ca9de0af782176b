#include "rng.h"

#include "course/not_implemented.h"
#include "random/hash.h"
#include "stats/distributions.h"

// Lab 03: random numbers. This is your file. rng.h says what each function takes and returns;
// README.md says why. Your code takes the place of the not_implemented lines.

namespace lab03 {

// Lab 3.1 -----------------------------------------------------------------------------------------

std::uint32_t Lcg::next() {
  // 1. Take x_ one step on. What does unsigned arithmetic do modulo 2^32?
  // 2. Return it.
  carlo::not_implemented("Lab 3.1", "Linear Congruential Methods");
}

// Lab 3.2 -----------------------------------------------------------------------------------------

void Lcg::discard(std::uint64_t n) {
  // 1. One step is the map x -> a x + b. Work out the map that two such steps make together.
  // 2. Go through the binary digits of n: keep the map of 1, 2, 4, 8, ... steps, and apply it where
  //    n has a one.
  carlo::not_implemented("Lab 3.2", "Pseudorandom Numbers");
}

// Lab 3.3 -----------------------------------------------------------------------------------------

std::vector<std::uint32_t> first_words(std::uint64_t seed, int k) {
  // 1. Make each word a hash of the seed and of the word's place.
  // 2. See to it that at least one is odd.
  carlo::not_implemented("Lab 3.3", "Lagged Fibonacci Generators");
}

std::uint32_t LaggedFibonacci::next() {
  // 1. Find x_{n-k} and x_{n-j} in the ring.
  // 2. Combine them, in this order: x_{n-j} first.
  // 3. The result takes the place of the oldest word, and the next oldest becomes the oldest.
  carlo::not_implemented("Lab 3.3", "Lagged Fibonacci Generators");
}

// Lab 3.4 -----------------------------------------------------------------------------------------

Pcg32::Pcg32(std::uint64_t seed, std::uint64_t stream) {
  // 1. The increment is odd: twice the stream, plus one.
  // 2. From state 0: one step, the seed added, one more step.
  carlo::not_implemented("Lab 3.4", "Pseudorandom Numbers");
}

std::uint32_t Pcg32::next() {
  // 1. Keep the old state; take the state one step on (an LCG modulo 2^64).
  // 2. From the old state: shift right by 18, xor with itself, shift right by 27, keep 32 bits.
  // 3. Rotate these to the right by the old state's five top bits. A shift by 32 is undefined.
  carlo::not_implemented("Lab 3.4", "Pseudorandom Numbers");
}

// Lab 3.5 -----------------------------------------------------------------------------------------

float unit_float(std::uint32_t word) {
  // 1. A float holds 24 binary digits: keep no more of the word.
  // 2. Scale to [0, 1).
  carlo::not_implemented("Lab 3.5", "Pseudorandom Numbers (floating-point numbers)");
}

float float_between(std::uint32_t word, float a, float b) {
  // 1. Stretch and shift unit_float(word). Mind b - a for very large floats.
  // 2. Rounding may land on b: what is the nearest float that is allowed?
  carlo::not_implemented("Lab 3.5", "Pseudorandom Numbers (floating-point numbers)");
}

// Lab 3.6 -----------------------------------------------------------------------------------------

std::int32_t integer_between(std::int32_t u, std::int32_t v, const Words& next) {
  // 1. How many values are there? v - u + 1 may not fit into 32 bits.
  // 2. Deal the 2^32 words out to the values, equally many to each; draw again when the word is one
  //    of those that are left over.
  // 3. Shift by u.
  carlo::not_implemented("Lab 3.6", "Pseudorandom Numbers (integers in [u..v])");
}

// Lab 3.7 -----------------------------------------------------------------------------------------

TestResult chi_square(std::span<const std::int64_t> counts, std::span<const double> expected) {
  // 1. Add up the squared differences, each in proportion to what was expected.
  // 2. How many of the counts are free when their sum is given?
  // 3. Look both tails up.
  carlo::not_implemented("Lab 3.7", "Desirable properties");
}

TestResult equidistribution(std::span<const std::uint32_t> words, int lowest, int bits) {
  // 1. Cut the field out of each word and count its values.
  // 2. Test the counts.
  carlo::not_implemented("Lab 3.7", "Desirable properties");
}

// Lab 3.8 -----------------------------------------------------------------------------------------

std::uint64_t spectral_2d(std::uint64_t a, std::uint64_t c) {
  // 1. Write down two vectors (s, t) with s + a t = 0 mod c of which all others are sums.
  // 2. Take from the longer one the multiple of the shorter one that leaves it shortest.
  // 3. Repeat until nothing gets shorter. Squares of numbers up to 2^32 need a Wide.
  carlo::not_implemented("Lab 3.8", "Problem with LCGs");
}

}  // namespace lab03

#include "fills.h"  // given: fill(), loops over the next() above
