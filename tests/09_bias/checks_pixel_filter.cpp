// Checks of exercise 9.2: the filters and their inversion, by closed forms. checks_pixel_rays.cpp
// has those for pixels.

#include "09_bias/pixel_filter_theory.h"
#include "grader/judge/figures.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace lab09_pixels {

using namespace carlo::grader;

namespace {

const Unsaid unsaid_filters{"filter", "weighted"};

const Diagnosis not_cut_off{"filter-not-cut-off",
                            "the filter is not 0 beyond its radius in x or in y."};
const Diagnosis is_round{"filter-is-round",
                         "the filter is a function of the distance; it should be the product of "
                         "a curve in x and one in y, and fill the square."};
const Diagnosis not_symmetric{"filter-not-symmetric",
                              "the filter differs on both sides of the pixel's middle: it depends "
                              "on |x| and |y|."};
const Diagnosis peak_is_one{"filter-peak-is-1",
                            "the filter is 1 in the middle; what must be 1 is its integral."};
const Diagnosis one_direction{"filter-normalised-in-one-direction",
                              "the filter is divided by its curve's integral once: it is the "
                              "product of two curves, each of which must integrate to 1."};
const Diagnosis radius_is_width{"radius-taken-for-width",
                                "the filter reaches to both sides: it is two radii wide."};
const Diagnosis cut_not_made_up{"gaussian-cut-not-made-up-for",
                                "the truncated part of the Gaussian is missing: the rest must "
                                "integrate to 1."};
const Diagnosis not_normalised{"filter-not-normalised", "the filter does not integrate to 1."};
const Diagnosis half_missing{"gaussian-half-missing",
                             "the Gaussian is exp(-x^2 / (2 sigma^2)): a 2 is missing, or there is "
                             "one too many."};
const Diagnosis sigma_unsquared{"sigma-not-squared",
                                "the Gaussian is exp(-x^2 / (2 sigma^2)): sigma is not squared."};
const Diagnosis lowered{"gaussian-lowered",
                        "the Gaussian is lowered so that it ends at 0; the contract truncates it."};
const Diagnosis other_curve{"other-curve", "this is the curve of another filter."};

const Diagnosis one_number{"one-number-for-both-offsets",
                           "x and y of the offset come from one random number."};
const Diagnosis exchanged{"offset-coordinates-exchanged",
                          "x must grow with u.x, and y with u.y: they are exchanged."};
const Diagnosis offset_falls{"offset-falls", "the offset falls as u grows."};
const Diagnosis offset_from_corner{"offset-from-corner",
                                   "offsets start at 0; they are counted from the pixel's middle "
                                   "and reach to both sides."};
const Diagnosis uniform_offset{"offset-uniform",
                               "offsets are uniform: each filter is the density of its own."};
const Diagnosis one_side{"tent-inverted-on-one-side",
                         "the inverse of one half of the tent is used for all u: each side has "
                         "its own formula."};
const Diagnosis inside_out{"tent-inside-out",
                           "the tent is upside down: most offsets lie far from the middle."};
const Diagnosis jumps{"offset-not-growing",
                      "the density is right, but the offset does not grow with u: each half is "
                      "reversed."};
const Diagnosis cut_not_inverted{"gaussian-inverted-uncut",
                                 "the integral of the untruncated Gaussian is inverted: that of "
                                 "the truncated one is larger by 1 over the fraction kept."};
const Diagnosis root_missing{"gaussian-root-of-2-missing",
                             "erf(x) belongs to sigma = 1/sqrt(2): x counts in units of "
                             "sigma sqrt(2)."};
const Diagnosis coarse{"inverted-coarsely",
                       "the inversion is not exact: an approximation, or too few steps."};
const Diagnosis leaves_square{"offset-beyond-radius",
                              "the ends of [0, 1) give offsets beyond the radius, or NaN."};

// Values ------------------------------------------------------------------------------------------

using Shape2 = std::function<double(double x, double y)>;

Shape2 product(std::function<double(double)> curve) {
  return [curve = std::move(curve)](double x, double y) { return curve(x) * curve(y); };
}

/// One filter's values at drawn points.
struct FilterValues {
  FilterCase filter;
  std::vector<PixelPoint> points;  ///< in pixels
  std::vector<double> is, should;

  bool inside(std::size_t i) const {
    return std::max(std::abs(points[i].x), std::abs(points[i].y)) < filter.radius;
  }
  /// The number c for which all values inside are c times the shape; NaN if there is none.
  double factor(const Shape2& shape) const {
    const double c = is[0] / shape(points[0].x, points[0].y);
    for (std::size_t i = 0; i < is.size(); ++i) {
      const double expected = c * shape(points[i].x, points[i].y);
      if (inside(i) && !(std::abs(is[i] - expected) <= 1e-5 * std::abs(expected))) return NAN;
    }
    return c > 0 ? c : NAN;
  }
  bool has(const Shape2& shape) const { return !std::isnan(factor(shape)); }
};

bool near(double is, double should) {
  return std::abs(is - should) <= 1e-4 * std::abs(should);
}

/// The diagnosis if the shape is right but its height is not.
Diagnosis of_height(const FilterCase& filter, double height) {
  const double area = shape_area(filter), kept = kept_share(filter);
  if (filter.curve == gaussian_curve && near(height * area * area, kept * kept))
    return cut_not_made_up;
  // Where twice the area is 1 that means nothing.
  if (near(height * area, 1)) return one_direction;
  if (near(height, 1)) return peak_is_one;
  if (filter.curve == box_curve && near(height * area * area, 4)) return radius_is_width;
  return not_normalised;
}

std::vector<Diagnosis> of_values(const FilterValues& values) {
  const FilterCase& filter = values.filter;
  const double r = filter.radius, sigma = filter.sigma;
  const Shape2 shape = product([&](double x) { return curve_shape(filter, x); });
  if (const double height = values.factor(shape); !std::isnan(height)) {
    const double area = shape_area(filter);
    if (near(height * area * area, 1)) return {not_cut_off};
    return {of_height(filter, height)};
  }
  bool mirrored = true, round = true;
  for (std::size_t i = 0; i < values.is.size(); ++i) {
    if (i < 4 * mirrored_points)
      mirrored = mirrored && std::abs(values.is[i] - values.is[i - i % 4]) <=
                                 1e-5 * std::abs(values.is[i - i % 4]);
    else if (values.inside(i))
      round = round && values.is[i] == 0;
  }
  if (!mirrored) return {not_symmetric};
  if (round) return {is_round};
  if (filter.curve == gaussian_curve) {
    if (values.has(product([&](double x) { return bell(x, sigma / std::numbers::sqrt2); })) ||
        values.has(product([&](double x) { return bell(x, sigma * std::numbers::sqrt2); })))
      return {half_missing};
    if (values.has(product([&](double x) { return bell(x, std::sqrt(sigma)); })))
      return {sigma_unsquared};
    if (values.has(product([&](double x) { return bell(x, sigma) - bell(r, sigma); })))
      return {lowered};
  }
  for (const int curve : {box_curve, tent_curve, gaussian_curve}) {
    if (values.has(product([&](double x) { return curve_shape({curve, r, sigma}, x); })))
      return {other_curve};
  }
  return {};
}

void judge_values(std::size_t number) {
  FilterValues values;
  const std::size_t count = drawn_points(0).size();
  const Answer rows =
      probe("Lab 9.2 values", {.numbers = {{"filter", static_cast<double>(number)}}},
            {.rows = count, .columns = 1, .finite = false, .of = "a filter's values"});
  values.filter = drawn_filters(rows.seed).at(number);
  bool right = true;
  std::size_t worst = 0;
  for (const PixelPoint p : drawn_points(rows.seed)) {
    const std::size_t i = values.points.size();
    values.points.push_back({p.x * values.filter.radius, p.y * values.filter.radius});
    values.is.push_back(rows.values[i]);
    values.should.push_back(filter_density(values.filter, values.points[i].x, values.points[i].y));
    const bool same = std::abs(values.is[i] - values.should[i]) <= 1e-6 * values.should[i];
    if (right && !same) worst = i;
    right = right && same;
  }
  judge(holds(fmt::format("the value of {} at ({:.4g}, {:.4g})", name_of(values.filter),
                          values.points[worst].x, values.points[worst].y),
              right, number_in_report(values.is[worst]), number_in_report(values.should[worst]),
              right ? std::vector<Diagnosis>{} : of_values(values)));
}

// Offsets -----------------------------------------------------------------------------------------

/// A mistake in an offset.
struct OffsetSlip {
  Diagnosis diagnosis;
  std::function<PixelPoint(PixelPoint u)> offset;
};

OffsetSlip along_axes(const Diagnosis& diagnosis, std::function<double(double)> place) {
  return {diagnosis, [place = std::move(place)](PixelPoint u) {
            return PixelPoint{place(u.x), place(u.y)};
          }};
}

std::vector<OffsetSlip> tent_slips(double r) {
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  const auto mirrored = [](double u, const std::function<double(double)>& distance) {
    const double s = 2 * u - 1;
    return std::copysign(distance(std::abs(s)), s);
  };
  std::vector<OffsetSlip> slips;
  const std::vector<std::function<double(double)>> sides = {
      [=](double u) { return r * (1 - root(1 - u)); }, [=](double u) { return r * root(u); },
      [=](double u) { return r * (1 - root(u)); }, [=](double u) { return r * (root(2 * u) - 1); },
      [=](double u) { return r * (1 - root(2 - 2 * u)); }};
  for (const auto& side : sides)
    slips.push_back(along_axes(one_side, side));
  slips.push_back(along_axes(inside_out, [=](double u) {
    return mirrored(u, [=](double share) { return r * root(share); });
  }));
  slips.push_back(along_axes(jumps, [=](double u) {
    return mirrored(u, [=](double share) { return r * (1 - root(share)); });
  }));
  return slips;
}

std::vector<OffsetSlip> gaussian_slips(const FilterCase& filter) {
  const double r = filter.radius, kept = kept_share(filter);
  // Cut far beyond its radius, a Gaussian is practically untruncated.
  const FilterCase whole{gaussian_curve, 8 * filter.sigma, filter.sigma};
  const auto uncut = [=](double u) { return place_of(whole, u); };
  const auto clamped = [=](double u) { return std::clamp(place_of(whole, u), -r, r); };
  const auto scaled = [=](double factor) {
    return [=](double u) { return factor * place_of(filter, u); };
  };
  std::vector<OffsetSlip> slips = {along_axes(root_missing, scaled(1 / std::numbers::sqrt2)),
                                   along_axes(root_missing, scaled(std::numbers::sqrt2))};
  if (kept > 0.999) return slips;
  slips.push_back(along_axes(cut_not_inverted, uncut));
  slips.push_back(along_axes(cut_not_inverted, clamped));
  return slips;
}

std::vector<OffsetSlip> offset_slips(const FilterCase& filter) {
  const double r = filter.radius;
  const auto right = [=](double u) { return place_of(filter, u); };
  std::vector<OffsetSlip> slips = {
      {one_number,
       [=](PixelPoint u) {
         return PixelPoint{right(u.x), right(u.x)};
       }},
      {one_number,
       [=](PixelPoint u) {
         return PixelPoint{right(u.y), right(u.y)};
       }},
      {exchanged,
       [=](PixelPoint u) {
         return PixelPoint{right(u.y), right(u.x)};
       }},
      along_axes(offset_falls, [=](double u) { return -right(u); }),
      along_axes(offset_from_corner, [=](double u) { return r + right(u); }),
      along_axes(offset_from_corner, [=](double u) { return r * u; }),
      along_axes(radius_is_width, [=](double u) { return right(u) / 2; }),
      along_axes(uniform_offset, [=](double u) { return r * (2 * u - 1); }),
      along_axes(uniform_offset, [=](double u) { return u - 0.5; })};
  for (const auto& more :
       {filter.curve == tent_curve ? tent_slips(r) : std::vector<OffsetSlip>{},
        filter.curve == gaussian_curve ? gaussian_slips(filter) : std::vector<OffsetSlip>{}})
    slips.insert(slips.end(), more.begin(), more.end());
  return slips;
}

/// The largest distance along one axis; NaN if a coordinate is NaN.
double apart(PixelPoint a, PixelPoint b) {
  const double x = std::abs(a.x - b.x), y = std::abs(a.y - b.y);
  return std::isnan(x + y) ? NAN : std::max(x, y);
}

struct OffsetAnswer {
  FilterCase filter;
  std::vector<PixelPoint> pairs, is;

  /// True if an answer that fits another law is far from the right one: for a Gaussian that is
  /// nearly a box, the uniform law says nothing.
  bool tells_apart(const std::function<PixelPoint(PixelPoint)>& right,
                   const std::function<PixelPoint(PixelPoint)>& other) const {
    return std::any_of(pairs.begin(), pairs.end(), [&](PixelPoint u) {
      return apart(right(u), other(u)) > 3e-4 * filter.radius;
    });
  }

  bool all(const std::function<PixelPoint(PixelPoint)>& offset, double tolerance,
           std::size_t without_last = end_pairs) const {
    for (std::size_t i = 0; i + without_last < is.size(); ++i) {
      if (!(apart(is[i], offset(pairs[i])) <= tolerance * filter.radius)) return false;
    }
    return true;
  }
};

/// True if the untruncated Gaussian was inverted, even where that shows only at the ends of [0, 1).
/// There it may be cut at the radius, or infinite.
bool is_uncut(const OffsetAnswer& answer) {
  const FilterCase& filter = answer.filter;
  const FilterCase whole{gaussian_curve, 8 * filter.sigma, filter.sigma};
  const auto ended = [&](double x) { return std::clamp(x, -filter.radius, filter.radius); };
  bool uncut = true;
  for (std::size_t i = 0; i < answer.is.size(); ++i) {
    const PixelPoint is = answer.is[i], u = answer.pairs[i];
    uncut = uncut && apart({ended(is.x), ended(is.y)},
                           {ended(place_of(whole, u.x)), ended(place_of(whole, u.y))}) <=
                         1e-4 * filter.radius;
  }
  return uncut;
}

std::vector<Diagnosis> of_offsets(const OffsetAnswer& answer,
                                  const std::function<PixelPoint(PixelPoint)>& right) {
  const double r = answer.filter.radius;
  if (answer.all(right, 1e-5)) {
    if (answer.filter.curve == gaussian_curve && is_uncut(answer)) return {cut_not_inverted};
    for (const PixelPoint p : answer.is) {
      if (!(apart(p, {0, 0}) <= (1 + 1e-6) * r)) return {leaves_square};
    }
    return {coarse};
  }
  for (const OffsetSlip& slip : offset_slips(answer.filter)) {
    if (answer.all(slip.offset, 1e-4) && answer.tells_apart(right, slip.offset))
      return {slip.diagnosis};
  }
  return answer.all(right, 0.02) ? std::vector{coarse} : std::vector<Diagnosis>{};
}

std::string text(PixelPoint p) {
  return fmt::format("({:.7g}, {:.7g})", p.x, p.y);
}

void judge_offsets(std::size_t number) {
  const std::size_t count = drawn_pairs(0).size();
  const Answer rows =
      probe("Lab 9.2 offsets", {.numbers = {{"filter", static_cast<double>(number)}}},
            {.rows = count, .columns = 2, .finite = false, .of = "offsets by a filter"});
  OffsetAnswer answer{drawn_filters(rows.seed).at(number), drawn_pairs(rows.seed), {}};
  const auto right = [&](PixelPoint u) {
    return PixelPoint{place_of(answer.filter, u.x), place_of(answer.filter, u.y)};
  };
  std::size_t wrong = count;
  for (std::size_t i = 0; i < count; ++i) {
    answer.is.push_back({rows.at(i, 0), rows.at(i, 1)});
    const double off = apart(answer.is[i], right(answer.pairs[i]));
    if (wrong == count && !(off <= 1e-5 * answer.filter.radius)) wrong = i;
  }
  const std::size_t shown = wrong == count ? 0 : wrong;
  judge(holds(
      fmt::format("the offset by {} for u = {}", name_of(answer.filter), text(answer.pairs[shown])),
      wrong == count, text(answer.is[shown]), text(right(answer.pairs[shown])),
      wrong == count ? std::vector<Diagnosis>{} : of_offsets(answer, right)));
}

}  // namespace

TEST_CASE("Lab 9.2: filters are even and 0 beyond their radius", "[lab09][ex2]") {
  for (std::size_t number = 0; number < drawn_filters(0).size(); ++number)
    judge_values(number);
}

TEST_CASE("Lab 9.2: filters integrate to 1", "[lab09][ex2]") {
  constexpr std::int64_t side = 48;
  for (std::size_t number = 0; number < plain_filters; ++number) {
    const Answer rows =
        probe("Lab 9.2 grid", {.n = side, .numbers = {{"filter", static_cast<double>(number)}}},
              {.rows = side * side, .columns = 1, .of = "a filter on a grid"});
    const FilterCase filter = drawn_filters(rows.seed).at(number);
    const double cell = 3 * filter.radius / static_cast<double>(side);
    double sum = 0;
    for (const double value : rows.values)
      sum += value * cell * cell;
    judge(equals("the integral of " + name_of(filter), sum, 1, 0.005));
  }
}

TEST_CASE("Lab 9.2: offsets by inversion", "[lab09][ex2]") {
  for (std::size_t number = 0; number < plain_filters + 1; ++number)
    judge_offsets(number);
}

TEST_CASE("Lab 9.2: offsets by Gaussians that are cut off late, or hardly differ from a box",
          "[lab09][ex2]") {
  for (std::size_t number = plain_filters + 1; number < drawn_filters(0).size(); ++number)
    judge_offsets(number);
}

}  // namespace lab09_pixels
