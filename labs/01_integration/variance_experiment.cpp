#include "course/report/page.h"
#include "course/report/table.h"
#include "experiments.h"
#include "integration.h"
#include "support/wall_clock.h"

#include <cmath>
#include <functional>

// Variances of numbers with a large mean, and sums in float: what the obvious code does. The two
// naive forms below are the subject of the experiment, not an example.

namespace lab01 {
namespace {

/// E[x^2] - E[x]^2 from running sums of type T, times N/(N-1).
template <class T>
double variance_from_squares(const std::vector<double>& numbers) {
  T sum = 0, squares = 0;
  for (const double number : numbers) {
    const auto x = static_cast<T>(number);
    sum += x;
    squares += x * x;
  }
  const auto n = static_cast<T>(numbers.size());
  return static_cast<double>((squares - sum * sum / n) / (n - 1));
}

double variance_from_moments(const std::vector<double>& numbers) {
  Moments moments;
  for (const double x : numbers)
    moments.add(x);
  return moments.variance();
}

/// The actual variance of the numbers, by two passes in extended precision.
double reference_variance(const std::vector<double>& numbers) {
  long double sum = 0, squares = 0;
  for (const double x : numbers)
    sum += x;
  const long double mean = sum / static_cast<long double>(numbers.size());
  for (const double x : numbers)
    squares += (x - mean) * (x - mean);
  return static_cast<double>(squares / static_cast<long double>(numbers.size() - 1));
}

struct Method {
  std::string name;
  std::function<double(const std::vector<double>&)> variance;
  double seconds = 0;  ///< over all rounds
  std::vector<carlo::Point> errors;
};

std::vector<double> numbers_with_mean(double mean, std::size_t count, carlo::Rng rng) {
  // Uniform on [-sqrt 3, sqrt 3): standard deviation 1.
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(mean + std::sqrt(3.0) * (2 * rng.uniform() - 1));
  }
  return numbers;
}

/// Adding 1 to a float n times.
void float_counter(Notebook& notebook) {
  carlo::Table table({"ones added", "float says", "time"}, {"ones", "float_sum", "seconds"});
  for (const std::int64_t n : {1'000'000, 10'000'000, 30'000'000}) {
    const carlo::WallClock clock;
    float sum = 0;
    for (std::int64_t i = 0; i < n; ++i)
      sum += 1.0f;
    const double spent = clock.seconds();
    table.add_row({n, static_cast<std::int64_t>(sum), carlo::seconds_cell(spent)});
  }
  notebook.say(
      "Counting in float stops at 2^24: there the next float is 2 away, and adding 1 rounds back. "
      "More points make such an average worse, not better. Count in integers, add up in double.");
  notebook.table("float_counter", table, "A counter of type float");
}

}  // namespace

void variance_experiment(Notebook& notebook) {
  notebook.begin("Variance far from zero");
  const std::size_t count = notebook.options().quick ? 20'000 : 200'000;
  std::vector<Method> methods = {
      {"Σx² in float", variance_from_squares<float>, 0, {}},
      {"Σx² in double", variance_from_squares<double>, 0, {}},
  };
  notebook.attempt([&] {
    (void)variance_from_moments({1, 2});
    methods.push_back({"your Moments", variance_from_moments, 0, {}});
  });

  std::vector<std::string> titles = {"mean", "exact"}, keys = {"mean", "exact"};
  for (const Method& m : methods) {
    titles.push_back(m.name);
    keys.push_back(m.name);
  }
  carlo::Table table(titles, keys);
  constexpr int decades = 10;
  for (int decade = 0; decade < decades; ++decade) {
    notebook.progress(decade, decades);
    const double mean = std::pow(10.0, decade);
    const auto numbers = numbers_with_mean(mean, count, notebook.rng());
    const double exact = reference_variance(numbers);
    std::vector<carlo::Cell> row = {mean, exact};
    for (Method& m : methods) {
      const carlo::WallClock clock;
      const double variance = m.variance(numbers);
      m.seconds += clock.seconds();
      m.errors.push_back({mean, std::fabs(variance / exact - 1)});
      row.emplace_back(variance);
    }
    table.add_row(std::move(row));
  }

  notebook.say(
      "Numbers of standard deviation 1 around a mean that grows from 1 to 1e9. The sum of squares "
      "minus the square of the sum subtracts two numbers of size mean² to find one of size 1: "
      "digits cancel, and even the sign can be wrong.");
  notebook.table("variance", table, "Variance of the same numbers, by each method");
  carlo::Table costs({"method", "time a number", "error at mean 1", "error at mean 1e9"},
                     {"method", "seconds", "error_1", "error_1e9"});
  carlo::Chart chart{"Relative error of the variance", "", {"mean"}, {"relative error"}, {}};
  for (const Method& m : methods) {
    costs.add_row({m.name, carlo::seconds_cell(m.seconds / decades / static_cast<double>(count)),
                   m.errors.front().y, m.errors.back().y});
    chart.series.push_back({m.name, m.errors});
  }
  notebook.table("variance_cost", costs, "What it costs");
  notebook.charts({chart});
  float_counter(notebook);
}

}  // namespace lab01
