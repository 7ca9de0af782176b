#include "inversion_rejection.h"

#include "bins.h"
#include "course/not_implemented.h"
#include "support/error.h"

// Lab 05: inversion and rejection. This is your file. inversion_rejection.h says what each function
// takes and returns; README.md says why; bins.h has two functions for the tables. An exercise is
// done when its not_implemented lines are gone.

namespace lab05 {

// Lab 5.1 -----------------------------------------------------------------------------------------

double sample_exponential(double u, double rate) {
  // 1. Integrate the density from 0 to x: the CDF.
  // 2. Solve CDF(x) = u for x, so that u = 0 gives 0 and no u below 1 gives infinity.
  // 3. Look for the function in <cmath> that keeps all digits where u is tiny.
  carlo::not_implemented("Lab 5.1", "Generating Random Points");
}

double exponential_pdf(double x, double rate) {
  carlo::not_implemented("Lab 5.1", "Generating Random Points");
}

// Lab 5.2 -----------------------------------------------------------------------------------------

double sample_linear(double u, double f0, double f1) {
  // 1. The CDF is a parabola: write CDF(x) = u as a quadratic equation in x.
  // 2. Of the two ways to write its root, take the one that divides by a sum.
  // 3. Look at u = 0 with f0 = 0; and rounding must not carry x above 1.
  carlo::not_implemented("Lab 5.2", "Generating Random Points");
}

double linear_pdf(double x, double f0, double f1) {
  carlo::not_implemented("Lab 5.2", "Generating Random Points");
}

double sample_tent(double u, double radius) {
  // 1. The lower half of [0, 1) goes to the left side, the upper half to the right side.
  // 2. Each side is a linear density of its own.
  carlo::not_implemented("Lab 5.2", "Generating Random Points");
}

double tent_pdf(double x, double radius) {
  carlo::not_implemented("Lab 5.2", "Generating Random Points");
}

// Lab 5.3 -----------------------------------------------------------------------------------------

double sample_power(double u, double n) {
  // Integrate x^n, divide by the integral over all of [0, 1], solve for x.
  carlo::not_implemented("Lab 5.3", "Generating Random Points");
}

double power_pdf(double x, double n) {
  carlo::not_implemented("Lab 5.3", "Generating Random Points");
}

// Lab 5.4 -----------------------------------------------------------------------------------------

Discrete::Discrete(std::span<const double> weights) {
  // 1. Refuse weights that cannot be probabilities: throw carlo::Error("what was found").
  // 2. Store running sums, in double.
  // 3. Divide them by the last one, so that the last one becomes exactly 1.
  carlo::not_implemented("Lab 5.4", "Generating Random Points");
}

Discrete::Pick Discrete::sample(double u) const {
  // 1. Find the first entry of cdf_ that is above u (not: at least u) by bisection. u stays double.
  // 2. Where does u lie between the entry before it and this one? Keep the fraction below 1.
  carlo::not_implemented("Lab 5.4", "Generating Random Points");
}

double Discrete::probability(std::size_t index) const {
  carlo::not_implemented("Lab 5.4", "Generating Random Points");
}

// Lab 5.5 -----------------------------------------------------------------------------------------

Tabulated1d::Tabulated1d(std::span<const double> weights) {
  carlo::not_implemented("Lab 5.5", "Generating Random Points");
}

double Tabulated1d::sample(double u) const {
  // 1. Draw a bin.
  // 2. Place x in it, by what is left of u.
  carlo::not_implemented("Lab 5.5", "Generating Random Points");
}

double Tabulated1d::pdf(double x) const {
  // A density is a probability divided by a width.
  carlo::not_implemented("Lab 5.5", "Generating Random Points");
}

// Lab 5.6 -----------------------------------------------------------------------------------------

Tabulated2d::Tabulated2d(std::span<const double> weights, std::size_t width, std::size_t height) {
  // 1. Refuse a table whose size is not width times height.
  // 2. One Discrete for the columns of each row; a row that is all 0 keeps an empty one.
  // 3. One Discrete for the sums of the rows.
  carlo::not_implemented("Lab 5.6", "Generating Random Points");
}

Point Tabulated2d::sample(double u_row, double u_column) const {
  // 1. Draw the row, then a column of that row.
  // 2. Place the point in the cell, by what is left of both numbers.
  carlo::not_implemented("Lab 5.6", "Generating Random Points");
}

double Tabulated2d::pdf(Point p) const {
  carlo::not_implemented("Lab 5.6", "Generating Random Points");
}

// Lab 5.7 -----------------------------------------------------------------------------------------

Accepted<double> sample_by_rejection(const Function& f, double a, double b, double f_max,
                                     carlo::Rng& rng) {
  // 1. Throw a dart at the rectangle [a, b) x [0, f_max): x first, then y, in two statements.
  // 2. A value of f that breaks the promise 0 <= f <= f_max is an error, not a sample.
  // 3. Keep x if the dart lies below f, else throw the next one. Count them.
  carlo::not_implemented("Lab 5.7", "Generating Random Points");
}

double acceptance_rate(double integral, double a, double b, double f_max) {
  carlo::not_implemented("Lab 5.7", "Generating Random Points");
}

// Lab 5.8 -----------------------------------------------------------------------------------------

Accepted<Point> disc_by_rejection(carlo::Rng& rng) {
  // Darts at the square around the disc until one hits the disc. Count them.
  carlo::not_implemented("Lab 5.8", "Generating Random Points");
}

Point disc_by_inversion(double u_radius, double u_angle) {
  // 1. Which share of the disc's area lies within distance r? That is the CDF of r.
  // 2. Invert it; the angle is uniform.
  carlo::not_implemented("Lab 5.8", "Generating Random Points");
}

double disc_pdf(Point p) {
  carlo::not_implemented("Lab 5.8", "Generating Random Points");
}

}  // namespace lab05
