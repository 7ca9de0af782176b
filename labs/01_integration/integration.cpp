#include "integration.h"

#include "course/not_implemented.h"

// Lab 01: integration. This is your file. integration.h says what each function takes and returns;
// README.md says why. Your code takes the place of the not_implemented lines.

namespace lab01 {

// Lab 1.1 -----------------------------------------------------------------------------------------

double average(const Function& f, std::int64_t n, carlo::Rng& rng) {
  // 1. Draw n uniform points, one rng.uniform() each.
  // 2. Add up the values of f.
  // 3. Turn the sum into a mean.
  carlo::not_implemented("Lab 1.1", "Estimating the Average");
}

// Lab 1.2 -----------------------------------------------------------------------------------------

double integrate(const Function& f, double a, double b, std::int64_t n, carlo::Rng& rng) {
  // 1. Map each uniform number from [0, 1) to [a, b).
  // 2. Average f over those points.
  // 3. Turn the average into an integral.
  carlo::not_implemented("Lab 1.2", "Other Domains");
}

// Lab 1.3 -----------------------------------------------------------------------------------------

void Moments::add(double x) {
  // 1. Count x.
  // 2. Move the mean towards x, by as much as one number among n_ deserves.
  // 3. Let m2_ grow by the product of x's distances to the old and to the new mean.
  carlo::not_implemented("Lab 1.3", "Variance");
}

void Moments::merge(const Moments& other) {
  // 1. If one side is empty, the other one is the result.
  // 2. Move the mean towards the other's, by the share of the numbers that are the other's.
  // 3. Let m2_ grow by the other's and by what the distance of the two means contributes.
  carlo::not_implemented("Lab 1.3", "Variance");
}

double Moments::variance() const {
  // 1. Fewer than two numbers say nothing about the spread: 0.
  // 2. Divide m2_ so that the estimate is right on average.
  carlo::not_implemented("Lab 1.3", "Variance");
}

double Moments::standard_error() const {
  // 1. Fewer than two numbers: 0.
  // 2. From the variance of one number to the standard deviation of the mean of n_.
  carlo::not_implemented("Lab 1.3", "Variance");
}

// Lab 1.4 -----------------------------------------------------------------------------------------

double midpoint(const Function& f, double a, double b, std::int64_t n) {
  // 1. Add up f at the centres of the n cells. Compute each place from its index: a running
  //    x += h collects a rounding error at every step.
  // 2. Multiply by the width of a cell.
  carlo::not_implemented("Lab 1.4", "Integration in d Dimensions?");
}

double trapezoid(const Function& f, double a, double b, std::int64_t n) {
  // 1. Add up f at the two ends and at the n - 1 joints, each with its weight.
  // 2. Multiply by the width of a cell.
  carlo::not_implemented("Lab 1.4", "Integration in d Dimensions?");
}

double simpson(const Function& f, double a, double b, std::int64_t n) {
  // 1. Add up f at the ends, at the joints and at the centres, each with its weight.
  // 2. Multiply by the width of a cell and by what makes the weights of one cell add up to 1.
  carlo::not_implemented("Lab 1.4", "Integration in d Dimensions?");
}

// Lab 1.5 -----------------------------------------------------------------------------------------

double nested_midpoint(const FunctionNd& f, const Box& box, std::int64_t n) {
  // 1. Keep one point with a coordinate a dimension.
  // 2. Visit the centre of each of the n^d cells: for every place of the first coordinate all
  //    places of the second, and so on. The dimension is known only at run time, so either call
  //    a function from within itself or count like an odometer.
  // 3. Weigh the sum by the volume of a cell.
  carlo::not_implemented("Lab 1.5", "Integration in d Dimensions?");
}

// Lab 1.6 -----------------------------------------------------------------------------------------

double integrate_box(const FunctionNd& f, const Box& box, std::int64_t n, carlo::Rng& rng) {
  // 1. For each of n points, draw one uniform number a dimension and map it to its side.
  // 2. Average f over the points.
  // 3. Turn the average into an integral.
  carlo::not_implemented("Lab 1.6", "\"Monte Carlo\" Integration");
}

// Lab 1.7 -----------------------------------------------------------------------------------------

Estimate integrate_domain(const FunctionNd& f, const Inside& inside, const Box& box, std::int64_t n,
                          carlo::Rng& rng) {
  // 1. Draw n uniform points of the box.
  // 2. Decide what a point outside the domain contributes; do not evaluate f there.
  // 3. Feed every contribution to your Moments.
  // 4. Scale the mean and its standard error from the average to the integral.
  carlo::not_implemented("Lab 1.7", "Integration in d Dimensions?");
}

}  // namespace lab01
