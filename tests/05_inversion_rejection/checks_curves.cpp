// Checks of exercises 5.1 to 5.3. The inverse CDFs are compared exactly with their closed forms at
// 110 numbers u. In addition, chi-square tests of 200 000 samples in up to 100 cells use the cells'
// exact integrals: cells that are off by 4 % each (rms) have a noncentrality of 320, which is
// detected with power .999 (99 degrees of freedom, alpha 1.6e-8: 190 is enough).

#include "05_inversion_rejection/inputs.h"
#include "05_inversion_rejection/match.h"
#include "grader/judge/judge.h"

#include <cmath>
#include <limits>

using namespace carlo::grader;
using namespace lab05_tests;

namespace {

const Diagnosis infinite_at_0{"logarithm-of-u",
                              "log(u) is minus infinity at u = 0, and the sample decreases as u "
                              "grows: use log(1 - u)."};
const Diagnosis cancels{"one-minus-u-cancels",
                        "for tiny u the difference 1 - u is 1 and the sample 0: log1p keeps the "
                        "digits."};
const Diagnosis times_rate{"multiplied-by-the-rate",
                           "the larger the rate, the closer to 0 the samples: divide by it."};
const Diagnosis mirrored{"ends-swapped", "the density is mirrored: f0 belongs to x = 0."};
const Diagnosis divides_by_difference{
    "divides-by-difference-of-ends",
    "where f0 and f1 are equal or nearly so, dividing by f1 - f0 loses digits, or is 0/0."};
const Diagnosis zero_by_zero{"zero-by-zero-at-u-0",
                             "with f0 = 0 the sample at u = 0 is 0/0: treat u = 0 separately."};
const Diagnosis not_inverted{"u-not-inverted",
                             "the sample is u, or u stretched to the support: that is uniform, "
                             "whatever the density. Invert the CDF."};
const Diagnosis one_half{"one-half-of-the-tent",
                         "all samples lie on one side of 0: half of the u belong to the other "
                         "side."};
const Diagnosis half_tent{"tent-not-stretched",
                          "each half of [0, 1) has to be stretched to [0, 1) before it is used for "
                          "its side of the tent."};
const Diagnosis peaks_outside{"tent-upside-down-on-one-side",
                              "for u above 1/2 the density rises towards the rim: the "
                              "tent is highest at 0."};
const Diagnosis exponent_n{"power-one-too-low",
                           "x^n integrates to x^(n + 1)/(n + 1): take the (n + 1)-th root."};
const Diagnosis not_normalised{"density-not-normalised", "the density does not integrate to 1."};
const Diagnosis end_left_out{"end-outside-the-support",
                             "the ends of the support belong to it: the density is not 0 there."};
const Diagnosis outside_support{"density-outside-the-support",
                                "the density is not 0 outside the support."};

/// One distribution: its closed forms.
struct Case {
  std::string name;
  Family family;
  double p, q;
  double first, last;  ///< the support, or most of it
  Formula inverse, cdf, pdf;
};

Case exponential(double rate) {
  return {fmt::format("the exponential of rate {:g}", rate),
          Family::exponential,
          rate,
          0,
          0,
          40 / rate,
          [=](double u) { return -std::log1p(-u) / rate; },
          [=](double x) { return -std::expm1(-rate * x); },
          [=](double x) { return x < 0 ? 0 : rate * std::exp(-rate * x); }};
}

double line(double x, double f0, double f1) {
  return 2 * ((1 - x) * f0 + x * f1) / (f0 + f1);
}

Case linear(double f0, double f1) {
  const auto inverse = [=](double u) -> double {
    if (u == 0) return 0;
    const long double height = std::sqrt((1 - static_cast<long double>(u)) * f0 * f0 +
                                         static_cast<long double>(u) * f1 * f1);
    return static_cast<double>(u * (static_cast<long double>(f0) + f1) / (f0 + height));
  };
  return {fmt::format("the line from {:g} to {:.15g}", f0, f1),
          Family::linear,
          f0,
          f1,
          0,
          1,
          inverse,
          [=](double x) { return x * (2 * f0 + (f1 - f0) * x) / (f0 + f1); },
          [=](double x) { return x < 0 || x > 1 ? 0 : line(x, f0, f1); }};
}

Case tent(double r) {
  return {fmt::format("the tent of radius {:g}", r),
          Family::tent,
          r,
          0,
          -r,
          r,
          [=](double u) {
            return u < 0.5 ? r * (std::sqrt(2 * u) - 1) : r * (1 - std::sqrt(2 * (1 - u)));
          },
          [=](double x) {
            const double t = 1 - std::abs(x) / r;
            return x < 0 ? t * t / 2 : 1 - t * t / 2;
          },
          [=](double x) { return std::abs(x) > r ? 0 : (r - std::abs(x)) / (r * r); }};
}

Case power(double n) {
  return {fmt::format("the power n = {:g}", n),
          Family::power,
          n,
          0,
          0,
          1,
          [=](double u) { return std::pow(u, 1 / (n + 1)); },
          [=](double x) { return std::pow(x, n + 1); },
          [=](double x) { return x < 0 || x > 1 ? 0 : (n + 1) * std::pow(x, n); }};
}

Params params_of(const Case& c) {
  return {.numbers = {{"family", static_cast<double>(c.family)}, {"p", c.p}, {"q", c.q}}};
}

/// True if each sample is NaN or roughly right, for a line whose ends are almost equal.
bool lost_by_difference(const Case& c, const std::vector<double>& samples) {
  if (c.family != Family::linear || std::abs(c.q - c.p) > 1e-6 * c.p) return false;
  const std::vector<double> u = hard_numbers();
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (std::abs(samples[i] - c.inverse(u[i])) > 0.1) return false;
  }
  return true;
}

void judge_inverse(const Case& c, double relative, double absolute,
                   const std::vector<Alternative>& alternatives) {
  const std::vector<double> u = hard_numbers();
  const Rows rows = probe("Lab 5.1 to 5.3 inverse", params_of(c),
                          {.rows = u.size(), .finite = false, .of = c.name});
  Verdict verdict = equals_everywhere("the sample of " + c.name, u, rows.values, c.inverse,
                                      relative, absolute, alternatives);
  if (!verdict.passed && lost_by_difference(c, rows.values)) {
    verdict.diagnoses.push_back(divides_by_difference);
  }
  judge(verdict);
}

/// Judges the density at 400 points from outside the support on one side to outside on the other.
void judge_density(const Case& c, const std::vector<Alternative>& alternatives) {
  constexpr int steps = 400;
  const double margin = (c.last - c.first) / 8;
  Params params = params_of(c);
  params.n = steps;
  const double first = c.first - margin, last = c.last + margin;
  params.numbers["first"] = first;
  params.numbers["last"] = last;
  const Rows rows = probe("Lab 5.1 to 5.3 density", params,
                          {.rows = steps + 1,
                           .finite = false,
                           .of = fmt::format("{}, x = {:g} ... {:g}", c.name, first, last)});
  std::vector<double> at, inside_at, inside;
  bool right_outside = true;
  for (int i = 0; i <= steps; ++i) {
    at.push_back(first + (last - first) * (static_cast<double>(i) / steps));
    if (c.pdf(at.back()) == 0) {
      right_outside = right_outside && rows.values[static_cast<std::size_t>(i)] == 0;
    }
    if (!(at.back() > c.first && at.back() < c.last)) continue;
    inside_at.push_back(at.back());
    inside.push_back(rows.values[static_cast<std::size_t>(i)]);
  }
  Verdict verdict = equals_everywhere("the density of " + c.name, at, rows.values, c.pdf, 1e-11,
                                      1e-14 * c.pdf(c.first + margin), alternatives, "x");
  if (!verdict.passed && looks_like(c.pdf, inside_at, inside)) {
    verdict.diagnoses.push_back(right_outside ? end_left_out : outside_support);
  }
  judge(verdict);
}

void judge_samples(const Case& c, double first, double last) {
  constexpr std::size_t n = 200'000, cells = 100;
  Params params = params_of(c);
  params.n = n;
  const Rows rows = probe("Lab 5.1 to 5.3 samples", params, {.rows = n, .of = c.name});
  std::vector<double> counts = counted(rows.values, first, last, cells);
  std::vector<double> mass = masses(c.cdf, first, last, cells);
  if (c.family == Family::exponential) {  // the tail is another cell
    double tail = 0;
    for (const double x : rows.values)
      tail += x > last ? 1 : 0;
    counts.push_back(tail);
    mass.push_back(1 - c.cdf(last));
  }
  const CellAxis axis{"x", first,
                      first + (last - first) / cells * static_cast<double>(mass.size())};
  judge(counts_are("the samples of " + c.name + " against its integral over each cell", counts,
                   mass, n, axis));
}

}  // namespace

TEST_CASE(
    "Lab 5.1: samples are the inverse of the CDF, at 0, at tiny u and up to the last u below 1",
    "[lab05][ex1]") {
  for (const double rate : {1.0, 0.01, 250.0}) {
    std::vector<Alternative> alternatives{
        {[=](double u) { return -std::log(u) / rate; }, infinite_at_0},
        {[=](double u) { return -std::log(1 - u) / rate; }, cancels}};
    if (rate != 1) {
      alternatives.push_back({[=](double u) { return -std::log(1 - u) * rate; }, times_rate});
      alternatives.push_back({[=](double u) { return -std::log1p(-u) * rate; }, times_rate});
    }
    judge_inverse(exponential(rate), 1e-12, 0, alternatives);
  }
}

TEST_CASE("Lab 5.1: the density is right, and 0 below x = 0", "[lab05][ex1]") {
  for (const double rate : {1.0, 0.01, 250.0}) {
    judge_density(exponential(rate),
                  {{[=](double x) { return x < 0 ? 0 : std::exp(-rate * x); }, not_normalised}});
  }
}

TEST_CASE("Lab 5.1: samples fill every cell by its integral", "[lab05][ex1]") {
  judge_samples(exponential(2.5), 0, 2);
}

TEST_CASE("Lab 5.2: linear samples are the inverse of the CDF, whatever the ends", "[lab05][ex2]") {
  for (const auto& [f0, f1] : {std::pair{1.0, 3.0},
                               {3.0, 1.0},
                               {0.0, 2.0},
                               {2.0, 0.0},
                               {0.7, 0.7},
                               {1.0, 1 + 1e-13},
                               {1e-9, 5e-9}}) {
    const Case c = linear(f0, f1);
    const auto naive = [f0 = f0, f1 = f1](double u) {
      return (-f0 + std::sqrt((1 - u) * f0 * f0 + u * f1 * f1)) / (f1 - f0);
    };
    const auto nan_at_0 = [=](double u) {
      return u == 0 && c.p == 0 ? std::numeric_limits<double>::quiet_NaN() : c.inverse(u);
    };
    const auto swapped = linear(f1, f0).inverse;
    // min(1.0, NaN) is 1, min(NaN, 1.0) is NaN.
    const auto one_at_0 = [=](double u) { return u == 0 && c.p == 0 ? 1 : c.inverse(u); };
    std::vector<Alternative> alternatives{{naive, divides_by_difference}};
    if (f0 != f1 && std::abs(f0 - f1) > 1e-12)
      alternatives.push_back({[](double u) { return u; }, not_inverted});
    if (f0 == 0) {
      alternatives.push_back({nan_at_0, zero_by_zero});
      alternatives.push_back({one_at_0, zero_by_zero});
    }
    if (f0 != f1 && std::abs(f0 - f1) > 1e-12) alternatives.push_back({swapped, mirrored});
    judge_inverse(c, 1e-11, 1e-15, alternatives);
  }
}

TEST_CASE("Lab 5.2: the linear density is right, and 0 outside [0, 1]", "[lab05][ex2]") {
  for (const auto& [f0, f1] : {std::pair{1.0, 3.0}, {2.0, 0.0}, {0.7, 0.7}}) {
    const auto raw = [f0 = f0, f1 = f1](double x) {
      return x < 0 || x > 1 ? 0 : (1 - x) * f0 + x * f1;
    };
    const auto half = [c = linear(f0, f1)](double x) { return c.pdf(x) / 2; };
    std::vector<Alternative> alternatives{{raw, not_normalised}, {half, not_normalised}};
    if (f0 != f1) alternatives.push_back({linear(f1, f0).pdf, mirrored});
    judge_density(linear(f0, f1), alternatives);
  }
}

TEST_CASE("Lab 5.2: tent samples are the inverse of the CDF", "[lab05][ex2]") {
  for (const double r : {1.0, 2.5, 1e-3}) {
    const auto unstretched = [=](double u) {
      return u < 0.5 ? r * (std::sqrt(u) - 1) : r * (1 - std::sqrt(1 - u));
    };
    const auto climbs = [=](double u) {
      return u < 0.5 ? r * (std::sqrt(2 * u) - 1) : r * std::sqrt(2 * u - 1);
    };
    judge_inverse(tent(r), 0, 1e-14 * r,
                  {{unstretched, half_tent},
                   {climbs, peaks_outside},
                   {[=](double u) { return r * (2 * u - 1); }, not_inverted},
                   {[=](double u) { return r * (1 - std::sqrt(1 - u)); }, one_half},
                   {[=](double u) { return r * std::sqrt(u); }, one_half}});
  }
}

TEST_CASE("Lab 5.2: the tent density is right, and 0 outside", "[lab05][ex2]") {
  for (const double r : {1.0, 2.5, 1e-3}) {
    const auto raw = [=](double x) { return std::abs(x) > r ? 0 : 1 - std::abs(x) / r; };
    const auto times = [=](double x) { return r * raw(x); };
    std::vector<Alternative> alternatives;
    if (r != 1) alternatives = {{raw, not_normalised}, {times, not_normalised}};
    judge_density(tent(r), alternatives);
  }
}

TEST_CASE("Lab 5.2: samples fill every cell by its integral", "[lab05][ex2]") {
  judge_samples(linear(1, 3), 0, 1);
  judge_samples(linear(2, 0), 0, 1);
  judge_samples(tent(2.5), -2.5, 2.5);
}

TEST_CASE("Lab 5.3: power samples are the inverse of the CDF, to n = 1e7", "[lab05][ex3]") {
  for (const double n : {0.0, 1.0, 2.5, 20.0, 1e7}) {
    std::vector<Alternative> alternatives;
    if (n > 0) {
      const auto lower = [=](double u) { return std::pow(u, 1 / n); };
      alternatives.push_back({lower, exponent_n});
    }
    // exp(log(u) / (n + 1)) is right to some 1e-13: log(u) may be 700.
    judge_inverse(power(n), 1e-12, 0, alternatives);
  }
}

TEST_CASE("Lab 5.3: the power density is right, and 0 outside [0, 1]", "[lab05][ex3]") {
  for (const double n : {0.0, 1.0, 2.5, 20.0}) {
    std::vector<Alternative> alternatives;
    if (n > 0) {
      const auto raw = [=](double x) { return x < 0 || x > 1 ? 0 : std::pow(x, n); };
      alternatives.push_back({raw, not_normalised});
    }
    judge_density(power(n), alternatives);
  }
}

TEST_CASE("Lab 5.3: samples fill every cell by its integral", "[lab05][ex3]") {
  judge_samples(power(2.5), 0, 1);
  judge_samples(power(20), 0, 1);
}
