#include "grader/judge/compare.h"

#include "random/rng.h"
#include "stats/distributions.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>

using namespace carlo::grader;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Means of 16 uniform numbers: mean 1/2, variance 1/192, excess kurtosis -1.2/16.
const Theory uniform_means{0.5, std::sqrt(1.0 / 192), -1.2 / 16};

std::vector<double> draw_means(carlo::Rng& rng, std::size_t count) {
  std::vector<double> means(count);
  for (double& mean : means) {
    double sum = 0;
    for (int i = 0; i < 16; ++i)
      sum += rng.uniform();
    mean = sum / 16;
  }
  return means;
}

const Diagnosis known{"known", "a known mistake."};

}  // namespace

// alpha = 1e-6 each. 2000 p-values per test: a distribution of p-values that is off by .12 anywhere
// is caught with power .999. The values are 500 means of 16 numbers, as in checks.
TEST_CASE("a right solution's p-values are uniform", "[compare]") {
  carlo::Rng rng(11);
  std::vector<double> of_mean, of_variance, of_uniform;
  for (int trial = 0; trial < 2000; ++trial) {
    const std::vector<double> values = draw_means(rng, 500);
    of_mean.push_back(mean_is("mean", values, uniform_means).p.value());
    of_variance.push_back(variance_is("variance", values, uniform_means).p.value());
    std::vector<double> points(500);
    for (double& point : points)
      point = 2 + 3 * rng.uniform();
    of_uniform.push_back(uniform_on("points", points, 2, 5).p.value());
  }
  for (const auto& p_values : {of_mean, of_variance, of_uniform}) {
    const Verdict verdict = uniform_on("p-values", p_values, 0, 1);
    INFO(verdict.certainty);
    CHECK(verdict.p.value() >= 1e-6);
  }
}

TEST_CASE("a bias of 8.74 standard errors is caught and named, none is not", "[compare]") {
  carlo::Rng rng(12);
  std::vector<double> values = draw_means(rng, 10'000);
  CHECK(mean_is("mean", values, uniform_means).passed);
  const double effect = 8.74 * uniform_means.sd / 100;
  for (double& value : values)
    value += effect;
  const Verdict verdict = mean_is("mean", values, uniform_means,
                                  {{0.5 + effect, known}, {0.5 - effect, {"other", ""}}});
  CHECK_FALSE(verdict.passed);
  REQUIRE(verdict.diagnoses.size() == 1);
  CHECK(verdict.diagnoses[0].id == "known");
}

TEST_CASE("a variance that is off by a quarter is caught, both ways", "[compare]") {
  carlo::Rng rng(13);
  const std::vector<double> values = draw_means(rng, 10'000);
  for (const double ratio : {0.75, 1.25}) {
    const Theory theory{0.5, uniform_means.sd / std::sqrt(ratio), uniform_means.excess_kurtosis};
    CHECK_FALSE(variance_is("variance", values, theory).passed);
  }
  CHECK(variance_is("variance", values, uniform_means).passed);
}

TEST_CASE("noise of the student's own does not hide a bias", "[compare]") {
  // Values whose spread is a thousand times theory's and whose mean is off by one theoretical
  // standard deviation: a test that took the spread from the values would pass them.
  std::vector<double> values;
  for (int i = 0; i < 10'000; ++i)
    values.push_back(i % 2 == 0 ? -999 : 1001);
  CHECK_FALSE(mean_is("mean", values, {0, 1, 0}).passed);
  CHECK_FALSE(variance_is("variance", values, {0, 1, 0}).passed);
}

TEST_CASE("NaN and infinity fail every comparison", "[compare]") {
  for (const double bad : {not_a_number, std::numeric_limits<double>::infinity()}) {
    const std::vector<double> values{0.5, bad, 0.5};
    const std::vector<double> expected{0.5, 0.5, 0.5};
    CHECK_FALSE(mean_is("mean", values, uniform_means).passed);
    CHECK_FALSE(variance_is("variance", values, uniform_means).passed);
    CHECK_FALSE(uniform_on("points", values, 0, 1).passed);
    CHECK_FALSE(equals("value", bad, 0.5, 1e9).passed);
    CHECK_FALSE(all_equal("values", values, expected, 1e9).passed);
  }
  CHECK_FALSE(uniform_on("points", {}, 0, 1).passed);
  CHECK_FALSE(mean_is("mean", {}, uniform_means).passed);
}

TEST_CASE("exact comparisons keep their tolerance and name what they fit", "[compare]") {
  CHECK(equals("value", 1 + 1e-13, 1, 1e-12).passed);
  CHECK_FALSE(equals("value", 1 + 1e-11, 1, 1e-12).passed);
  CHECK(equals("value", 0.5, 1, 1e-12, {{0.5, known}}).diagnoses.size() == 1);
  CHECK(equals("value", 0.6, 1, 1e-12, {{0.5, known}}).diagnoses.empty());
  CHECK(equals("value", 1, 1, 0, {{1, known}}).diagnoses.empty());
  const std::vector<double> two{1, 2}, three{1, 2, 3}, other{1, 3};
  CHECK(all_equal("values", two, two, 0).passed);
  CHECK_FALSE(all_equal("values", two, three, 0).passed);
  CHECK_FALSE(all_equal("values", two, other, 0.5).passed);
}

TEST_CASE("a value that comes from no start value is told as that", "[compare]") {
  const Suspects suspects{{7, {"seven", "it is seven."}}};
  const auto id = [&](double measured) {
    const Verdict verdict = equals("value", measured, 1, 1e-12, suspects);
    return verdict.diagnoses.empty() ? "" : verdict.diagnoses[0].id;
  };
  CHECK(id(7) == "seven");
  CHECK(id(8).empty());
  CHECK(id(1e200).empty());
  CHECK(id(-5.313e303) == "no-start-value");
  CHECK(id(-5.313e303 / 1e6) == "no-start-value");
  CHECK(id(-16843010 + 1000) == "no-start-value");
  CHECK(id(-72340172838076674. + 4e6) == "no-start-value");
}
