#include "stratification.h"

#include "course/not_implemented.h"

// Lab 04: stratification. This is your file. stratification.h says what each function takes and
// returns; README.md says why. Your code takes the place of the not_implemented lines.

namespace lab04 {

// Lab 4.1 -----------------------------------------------------------------------------------------

double stratified_average(const Function& f, std::int64_t n, carlo::Rng& rng) {
  // 1. For each of the n strata draw one uniform number and place it in the stratum.
  // 2. Average the values of f.
  carlo::not_implemented("Lab 4.1", "Stratified Sampling");
}

// Lab 4.2 -----------------------------------------------------------------------------------------

float place_in_stratum(std::int32_t i, std::int32_t n, float u) {
  // 1. Compute (i + u)/n with digits to spare, and round it to float once.
  // 2. Rounding may have moved it over either end of the stratum. Test for that without rounding
  //    again: the product of a float and a 21-bit integer is exact in double.
  // 3. Where it happened, take the nearest float within.
  carlo::not_implemented("Lab 4.2", "Stratified Sampling");
}

// Lab 4.3 -----------------------------------------------------------------------------------------

std::vector<Point> jittered(std::int64_t columns, std::int64_t rows, carlo::Rng& rng) {
  // 1. Visit the cells row by row.
  // 2. Draw two uniform numbers for each, one statement a draw.
  carlo::not_implemented("Lab 4.3", "With Stratified Sampling");
}

// Lab 4.4 -----------------------------------------------------------------------------------------

std::vector<double> latin_hypercube(std::int64_t n, std::int64_t dimensions, carlo::Rng& rng) {
  // 1. For each axis, deal the n strata out to the n points in random order, every order equally
  //    likely.
  // 2. Place each point within its stratum.
  carlo::not_implemented("Lab 4.4", "Stratified Sampling");
}

// Lab 4.5 -----------------------------------------------------------------------------------------

StratifiedEstimate stratified_estimate(const Function2d& f, std::int64_t columns, std::int64_t rows,
                                       std::int64_t per_cell, carlo::Rng& rng) {
  // 1. In each cell find the mean of the values and their sum of squared distances from it.
  // 2. The value is the mean of the cells' means.
  // 3. Its variance is made of the variances of the cells' means, and of nothing else.
  // 4. For the plain error: how far do all values spread about the value, and what does the value's
  //    own uncertainty take away from that?
  carlo::not_implemented("Lab 4.5", "Stratified Sampling");
}

// Lab 4.6 -----------------------------------------------------------------------------------------

Estimate recursive_stratification(const FunctionNd& f, std::int64_t dimensions, std::int64_t n,
                                  carlo::Rng& rng, std::vector<Stratum>* strata) {
  // 1. Few points left: average f over the box; with it comes the variance of that average.
  // 2. Else spend some points to learn, for every axis, how much f varies in its two halves.
  // 3. Halve the box along the axis where the halves promise the smallest error.
  // 4. Share the remaining points between the halves; each needs enough for a variance.
  // 5. Do the same to both halves, and put their two averages together, and their variances.
  carlo::not_implemented("Lab 4.6", "Stratified Sampling");
}

}  // namespace lab04
