#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/report/format.h"
#include "course/report/table.h"
#include "gsl_methods.h"
#include "point_sets.h"
#include "support/atomic_file.h"
#include "support/wall_clock.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

// Recursive stratification beside plain and jittered points and beside GSL's MISER and VEGAS: the
// same integrands, errors against evaluations and against seconds.

namespace lab04 {
namespace {

struct Options {
  std::int64_t n = 1 << 16;
  int repetitions = 201;
  std::uint64_t seed = 1;
  std::string json;
};

struct Method {
  std::string name;
  std::function<double(const Integrand&, std::int64_t)> average;
};

/// |estimate - exact| over many runs, and the time of one.
struct Spread {
  std::int64_t evaluations = 0;
  double lower_quartile = 0, median = 0, upper_quartile = 0, root_mean_square = 0, seconds = 0;
};

std::vector<Method> methods(std::uint64_t seed) {
  const auto rng = std::make_shared<carlo::Rng>(seed);
  const auto miser = std::make_shared<GslMethod>(GslMethod::Kind::miser, seed);
  const auto vegas = std::make_shared<GslMethod>(GslMethod::Kind::vegas, seed);
  const std::vector<PointSet> sets = all_point_sets();
  const auto points = [rng](const PointSet& set) {
    return [rng, make = set.make](const Integrand& g, std::int64_t n) {
      return average_over(make(n, *rng), g);
    };
  };
  return {
      {"random", points(sets[0])},
      {"jittered", points(sets[1])},
      {"recursive",
       [rng](const Integrand& g, std::int64_t n) {
         const auto f = [&g](std::span<const double> x) { return g.f(x[0], x[1]); };
         return recursive_stratification(f, 2, n, *rng).value;
       }},
      {"GSL MISER", [miser](const Integrand& g, std::int64_t n) { return miser->average(g, n); }},
      {"GSL VEGAS", [vegas](const Integrand& g, std::int64_t n) { return vegas->average(g, n); }}};
}

double quantile(std::vector<double>& values, double share) {
  const auto place = std::lround(share * static_cast<double>(values.size() - 1));
  const auto at = values.begin() + place;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::int64_t evaluated = 0;

/// The same integrand, which counts how often it is asked; one at a time.
Integrand counting(const Integrand& g) {
  static double (*inner)(double, double) = nullptr;
  inner = g.f;
  evaluated = 0;
  return {g.name,
          [](double x, double y) {
            ++evaluated;
            return inner(x, y);
          },
          g.average};
}

Spread measure(const Method& method, const Integrand& g, std::int64_t n, int repetitions) {
  Spread spread;
  (void)method.average(counting(g), n);
  spread.evaluations = evaluated;
  std::vector<double> errors, seconds;
  for (int i = 0; i < repetitions; ++i) {
    const carlo::WallClock clock;
    const double value = method.average(g, n);
    seconds.push_back(clock.seconds());
    errors.push_back(std::fabs(value - g.average));
    spread.root_mean_square += errors.back() * errors.back() / repetitions;
  }
  spread.root_mean_square = std::sqrt(spread.root_mean_square);
  spread.lower_quartile = quantile(errors, 0.25);
  spread.median = quantile(errors, 0.5);
  spread.upper_quartile = quantile(errors, 0.75);
  spread.seconds = quantile(seconds, 0.5);
  return spread;
}

/// The root mean square error at a given time, between the two runs around it on log-log axes; none
/// outside of what was measured.
double error_at(double seconds, const std::vector<Spread>& runs) {
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const Spread &a = runs[i - 1], &b = runs[i];
    if (seconds < a.seconds || seconds > b.seconds) continue;
    const double share = std::log(seconds / a.seconds) / std::log(b.seconds / a.seconds);
    return a.root_mean_square * std::pow(b.root_mean_square / a.root_mean_square, share);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

carlo::Cell range_cell(const Spread& s) {
  return {
      fmt::format("{} [{}, {}]", carlo::number_text(s.median, 3),
                  carlo::number_text(s.lower_quartile, 2), carlo::number_text(s.upper_quartile, 2)),
      s.median};
}

void run(const Options& options) {
  carlo::Table table(
      {"integrand", "method", "N asked", "evaluations", "median error [quartiles]", "RMS error",
       "time"},
      {"integrand", "method", "points", "evaluations", "median_error", "rms_error", "seconds"});
  carlo::Table equal({"integrand", "method", "RMS error at equal N", "at equal time", "time"},
                     {"integrand", "method", "error_points", "error_seconds", "seconds"});
  for (const Integrand& g : {bell(), darts(), peak()}) {
    std::vector<std::vector<Spread>> all;
    const std::vector<Method> tried = methods(options.seed);
    for (const Method& method : tried) {
      all.emplace_back();
      for (std::int64_t n = 256; n <= options.n; n *= 4) {
        const Spread s = measure(method, g, n, options.repetitions);
        all.back().push_back(s);
        table.add_row({g.name, method.name, n, s.evaluations, range_cell(s), s.root_mean_square,
                       carlo::seconds_cell(s.seconds)});
      }
    }
    // The time that the fastest method needs for its largest N: all were measured around it.
    double time = std::numeric_limits<double>::infinity();
    for (const auto& runs : all)
      time = std::min(time, runs.back().seconds);
    for (std::size_t i = 0; i < tried.size(); ++i) {
      equal.add_row({g.name, tried[i].name, all[i].back().root_mean_square, error_at(time, all[i]),
                     carlo::seconds_cell(time)});
    }
  }
  fmt::print("{}\nAt equal evaluations (N = {}) and at equal time:\n{}", table.text(),
             carlo::count_text(options.n), equal.text());
  if (!options.json.empty()) {
    const nlohmann::json results = {{"runs", table.json()}, {"equal", equal.json()}};
    carlo::write_file(options.json, results.dump(2) + "\n");
  }
}

}  // namespace
}  // namespace lab04

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    lab04::Options options;
    carlo::CommandLine app("Recursive stratification against MISER and VEGAS of GSL.",
                           "./carlo bench integrators");
    app.option("--n", options.n, "largest number of evaluations")
        .range(1024, 1 << 24)
        .show_default();
    app.option("--repetitions", options.repetitions, "estimates of each kind")
        .range(5, 100'000)
        .show_default();
    app.option("--seed", options.seed, "seed").show_default();
    app.option("--json", options.json, "write the tables to this file");
    if (const auto code = app.parse(argc, argv)) return *code;
    lab04::run(options);
    return 0;
  });
}
