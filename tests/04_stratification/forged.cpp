// A submission that sends its own answers in place of some probes': tables of the right shape,
// consistent with each other and with theory, for points that nobody drew. Everything else is the
// solution's work, so the points missing from full marks are those where the judge noticed.

#include "grader/attacks/forge.h"
#include "grader/protocol/next_words.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

using carlo::grader::Params;
using carlo::grader::Rows;

namespace {

/// Number i of a sequence that is well spread over [0, 1), and not random.
double spread(std::int64_t i) {
  return std::fmod(0.5 + static_cast<double>(i) * std::sqrt(2.0), 1.0);
}

/// One point in each stratum, and the mean of their squares.
Rows stratified_record(const Params& params) {
  carlo::Rng rng(params.seed);
  const auto n = static_cast<double>(params.n);
  Rows rows{1, {}};
  double sum = 0;
  for (std::int64_t i = 0; i < params.n; ++i) {
    rng.uniform();
    const double x = (static_cast<double>(i) + spread(i)) / n;
    rows.values.push_back(x);
    sum += x * x;
  }
  const auto next = carlo::grader::next_words(rng);
  rows.values.insert(rows.values.begin(), next.begin(), next.end());
  rows.values.insert(rows.values.begin(), {sum / n, n});
  return rows;
}

/// Positions near the middle of strata that were not requested.
Rows middle_places(const Params& params) {
  Rows rows{1, {}};
  for (std::int64_t i = 0; i < params.whole("places"); ++i) {
    const auto stratum = static_cast<double>(i % params.n);
    rows.values.push_back((stratum + 0.5) / static_cast<double>(params.n));
  }
  return rows;
}

/// Points in their cells, and the errors of a function with guessed slopes.
Rows cells_record(const Params& params) {
  const std::int64_t columns = params.whole("columns"), rows = params.whole("rows");
  const std::int64_t per_cell = params.whole("per_cell"), cells = columns * rows;
  const auto m = static_cast<double>(per_cell), k = static_cast<double>(cells);
  Rows table{2, {}};
  double value = 0, variance = 0, squares = 0;
  for (std::int64_t cell = 0; cell < cells; ++cell) {
    double sum = 0, sum_of_squares = 0;
    for (std::int64_t i = 0; i < per_cell; ++i) {
      const std::int64_t number = cell * per_cell + i;
      const double x =
          (static_cast<double>(cell % columns) + spread(2 * number)) / static_cast<double>(columns);
      const double y = (static_cast<double>(cell / columns) + spread(3 * number + 1)) /
                       static_cast<double>(rows);
      const double f = 1.5 * x * x + 2.5 * y;
      table.values.insert(table.values.end(), {x, y});
      sum += f;
      sum_of_squares += f * f;
    }
    const double around = sum_of_squares - sum * sum / m;
    value += sum / m / k;
    squares += sum_of_squares / m / k;
    variance += around / (m - 1) / m / (k * k);
  }
  const double plain = (squares - value * value + variance) / (k * m);
  table.values.insert(table.values.begin(),
                      {params["offset"] + value, std::sqrt(variance), std::sqrt(plain), k * m});
  return table;
}

[[maybe_unused]] const bool forged = [] {
  const auto [probe, params] = carlo::grader::question();
  if (probe == "Lab 4.1 record") carlo::grader::forge(stratified_record(params));
  if (probe == "Lab 4.2 places") carlo::grader::forge(middle_places(params));
  if (probe == "Lab 4.5 record") carlo::grader::forge(cells_record(params));
  return false;
}();

}  // namespace
