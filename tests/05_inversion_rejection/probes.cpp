// Probes of lab 5's exercises 5.1 to 5.6. They call the student's functions and return raw values;
// checks_*.cpp says what the values should be.

#include "05_inversion_rejection/inputs.h"
#include "05_inversion_rejection/refusal.h"
#include "grader/worker/probe.h"
#include "grader/worker/refusal.h"
#include "inversion_rejection.h"

using namespace lab05_tests;
using carlo::grader::Params;
using carlo::grader::refusal;
using carlo::grader::refusal_codes;
using carlo::grader::RowWriter;

namespace {

double sample(const Params& params, double u) {
  const double p = params["p"], q = params["q"];
  switch (static_cast<Family>(params.whole("family"))) {
    case Family::exponential:
      return lab05::sample_exponential(u, p);
    case Family::linear:
      return lab05::sample_linear(u, p, q);
    case Family::tent:
      return lab05::sample_tent(u, p);
    case Family::power:
      break;
  }
  return lab05::sample_power(u, p);
}

double pdf(const Params& params, double x) {
  const double p = params["p"], q = params["q"];
  switch (static_cast<Family>(params.whole("family"))) {
    case Family::exponential:
      return lab05::exponential_pdf(x, p);
    case Family::linear:
      return lab05::linear_pdf(x, p, q);
    case Family::tent:
      return lab05::tent_pdf(x, p);
    case Family::power:
      break;
  }
  return lab05::power_pdf(x, p);
}

std::vector<double> weights(const Params& params) {
  return weights_of(static_cast<Weights>(params.whole("weights")));
}

Grid grid(const Params& params) {
  return grid_of(static_cast<GridKind>(params.whole("grid")));
}

lab05::Tabulated2d table_of(const Grid& grid) {
  return lab05::Tabulated2d(grid.weights, grid.width, grid.height);
}

double number(std::size_t index) {
  return static_cast<double>(index);
}

}  // namespace

PROBE("Lab 5.1 to 5.3 inverse", "x",
      "(for u = 0, tiny ones, 0.01, 0.02 ... 0.99, and up to the last double below 1)") {
  RowWriter rows;
  for (const double u : hard_numbers())
    rows.add({sample(params, u)});
  return rows.take();
}

PROBE("Lab 5.1 to 5.3 density", "density", "(at n + 1 places, evenly from first to last)") {
  const double first = params["first"], last = params["last"];
  RowWriter rows;
  for (std::int64_t i = 0; i <= params.n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(params.n);
    rows.add({pdf(params, first + (last - first) * share)});
  }
  return rows.take();
}

PROBE("Lab 5.1 to 5.3 samples", "x") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i)
    rows.add({sample(params, rng.uniform())});
  return rows.take();
}

PROBE("Lab 5.4 picks", "index", "fraction",
      "(for u from 0 to the last double below 1, both sides of each share's edge among them; nan: "
      "the weights were refused)") {
  const std::vector<double> list = weights(params);
  const std::vector<double> numbers = numbers_for(list);
  return rows_or_nan(numbers.size(), 2, [&] {
    const lab05::Discrete discrete(list);
    RowWriter rows;
    for (const double u : numbers) {
      const auto [index, fraction] = discrete.sample(u);
      rows.add({number(index), fraction});
    }
    return rows.take();
  });
}

PROBE("Lab 5.4 probabilities", "probability", "(nan: the weights were refused)") {
  const std::vector<double> list = weights(params);
  return rows_or_nan(list.size(), 1, [&] {
    const lab05::Discrete discrete(list);
    RowWriter rows;
    for (std::size_t i = 0; i < discrete.size(); ++i)
      rows.add({discrete.probability(i)});
    return rows.take();
  });
}

PROBE("Lab 5.4 samples", "index", "fraction") {
  carlo::Rng rng(params.seed);
  const lab05::Discrete discrete(weights(params));
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const auto [index, fraction] = discrete.sample(rng.uniform());
    rows.add({number(index), fraction});
  }
  return rows.take();
}

// n equal weights of 0.1; u in the middle of every stride-th share, and the last u of all.
PROBE("Lab 5.4 many weights", "index", "probability",
      "(for u in the middle of every stride-th share; last row: the last double below 1)") {
  const std::vector<double> list(static_cast<std::size_t>(params.n), 0.1);
  const lab05::Discrete discrete(list);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; i += params.whole("stride")) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(params.n);
    rows.add({number(discrete.sample(u).index), discrete.probability(static_cast<std::size_t>(i))});
  }
  rows.add({number(discrete.sample(last_below_one).index), discrete.probability(list.size() - 1)});
  return rows.take();
}

PROBE("Lab 5.4 refusal", "refusal", refusal_codes) {
  const auto list = bad_weights(params.whole("kind"));
  return {1, {refusal([&] { (void)lab05::Discrete(list); })}};
}

PROBE("Lab 5.4 huge weights", "refusal", "probability ...", refusal_codes) {
  const std::vector<double> list = huge_weights();
  std::vector<double> row(1 + list.size());
  row[0] = refusal([&] {
    const lab05::Discrete discrete(list);
    for (std::size_t i = 0; i < list.size(); ++i)
      row[1 + i] = discrete.probability(i);
  });
  return {row.size(), row};
}

PROBE("Lab 5.5 inverse", "x", "density at x",
      "(for u from 0 to the last double below 1, both sides of each bin's edge among them)") {
  const std::vector<double> list = weights(params);
  const lab05::Tabulated1d table(list);
  RowWriter rows;
  for (const double u : numbers_for(list)) {
    const double x = table.sample(u);
    rows.add({x, table.pdf(x)});
  }
  return rows.take();
}

PROBE("Lab 5.5 density", "density",
      "(in the middle of each bin; the last four: at -0.5, just below 0, at 1, at 1.5)") {
  const lab05::Tabulated1d table(weights(params));
  RowWriter rows;
  for (std::size_t i = 0; i < table.size(); ++i)
    rows.add({table.pdf((number(i) + 0.5) / number(table.size()))});
  for (const double outside : {-0.5, -5e-324, 1.0, 1.5})
    rows.add({table.pdf(outside)});
  return rows.take();
}

PROBE("Lab 5.5 samples", "x") {
  carlo::Rng rng(params.seed);
  const lab05::Tabulated1d table(weights(params));
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i)
    rows.add({table.sample(rng.uniform())});
  return rows.take();
}

PROBE("Lab 5.5 many bins", "x", "density at x",
      "(for u = 0, tiny ones, 0.01, 0.02 ... 0.99, and up to the last double below 1)") {
  const std::vector<double> list(static_cast<std::size_t>(params.n), 0.1);
  const lab05::Tabulated1d table(list);
  RowWriter rows;
  for (const double u : hard_numbers()) {
    const double x = table.sample(u);
    rows.add({x, table.pdf(x)});
  }
  return rows.take();
}

PROBE("Lab 5.6 inverse", "x", "y", "density there",
      "(for all pairs of u_row and u_column, from 0 to the last double below 1, then some within "
      "rare shares; u_column runs faster)") {
  const Grid g = grid(params);
  const lab05::Tabulated2d table = table_of(g);
  const std::vector<double> u = numbers_for(g);
  RowWriter rows;
  for (const double u_row : u) {
    for (const double u_column : u) {
      const lab05::Point p = table.sample(u_row, u_column);
      rows.add({p.x, p.y, table.pdf(p)});
    }
  }
  return rows.take();
}

PROBE("Lab 5.6 density", "density",
      "(in the middle of each cell, row by row; the last four: outside the square)") {
  const Grid g = grid(params);
  const lab05::Tabulated2d table = table_of(g);
  RowWriter rows;
  for (std::size_t j = 0; j < g.height; ++j) {
    for (std::size_t i = 0; i < g.width; ++i) {
      const lab05::Point centre{(number(i) + 0.5) / number(g.width),
                                (number(j) + 0.5) / number(g.height)};
      rows.add({table.pdf(centre)});
    }
  }
  for (const lab05::Point outside : {lab05::Point{-0.1, 0.1}, {1, 0.1}, {0.1, -0.1}, {0.1, 1}}) {
    rows.add({table.pdf(outside)});
  }
  return rows.take();
}

PROBE("Lab 5.6 samples", "x", "y") {
  carlo::Rng rng(params.seed);
  const lab05::Tabulated2d table = table_of(grid(params));
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const double u_row = rng.uniform();
    const double u_column = rng.uniform();
    const lab05::Point p = table.sample(u_row, u_column);
    rows.add({p.x, p.y});
  }
  return rows.take();
}

// width x height equal weights of 0.1: the point is (u_column, u_row).
PROBE("Lab 5.6 many cells", "x", "y", "density there",
      "(for u_row from 0 to the last double below 1, and u_column = 1 - u_row)") {
  const auto width = static_cast<std::size_t>(params.whole("width"));
  const auto height = static_cast<std::size_t>(params.whole("height"));
  const std::vector<double> list(width * height, 0.1);
  const lab05::Tabulated2d table(list, width, height);
  RowWriter rows;
  for (const double u : hard_numbers()) {
    const lab05::Point p = table.sample(u, last_below_one - u);
    rows.add({p.x, p.y, table.pdf(p)});
  }
  return rows.take();
}

PROBE("Lab 5.6 refusal", "refusal", refusal_codes) {
  const auto kind = params.whole("kind");
  const std::vector<double> list = bad_cells(kind);
  return {1, {refusal([&] { (void)lab05::Tabulated2d(list, 2, 2); })}};
}
