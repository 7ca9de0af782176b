#pragma once

#include "course/report/page.h"
#include "course/report/table.h"
#include "stats/fit.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// The result of one integration method with `points` evaluations of the integrand.
struct Measurement {
  std::int64_t points = 0;
  double estimate = 0;  ///< one estimate, for the reader
  double error = 0;     ///< size of the error: |estimate - exact| for a rule, else over repetitions
  double seconds = 0;   ///< per estimate
};

/// How the errors of repeated random estimates are summarised: by their root mean square, or by the
/// median of their sizes where the variance may be infinite and a root mean square is meaningless.
enum class Summary { root_mean_square, median };

/// One random estimate and its exact value.
struct Trial {
  double estimate = 0, exact = 0;
};

/// Repeats a random estimate that takes `points` evaluations, at least `repetitions` times.
Measurement repeat(std::int64_t points, int repetitions, Summary summary,
                   const std::function<Trial()>& trial);

/// Times a rule, repeating it for at least two milliseconds.
Measurement time_rule(std::int64_t points, double exact, const std::function<double()>& rule);

/// Returns the seconds of the fastest of three rounds of work. The return value of `work` is kept
/// from being optimised away.
double best_seconds(const std::function<double()>& work);

/// Returns the seconds per draw(), from `count` draws in each round.
template <class Draw>
double seconds_a_draw(std::int64_t count, const Draw& draw) {
  const double seconds = best_seconds([&] {
    double sum = 0;
    for (std::int64_t i = 0; i < count; ++i)
      sum += static_cast<double>(draw());
    return sum;
  });
  return seconds / static_cast<double>(count);
}

/// Returns first, first 4, first 16, ... up to `last`.
std::vector<std::int64_t> ladder(std::int64_t first, std::int64_t last);

/// One method's measurements, with the slopes of its error.
struct Curve {
  std::string name;
  std::vector<Measurement> runs;

  /// Returns the slope of error against points or seconds on log-log axes; none with fewer than
  /// three points above the rounding errors of double.
  std::optional<PowerFit> against_points() const;
  std::optional<PowerFit> against_seconds() const;
};

/// Returns two charts of the same curves: error against points and against seconds. With `fitted`
/// the slopes are drawn.
std::vector<Chart> error_charts(const std::string& title, const std::string& error_label,
                                const std::vector<Curve>& curves, bool fitted = true);

/// Returns a table of all measurements: method, points, estimate, error, seconds; every `stride`-th
/// rung, counted from the last.
Table measurement_table(const std::vector<Curve>& curves, std::size_t stride = 1);

/// "-0.501 ± 0.012", or an empty cell.
Cell slope_cell(const std::optional<PowerFit>& fit);

/// A curve and its theoretical slope, in words.
struct ExpectedCurve {
  Curve curve;
  const char* slope;
};

/// Returns a table of both slopes of each curve, next to theory's.
Table slope_table(const std::vector<ExpectedCurve>& curves);

/// Returns the curves without the slopes.
std::vector<Curve> curves_of(const std::vector<ExpectedCurve>& expected);

}  // namespace carlo
