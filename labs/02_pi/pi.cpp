#include "pi.h"

#include "course/not_implemented.h"

// Lab 02: π by darts. This is your file. pi.h says what each function takes and returns; README.md
// says why. Your code takes the place of the not_implemented lines.

namespace lab02 {

// Lab 2.1 -----------------------------------------------------------------------------------------

Darts throw_darts(std::int64_t n, carlo::Rng& rng) {
  // 1. Draw x, then y (two statements: the order of two calls in one is not fixed).
  // 2. Count the dart, and count it as a hit when it lies in the quarter disc.
  carlo::not_implemented("Lab 2.1", "Example: Computing pi");
}

Estimate pi_estimate(const Darts& darts) {
  // 1. The share of hits estimates the quarter disc's area; scale it to π.
  // 2. A dart scores 1 or 0: what is the variance of such a score?
  // 3. From the score of one dart to the scaled mean of all of them.
  carlo::not_implemented("Lab 2.1", "Example: Computing pi");
}

// Lab 2.2 -----------------------------------------------------------------------------------------

Interval pi_interval(const Darts& darts, double z) {
  // 1. Find the two probabilities that lie exactly z of their own standard deviations from the
  //    share of hits: the roots of a quadratic equation.
  // 2. Scale them to π.
  carlo::not_implemented("Lab 2.2", "Variance");
}

// Lab 2.3 -----------------------------------------------------------------------------------------

Sums sum_circle(std::int64_t n, carlo::Rng& rng) {
  // 1. One uniform x a sample; the value is the integrand at x.
  // 2. Keep the sums of the values and of their squares.
  carlo::not_implemented("Lab 2.3", "Estimating the Average");
}

Sums sum_arctangent(std::int64_t n, carlo::Rng& rng) {
  // The same with the other integrand: write what they share only once.
  carlo::not_implemented("Lab 2.3", "Estimating the Average");
}

Estimate mean_of(const Sums& sums) {
  // 1. The mean, and the sum of squared distances from it.
  // 2. The unbiased variance of one value, then the standard error of the mean of all.
  carlo::not_implemented("Lab 2.3", "Variance");
}

// Lab 2.4 -----------------------------------------------------------------------------------------

double darts_deviation() {
  // Work it out on paper: E[Y^2] - E[Y]^2, with Y = 4 or 0.
  carlo::not_implemented("Lab 2.4", "Variance");
}

double circle_deviation() {
  // On paper: the integral of (4 sqrt(1 - x^2))^2 is elementary.
  carlo::not_implemented("Lab 2.4", "Variance");
}

double arctangent_deviation() {
  // On paper: the integral of 1 / (1 + x^2)^2 takes one substitution.
  carlo::not_implemented("Lab 2.4", "Variance");
}

std::int64_t samples_needed(double deviation, double half_width, double z) {
  // Solve "z standard errors <= half_width" for N, and round to the safe side.
  carlo::not_implemented("Lab 2.4", "Variance");
}

// Lab 2.5 -----------------------------------------------------------------------------------------

std::int64_t count_hits(std::uint64_t key, std::int64_t first, std::int64_t n) {
  // 1. Write it so that it is right: dart by dart, and keep that version to compare with.
  // 2. Rewrite the test for a hit in whole numbers, without a branch.
  // 3. Take both darts of a word at once, several words a round; mind a range that starts or ends
  //    in the middle of a word.
  carlo::not_implemented("Lab 2.5", "Example: Computing pi");
}

// Lab 2.6 -----------------------------------------------------------------------------------------

Sums sum_in_parallel(const Sampler& sampler, std::int64_t n, std::uint64_t seed, int threads) {
  // 1. Make a place for the result of each chunk.
  // 2. Start the threads. Each takes the next chunk that nobody has begun, until there is none.
  // 3. An exception that leaves a thread's function ends the program: catch it, keep it, stop.
  // 4. When all threads have ended, pass the exception on or add up the results.
  carlo::not_implemented("Lab 2.6", "Variance");
}

}  // namespace lab02
