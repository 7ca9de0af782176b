#pragma once

#include "09_bias/pixel_filter_theory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

// The record of Lab 9.2's rays for judging them: their positions, and the result.

namespace lab09_pixels {

/// The positions of one pixel's rays, and the result.
struct RaysAnswer {
  FilterCase filter;
  std::vector<PixelPoint> offsets;
  std::vector<RayRadiance> radiances;
  double rays = 0;
  std::array<double, 3> pixel{};
  std::vector<double> own_values;  ///< filter_value() at the offsets
  bool offsets_right = true;       ///< from sample_filter()

  std::size_t count() const { return offsets.size(); }
};

/// A pixel at the film's corner: rays leave it to the left and at the bottom.
constexpr int corner_x = 0, corner_y = film_height - 1;

inline RaysAnswer rays_answer(std::size_t filter, bool weighted, std::int64_t n) {
  const auto count = static_cast<std::size_t>(n);
  const carlo::grader::Answer rows = carlo::grader::probe(
      "Lab 9.2 rays",
      {.n = n,
       .numbers = {{"filter", static_cast<double>(filter)},
                   {"weighted", weighted ? 1 : 0},
                   {"x", corner_x},
                   {"y", corner_y}}},
      {.rows = count + 2,
       .columns = 3,
       .finite = false,
       .of = fmt::format("{} rays of {}_pixel", n, weighted ? "weighted" : "filtered")});
  RaysAnswer answer{drawn_filters(rows.seed).at(filter),
                    {},
                    drawn_radiance(rows.seed, n),
                    rows.at(count + 1, 0),
                    {rows.at(count, 0), rows.at(count, 1), rows.at(count, 2)},
                    {},
                    true};
  for (std::size_t i = 0; i < count; ++i) {
    answer.offsets.push_back({rows.at(i, 0), rows.at(i, 1)});
    answer.own_values.push_back(rows.at(i, 2));
  }
  return answer;
}

/// True if sample_filter() is right: the effects of a wrong one are not the rays' mistakes.
inline bool offsets_are_right(std::size_t filter) {
  const std::size_t count = drawn_pairs(0).size();
  const carlo::grader::Answer rows = carlo::grader::probe(
      "Lab 9.2 offsets", {.numbers = {{"filter", static_cast<double>(filter)}}},
      {.rows = count, .columns = 2, .finite = false, .of = "offsets by a filter"});
  const FilterCase c = drawn_filters(rows.seed).at(filter);
  const std::vector<PixelPoint> pairs = drawn_pairs(rows.seed);
  bool right = true;
  for (std::size_t i = 0; i < count; ++i) {
    right = right && std::abs(rows.at(i, 0) - place_of(c, pairs[i].x)) < 0.01 &&
            std::abs(rows.at(i, 1) - place_of(c, pairs[i].y)) < 0.01;
  }
  return right;
}

/// Positions on the film are floats.
constexpr double place_rounding = 1e-4;

inline bool within(const FilterCase& filter, PixelPoint p) {
  const double r = filter.radius + place_rounding;
  return std::abs(p.x) <= r && std::abs(p.y) <= r;
}

template <class Is>
bool all_offsets(const RaysAnswer& answer, const Is& is) {
  return std::all_of(answer.offsets.begin(), answer.offsets.end(), is);
}

inline bool one_place(const RaysAnswer& answer) {
  return all_offsets(answer, [&](PixelPoint p) {
    return std::abs(p.x - answer.offsets[0].x) < place_rounding &&
           std::abs(p.y - answer.offsets[0].y) < place_rounding;
  });
}

/// True if no ray leaves the film.
inline bool all_on_film(const RaysAnswer& answer) {
  return all_offsets(answer, [](PixelPoint p) {
    return p.x >= -0.5 - place_rounding && p.y <= 0.5 + place_rounding;
  });
}

}  // namespace lab09_pixels
