// Checks of exercise 1.7. For sizes and power see checks_average.cpp.

#include "01_integration/integrands.h"
#include "01_integration/points.h"
#include "01_integration/slips.h"
#include "grader/judge/draws.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab01_tests;

namespace {

const Diagnosis by_accepted{"divided-by-accepted",
                            "the sum is divided by the number of points inside; those outside "
                            "count as well, with value 0."};
const Diagnosis outside_domain{"evaluated-outside-domain",
                               "f is evaluated at points that are not in the domain."};
const Diagnosis error_without_volume{"standard-error-without-volume",
                                     "the standard error is that of the average over the box: it "
                                     "scales with the volume as the value does."};
const Diagnosis error_by_root{"standard-error-by-root-of-volume",
                              "the standard error is multiplied by the root of the volume; it "
                              "scales like the value, with the volume itself."};
const Diagnosis error_of_accepted{"zeros-left-out-of-the-error",
                                  "the standard error looks only at the points inside; whether a "
                                  "point falls inside is random as well."};
const Diagnosis error_by_n{"variance-divided-by-n",
                           "the sum of squares is divided by N; the unbiased estimate takes "
                           "N - 1."};
const Diagnosis error_of_one{"standard-error-of-one-number",
                             "the standard deviation of one value is given; that of the mean is "
                             "smaller by sqrt(N)."};

const Diagnosis outside_domain_box{"points-outside-box", "points are taken outside the box."};

constexpr double pi = std::numbers::pi;

/// The domain's box, and the integrals of f and its square over the domain.
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
  double sum_of_box_sides() const {
    double sum = 0;
    for (int i = 0; i < d; ++i)
      sum += domain_upper[i] - domain_lower[i];
    return sum;
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

/// One estimate from n points. Its points are trusted as far as they follow from the seed.
struct DomainRecord {
  double value, error, asked, evaluated;
  Drawing drawing;
  Points points;    ///< passed to `inside`
  Points f_points;  ///< passed to f, NaN past the last
};

DomainRecord domain_record(const DomainCase& of, std::int64_t n, const std::string& name) {
  constexpr std::size_t head = 8;
  const auto d = static_cast<std::size_t>(of.d);
  const std::size_t numbers = static_cast<std::size_t>(n) * d;
  const Answer rows = probe("Lab 1.7 record", domain_params(of, n),
                            {.rows = head + 2 * numbers, .finite = false, .of = name});
  const auto first = rows.values.begin() + head, second = first + static_cast<long>(numbers);
  return {rows.values[0],
          rows.values[1],
          rows.values[2],
          rows.values[3],
          drawing(rows, 4),
          {d, {first, second}},
          {d, {second, rows.values.end()}}};
}

/// The number of points in the domain, and the sums of f and its square there.
struct DomainSums {
  double accepted = 0;
  long double sum = 0, of_squares = 0;
};

DomainSums sums_of(const DomainCase& of, const Points& points) {
  DomainSums sums;
  for (std::size_t i = 0; i < points.count(); ++i) {
    if (!contains(of.domain, points.at(i))) continue;
    const long double y = evaluate(of.integrand, points.at(i));
    sums.accepted += 1;
    sums.sum += y;
    sums.of_squares += y * y;
  }
  return sums;
}

/// If the points lie on the diagonal, other numbers and fewer follow from that.
Verdict unless_on_diagonal(Verdict verdict, const DomainRecord& record) {
  if (!verdict.passed && record.points.on_diagonal(domain_lower, domain_upper))
    verdict.diagnoses = {same_number};
  return verdict;
}

/// Checks that the recorded points are those from the generator.
void judge_points(const DomainRecord& record) {
  judge(unless_on_diagonal(
      made_of("where the points lie in the box", record.points.shares(domain_lower, domain_upper),
              record.drawing.before),
      record));
}

void judge_domain(const std::string& name, const DomainCase& of) {
  const Rows rows = probe("Lab 1.7 estimates", domain_params(of, 16, 20'000),
                          {.rows = 20'000, .columns = 2, .of = of.name() + ", n = 16"});
  const double inside = of.d == 2 ? pi : 4 * pi / 3;
  const Theory theory{of.integral, std::sqrt(of.variance() / 16)};
  Suspects suspects{{of.integral / of.volume(), volume_missing},
                    {of.integral * of.volume() / inside, by_accepted},
                    of_whole_division(16)};
  add_sums_of_sides(suspects, of.integral / of.volume(), of.sum_of_box_sides(), of.d);
  judge(mean_is(name, column(rows, 0), theory, suspects));
}

}  // namespace

TEST_CASE("Lab 1.7: f is never evaluated outside the domain", "[lab01][ex7]") {
  constexpr std::int64_t n = 4096;
  for (const DomainCase& of : {disc_area, disc_tilted, ball_volume}) {
    const DomainRecord record = domain_record(of, n, of.name());
    const auto known = std::min<std::size_t>(n, static_cast<std::size_t>(record.evaluated));
    double outside = 0;
    for (std::size_t i = 0; i < known; ++i)
      outside += contains(of.domain, record.f_points.at(i)) ? 0 : 1;
    judge(holds("evaluations of f outside the domain", outside == 0, fmt::format("{}", outside),
                "none", {outside_domain}));
    judge(holds("points that were asked for", record.asked >= n, fmt::format("{}", record.asked),
                "n = 4096 at least"));
    if (record.asked >= n) {
      const double astray = record.points.outside(domain_lower, domain_upper);
      judge(holds("points outside the box", astray == 0, fmt::format("{}", astray), "none",
                  {outside_domain_box}));
      judge_points(record);
    }
    judge(unless_on_diagonal(
        draws(record.drawing.before, record.drawing.next, static_cast<double>(n * of.d)), record));
  }
}

TEST_CASE("Lab 1.7: the value comes from all n points, those outside count as 0", "[lab01][ex7]") {
  for (const DomainCase& of : {disc_area, disc_tilted, ball_volume}) {
    const DomainRecord record = domain_record(of, 4096, of.name());
    judge_points(record);
    const DomainSums sums = sums_of(of, record.points);
    const auto mean = static_cast<double>(sums.sum / 4096);
    const double expected = of.volume() * mean;
    Suspects suspects{{expected * 4096 / sums.accepted, by_accepted},
                      {mean, volume_missing},
                      of_whole_division(4096)};
    add_sums_of_sides(suspects, mean, of.sum_of_box_sides(), of.d);
    judge(equals("the value against the values of f at the points", record.value, expected,
                 1e-12 * expected, suspects));
    const long double spread = sums.of_squares - sums.sum * sums.sum / 4096;
    const double error = of.volume() * std::sqrt(static_cast<double>(spread / 4095 / 4096));
    Suspects errors{{error / of.volume(), error_without_volume},
                    {error / std::sqrt(of.volume()), error_by_root},
                    {error * std::sqrt(4095.0 / 4096), error_by_n},
                    {error * 64, error_of_one}};
    add_sums_of_sides(errors, error / of.volume(), of.sum_of_box_sides(), of.d);
    judge(equals("the standard error against the values of f at the points", record.error, error,
                 1e-10 * error, errors));
  }
}

// The largest cv is 1.61 (x^2 on the disc): 320 000 evaluations detect a bias of 2.5 %.
TEST_CASE("Lab 1.7: integrals over the disc and the ball are unbiased", "[lab01][ex7]") {
  judge_domain("the area of the disc", disc_area);
  judge_domain("the integral of 2 + x over the disc", disc_tilted);
  judge_domain("the integral of x^2 over the disc", disc_square);
  judge_domain("the volume of the ball", ball_volume);
}

// s^2 / n is an unbiased estimate of the variance of the value for every n: at n = 4, dividing by N
// gives 25 % less. One value is 0 or the volume, with excess kurtosis -1.94, so a squared standard
// error at n = 4 has a relative standard deviation of .42, and 20 000 of them detect 2.6 %.
TEST_CASE("Lab 1.7: the squared standard error is right on average", "[lab01][ex7]") {
  for (const double n : {4.0, 64.0}) {
    const DomainCase& of = disc_area;
    const Rows rows =
        probe("Lab 1.7 estimates", domain_params(of, static_cast<std::int64_t>(n), 20'000),
              {.rows = 20'000, .columns = 2, .of = fmt::format("{}, n = {:g}", of.name(), n)});
    std::vector<double> squares;
    for (const double error : column(rows, 1))
      squares.push_back(error * error);
    // Without the points outside, the mean of 1 is 1 if there is any point, and the value is wrong
    // together with its error.
    const std::vector<double> values = column(rows, 0);
    const bool all_inside = std::all_of(values.begin(), values.end(), [&](double value) {
      return value == 0 || std::abs(value - of.volume()) <= 1e-9 * of.volume();
    });
    const double p = of.integral / of.volume();
    const double variance = of.variance();
    const double kurtosis = (1 - 6 * p * (1 - p)) / (p * (1 - p));
    const double right = variance / n;
    const double sd = right * std::sqrt(kurtosis / n + 2 / (n - 1));
    judge(mean_is(fmt::format("the squared standard error, n = {:g}", n), squares, {right, sd},
                  {{right / (of.volume() * of.volume()), error_without_volume},
                   {right / of.volume(), error_by_root},
                   {right * (n - 1) / n, error_by_n},
                   {variance, error_of_one},
                   {0, all_inside ? by_accepted : error_of_accepted}}));
  }
}

// The squares of 4000 z-scores at n = 400; their mean exceeds 1 + 1/n by less than .01, the test's
// threshold is .13: standard errors that are off by 10 % are detected.
TEST_CASE("Lab 1.7: errors are as large as the standard error says", "[lab01][ex7]") {
  const DomainCase& of = disc_tilted;
  const Rows rows = probe("Lab 1.7 estimates", domain_params(of, 400, 4'000),
                          {.rows = 4'000, .columns = 2, .of = of.name() + ", n = 400"});
  std::vector<double> scores;
  for (std::size_t row = 0; row < rows.count(); ++row) {
    scores.push_back((rows.at(row, 0) - of.integral) / rows.at(row, 1));
  }
  const double volume = of.volume();
  judge(variance_is("the mean square of error / standard error", scores, {0, 1, 0},
                    {{volume * volume, error_without_volume}, {1.0 / 400, error_of_one}}));
}

TEST_CASE("Lab 1.7: one point gives a value and the standard error 0", "[lab01][ex7]") {
  const DomainRecord record = domain_record(disc_area, 1, disc_area.name() + ", n = 1");
  judge_points(record);
  const double expected = sums_of(disc_area, record.points).accepted * disc_area.volume();
  judge(equals("the value", record.value, expected, 1e-12 * expected));
  judge(equals("the standard error", record.error, 0, 0));
}

TEST_CASE("Lab 1.7: an empty domain gives 0, and the whole box the integral over it",
          "[lab01][ex7]") {
  const DomainCase nothing{2, Domain::nothing, DomainIntegrand::one, 0, 0};
  const DomainCase all{2, Domain::everything, DomainIntegrand::one, 0, 0};
  const DomainRecord none = domain_record(nothing, 100, "an empty domain");
  judge(equals("the area of nothing", none.value, 0, 0));
  judge(equals("its standard error", none.error, 0, 0));
  const DomainRecord whole = domain_record(all, 100, "the whole box");
  judge(equals("the area of the whole box", whole.value, all.volume(), 1e-12 * all.volume()));
  judge(equals("its standard error", whole.error, 0, 1e-12));
}
