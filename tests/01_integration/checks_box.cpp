// Checks of exercises 1.6 and 1.7. For sizes and power see checks_average.cpp.

#include "01_integration/dimensions.h"
#include "01_integration/integrands.h"
#include "01_integration/theory.h"
#include "grader/judge/draws.h"
#include "grader/judge/judge.h"

#include <cmath>
#include <numbers>

using namespace carlo::grader;
using namespace lab01_tests;

namespace {

const Diagnosis volume_missing{"missing-box-volume",
                               "the average over the box is not yet the integral: the box's volume "
                               "is missing."};
const Diagnosis one_side{"volume-of-one-dimension",
                         "the average is multiplied by one side of the box and not by all."};
const Diagnosis same_number{"same-number-in-every-dimension",
                            "all coordinates of a point come from one random number: the points "
                            "lie on the diagonal."};
const Diagnosis outside_box{"points-outside-box", "f is evaluated outside the box."};
const Diagnosis by_accepted{"divided-by-accepted",
                            "the sum is divided by the number of points inside; those outside "
                            "count as well, with value 0."};
const Diagnosis outside_domain{"evaluated-outside-domain",
                               "f is evaluated at points that are not in the domain."};
const Diagnosis error_without_volume{"standard-error-without-volume",
                                     "the standard error is that of the average over the box: it "
                                     "scales with the volume as the value does."};
const Diagnosis error_of_accepted{"zeros-left-out-of-the-error",
                                  "the standard error looks only at the points inside; whether a "
                                  "point falls inside is chance as well."};
const Diagnosis error_by_n{"variance-divided-by-n",
                           "the sum of squares is divided by N; the unbiased estimate takes "
                           "N - 1."};
const Diagnosis error_of_one{"standard-error-of-one-number",
                             "the standard deviation of one value is given; that of the mean is "
                             "smaller by sqrt(N)."};

double box_volume(int d) {
  double product = 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i)
    product *= upper(i) - lower(i);
  return product;
}

/// Of the product of the coordinates: raw moments of independent factors multiply.
RawMoments product_moments(int d) {
  RawMoments all{1, 1, 1, 1};
  for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
    const RawMoments one = power_moments(1, lower(i), upper(i));
    all = {all.m1 * one.m1, all.m2 * one.m2, all.m3 * one.m3, all.m4 * one.m4};
  }
  return all;
}

/// Of the mean of n values of sum (i + 1) x_i^2, times the volume: cumulants of independent
/// summands add.
Theory squares_theory(int d, double n) {
  double mean = 0, variance = 0, fourth = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
    const Theory one = theory_of_mean(power_moments(2, lower(i), upper(i)), 1);
    const double weight = static_cast<double>(i + 1);
    const double part = weight * weight * one.sd * one.sd;
    mean += weight * one.mean;
    variance += part;
    fourth += part * part * one.excess_kurtosis;
  }
  const double volume = box_volume(d);
  return {volume * mean, volume * std::sqrt(variance / n), fourth / (variance * variance) / n};
}

/// The mean of the product when all coordinates share one number, by fine midpoint sums.
double diagonal_product(int d) {
  constexpr int cells = 2000;
  double sum = 0;
  for (int cell = 0; cell < cells; ++cell) {
    double product = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
      product *= lower(i) + (upper(i) - lower(i)) * (cell + 0.5) / cells;
    }
    sum += product;
  }
  return sum / cells;
}

void judge_box(BoxIntegrand integrand, int d) {
  constexpr double n = 16, repetitions = 20'000;
  const Rows rows = probe("Lab 1.6 estimates",
                          {.n = 16,
                           .numbers = {{"d", d},
                                       {"integrand", static_cast<double>(integrand)},
                                       {"repetitions", repetitions}}},
                          {.rows = 20'000, .of = "n = 16, in " + dimensions(d)});
  const bool product = integrand == BoxIntegrand::product;
  const double volume = box_volume(d);
  const Theory theory =
      product ? theory_of_mean(product_moments(d), n, volume) : squares_theory(d, n);
  Suspects suspects{{theory.mean / volume, volume_missing}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(d) && d > 1; ++i) {
    suspects.push_back({theory.mean / volume * (upper(i) - lower(i)), one_side});
  }
  if (product && d > 1) suspects.push_back({volume * diagonal_product(d), same_number});
  judge(mean_is("the integral in " + dimensions(d), rows.values, theory, suspects));
  judge(variance_is("the variance of the estimates in " + dimensions(d), rows.values, theory));
}

constexpr double pi = std::numbers::pi;

/// The domain's box and what the integrals over it and over the square of f are.
struct DomainCase {
  int d;
  Domain domain;
  DomainIntegrand integrand;
  double integral, integral_of_square;

  /// For messages.
  std::string name() const {
    constexpr const char* functions[] = {"1", "2 + x", "x^2"};
    return fmt::format("f = {} on the {}", functions[static_cast<int>(integrand)],
                       d == 2 ? "disc" : "ball");
  }
  double volume() const {
    double product = 1;
    for (int i = 0; i < d; ++i)
      product *= domain_upper[i] - domain_lower[i];
    return product;
  }
  /// The variance of one value volume * f(x) * [x inside].
  double variance() const { return volume() * integral_of_square - integral * integral; }
};

constexpr DomainCase disc_area{2, Domain::ball, DomainIntegrand::one, pi, pi};
constexpr DomainCase disc_tilted{2, Domain::ball, DomainIntegrand::tilted, 2 * pi, 4 * pi + pi / 4};
constexpr DomainCase disc_square{2, Domain::ball, DomainIntegrand::square, pi / 4, pi / 8};
constexpr DomainCase ball_volume{3, Domain::ball, DomainIntegrand::one, 4 * pi / 3, 4 * pi / 3};

Params domain_params(const DomainCase& of, std::int64_t n, double repetitions = 1) {
  return {.n = n,
          .numbers = {{"d", of.d},
                      {"domain", static_cast<double>(of.domain)},
                      {"integrand", static_cast<double>(of.integrand)},
                      {"repetitions", repetitions}}};
}

void judge_domain(const std::string& name, const DomainCase& of) {
  const Rows rows = probe("Lab 1.7 estimates", domain_params(of, 16, 20'000),
                          {.rows = 20'000, .columns = 2, .of = of.name() + ", n = 16"});
  const double inside = of.d == 2 ? pi : 4 * pi / 3;
  const Theory theory{of.integral, std::sqrt(of.variance() / 16)};
  judge(mean_is(name, column(rows, 0), theory,
                {{of.integral / of.volume(), volume_missing},
                 {of.integral * of.volume() / inside, by_accepted}}));
}

}  // namespace

TEST_CASE("Lab 1.6: f is evaluated n times within the box and its values are averaged",
          "[lab01][ex6]") {
  for (const int d : {1, 3, 10}) {
    const Rows rows = probe("Lab 1.6 record", {.n = 4096, .numbers = {{"d", d}, {"integrand", 1}}},
                            {.columns = 5, .of = "in " + dimensions(d)});
    const double expected = box_volume(d) * rows.at(0, 3);
    judge(equals("the number of evaluations of f", rows.at(0, 1), 4096, 0));
    judge(holds("evaluations outside the box", rows.at(0, 2) == 0, fmt::format("{}", rows.at(0, 2)),
                "none", {outside_box}));
    judge(equals("the estimate against the values that f returned", rows.at(0, 0), expected,
                 1e-12 * expected, {{rows.at(0, 3), volume_missing}}));
    judge(draws(rows.at(0, 4), 4096.0 * d));
  }
}

// The largest cv is .67 (the product in five dimensions): 320 000 evaluations catch a bias of 1.1
// %.
TEST_CASE("Lab 1.6: the integral over a box is unbiased and its variance falls as 1/n",
          "[lab01][ex6]") {
  for (const int d : {1, 2, 3, 5})
    judge_box(BoxIntegrand::product, d);
  for (const int d : {2, 10})
    judge_box(BoxIntegrand::squares, d);
}

TEST_CASE("Lab 1.7: f is never evaluated outside the domain", "[lab01][ex7]") {
  for (const DomainCase& of : {disc_area, disc_tilted, ball_volume}) {
    const Rows rows =
        probe("Lab 1.7 record", domain_params(of, 4096), {.columns = 9, .of = of.name()});
    judge(holds("evaluations of f outside the domain", rows.at(0, 3) == 0,
                fmt::format("{}", rows.at(0, 3)), "none", {outside_domain}));
    judge(holds("points outside the box", rows.at(0, 5) == 0, fmt::format("{}", rows.at(0, 5)),
                "none", {outside_box}));
    judge(holds("points that were asked for", rows.at(0, 4) >= 4096,
                fmt::format("{}", rows.at(0, 4)), "n = 4096 at least"));
    judge(draws(rows.at(0, 8), 4096 * of.d));
  }
}

TEST_CASE("Lab 1.7: the value comes from all n points, those outside count as 0", "[lab01][ex7]") {
  for (const DomainCase& of : {disc_area, disc_tilted, ball_volume}) {
    const Rows rows =
        probe("Lab 1.7 record", domain_params(of, 4096), {.columns = 9, .of = of.name()});
    const double sum = rows.at(0, 7);
    const double expected = of.volume() * sum / 4096;
    judge(equals("the value against the values that f returned", rows.at(0, 0), expected,
                 1e-12 * expected,
                 {{of.volume() * sum / rows.at(0, 6), by_accepted}, {sum / 4096, volume_missing}}));
  }
}

// The largest cv is 1.61 (x^2 on the disc): 320 000 evaluations catch a bias of 2.5 %.
TEST_CASE("Lab 1.7: integrals over the disc and the ball are unbiased", "[lab01][ex7]") {
  judge_domain("the area of the disc", disc_area);
  judge_domain("the integral of 2 + x over the disc", disc_tilted);
  judge_domain("the integral of x^2 over the disc", disc_square);
  judge_domain("the volume of the ball", ball_volume);
}

// s^2 / n is an unbiased estimate of the variance of the value for every n: at n = 4, dividing by N
// reads 25 % low. One value is 0 or the volume, with excess kurtosis -1.94, so a squared standard
// error at n = 4 has a relative standard deviation of .42, and 20 000 of them catch 2.6 %.
TEST_CASE("Lab 1.7: the squared standard error is right on average", "[lab01][ex7]") {
  for (const double n : {4.0, 64.0}) {
    const DomainCase& of = disc_area;
    const Rows rows =
        probe("Lab 1.7 estimates", domain_params(of, static_cast<std::int64_t>(n), 20'000),
              {.rows = 20'000, .columns = 2});
    std::vector<double> squares;
    for (const double error : column(rows, 1))
      squares.push_back(error * error);
    const double p = of.integral / of.volume();
    const double variance = of.variance();
    const double kurtosis = (1 - 6 * p * (1 - p)) / (p * (1 - p));
    const double right = variance / n;
    const double sd = right * std::sqrt(kurtosis / n + 2 / (n - 1));
    judge(mean_is(fmt::format("the squared standard error, n = {:g}", n), squares, {right, sd},
                  {{right / (of.volume() * of.volume()), error_without_volume},
                   {right * (n - 1) / n, error_by_n},
                   {variance, error_of_one},
                   {0, error_of_accepted}}));
  }
}

// The squares of 4000 z-scores at n = 400; their mean is 1 + 1/n and more by less than .01, the
// test's threshold is .13: standard errors that are off by 10 % are caught.
TEST_CASE("Lab 1.7: errors are as large as the standard error says", "[lab01][ex7]") {
  const DomainCase& of = disc_tilted;
  const Rows rows =
      probe("Lab 1.7 estimates", domain_params(of, 400, 4'000), {.rows = 4'000, .columns = 2});
  std::vector<double> scores;
  for (std::size_t row = 0; row < rows.count(); ++row) {
    scores.push_back((rows.at(row, 0) - of.integral) / rows.at(row, 1));
  }
  const double volume = of.volume();
  judge(variance_is("the mean square of error / standard error", scores, {0, 1, 0},
                    {{volume * volume, error_without_volume}, {1.0 / 400, error_of_one}}));
}

TEST_CASE("Lab 1.7: one point gives a value and the standard error 0", "[lab01][ex7]") {
  const Rows rows = probe("Lab 1.7 record", domain_params(disc_area, 1),
                          {.columns = 9, .of = disc_area.name() + ", n = 1"});
  const double expected = rows.at(0, 6) * disc_area.volume();
  judge(equals("the value", rows.at(0, 0), expected, 1e-12 * expected));
  judge(equals("the standard error", rows.at(0, 1), 0, 0));
}

TEST_CASE("Lab 1.7: an empty domain gives 0, and the whole box the integral over it",
          "[lab01][ex7]") {
  const DomainCase nothing{2, Domain::nothing, DomainIntegrand::one, 0, 0};
  const DomainCase all{2, Domain::everything, DomainIntegrand::one, 0, 0};
  const Rows none =
      probe("Lab 1.7 record", domain_params(nothing, 100), {.columns = 9, .of = "an empty domain"});
  judge(equals("the area of nothing", none.at(0, 0), 0, 0));
  judge(equals("its standard error", none.at(0, 1), 0, 0));
  const Rows whole =
      probe("Lab 1.7 record", domain_params(all, 100), {.columns = 9, .of = "the whole box"});
  judge(equals("the area of the whole box", whole.at(0, 0), all.volume(), 1e-12 * all.volume()));
  judge(equals("its standard error", whole.at(0, 1), 0, 1e-12));
}
