#include "importance.h"

#include "course/not_implemented.h"

// Lab 06: importance sampling. This is your file. importance.h says what each function takes and
// returns; README.md says why. Your code takes the place of the not_implemented lines. Errors
// for the user are carlo::Error ("support/error.h").

namespace lab06 {

// Lab 6.1 -----------------------------------------------------------------------------------------

double contribution(const Function& f, const Density& p, double x) {
  // 1. Call the pdf once. A value that is no density is an error.
  // 2. Decide what a point of density 0 contributes, before you divide.
  // 3. Divide.
  carlo::not_implemented("Lab 6.1", "Importance Sampling");
}

std::vector<double> contributions(const Function& f, const Density& p, std::int64_t n,
                                  carlo::Rng& rng) {
  // 1. For each of n points: one uniform number, the point that p makes of it, its contribution.
  carlo::not_implemented("Lab 6.1", "Importance Sampling");
}

// Lab 6.2 -----------------------------------------------------------------------------------------

Estimate summarize(std::span<const double> values) {
  // 1. The mean of the values.
  // 2. From a second pass the squared distances from it; divide so that the variance is right on
  //    average.
  // 3. From the variance of one value to the standard deviation of the mean of all.
  carlo::not_implemented("Lab 6.2", "Variance");
}

double efficiency(double variance, double seconds) {
  // 1. What does one unit of accuracy cost? The inverse of that.
  carlo::not_implemented("Lab 6.2", "Effect of Importance Sampling");
}

// Lab 6.3 -----------------------------------------------------------------------------------------

Density light_density(double height, double a, double b) {
  // 1. Integrate 1 / (height^2 + t^2) from a to b: what must the pdf be divided by?
  // 2. Set the integral from a to t equal to the share u of the whole, and solve for t.
  // 3. Return both functions; they have to remember the numbers that they need.
  carlo::not_implemented("Lab 6.3", "Importance Sampling");
}

// Lab 6.4 -----------------------------------------------------------------------------------------

double largest_share(std::span<const double> values) {
  // 1. The largest size and the sum of all sizes, in one pass.
  carlo::not_implemented("Lab 6.4", "Importance Sampling");
}

double tail_index(std::span<const double> values, std::size_t k) {
  // 1. Bring the sizes into falling order.
  // 2. Average the logarithms of the k largest relative to the next one.
  // 3. Mind values that are all equal, or 0.
  carlo::not_implemented("Lab 6.4", "Importance Sampling");
}

Density mixture(const Density& p, const Density& q, double share) {
  // 1. sample: u decides for p or q. Then stretch the part of [0, 1) that it lies in to all of
  //    [0, 1); below_one() of densities.h guards against rounding.
  // 2. pdf: in how many ways can x come about?
  carlo::not_implemented("Lab 6.4", "Importance Sampling");
}

// Lab 6.5 -----------------------------------------------------------------------------------------

std::vector<double> rejection_contributions(const Function& f, const Function& g, double a,
                                            double b, double g_max, std::int64_t darts,
                                            carlo::Rng& rng) {
  // 1. Throw each dart at [a, b) x [0, g_max): x first, then y. Check what g promises.
  // 2. Which density do the kept x have, counted per dart thrown? f over that density; f is not
  //    called elsewhere.
  // 3. A dart that is lost contributes as well: what?
  carlo::not_implemented("Lab 6.5", "Generating Random Points");
}

// Lab 6.6 -----------------------------------------------------------------------------------------

double balance_weight(Effort own, Effort other) {
  // 1. Which technique could not have drawn the point at all?
  // 2. The share, from a ratio: neither sum nor product may leave the range of double.
  carlo::not_implemented("Lab 6.6", "Importance Sampling");
}

double power_weight(Effort own, Effort other) {
  // 1. The same with squares. Which of the two can you square without harm, product or ratio?
  carlo::not_implemented("Lab 6.6", "Importance Sampling");
}

// Lab 6.7 -----------------------------------------------------------------------------------------

double multi_sample(const Function& f, const Technique& first, const Technique& second,
                    Heuristic heuristic, carlo::Rng& rng) {
  // 1. The mean over first's samples of weight times f / pdf, each with its own pdf.
  // 2. The same for second's. The two means are added. Mind a technique without samples.
  carlo::not_implemented("Lab 6.7", "Importance Sampling");
}

double one_sample(const Function& f, const Density& first, const Density& second, double share,
                  Heuristic heuristic, double u) {
  // 1. Choose as in Lab 6.4 and draw the point.
  // 2. Weigh it: the efforts are the chances of being chosen.
  // 3. Divide by everything that was left to chance.
  carlo::not_implemented("Lab 6.7", "Importance Sampling");
}

}  // namespace lab06
