#include "grader/judge/figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace carlo::grader {
namespace {

double number(std::size_t n) {
  return static_cast<double>(n);
}

struct Range {
  double first, last;

  double width() const { return last - first; }
  bool contains(double x) const { return x >= first && x <= last; }
};

/// Returns the range of the finite values except a part `tail` at either end, and of `also`, with a
/// margin.
Range central_range(std::span<const double> values, const std::vector<double>& also,
                    double tail = 0.005) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double x) { return std::isfinite(x); });
  std::vector<double> ends;
  if (!sorted.empty()) {
    const auto skipped = static_cast<std::ptrdiff_t>(tail * number(sorted.size()));
    std::nth_element(sorted.begin(), sorted.begin() + skipped, sorted.end());
    ends.push_back(sorted[static_cast<std::size_t>(skipped)]);
    std::nth_element(sorted.begin(), sorted.end() - 1 - skipped, sorted.end());
    ends.push_back(*(sorted.end() - 1 - skipped));
  }
  for (const double x : also) {
    if (std::isfinite(x)) ends.push_back(x);
  }
  if (ends.empty()) return {0, 1};
  const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
  const double air = 0.02 * (*high - *low);
  if (air > 0 && std::isfinite(air)) return {*low - air, *high + air};
  const double around = *low == 0 ? 1 : 0.1 * std::abs(*low);
  return {*low - around, *low + around};
}

/// Returns the range of all finite values, unless a few are so far out that the others would look
/// flat.
Range whole_range(std::span<const double> values) {
  const Range central = central_range(values, {}, 0.05);
  double first = HUGE_VAL, last = -HUGE_VAL;
  for (const double x : values) {
    if (!std::isfinite(x)) continue;
    first = std::min(first, x);
    last = std::max(last, x);
  }
  const double air = 0.3 * central.width();
  if (!(last - first <= 4 * central.width())) return {central.first - air, central.last + air};
  return {std::min(first, central.first), std::max(last, central.last)};
}

/// Makes a histogram of the values in `range`; the note says how many are elsewhere.
Figure histogram(const std::string& title, std::span<const double> values, Range range,
                 std::vector<Mark> marks) {
  constexpr std::size_t bins = 40;
  HistogramFigure h{"value", range.first, range.last, std::vector<double>(bins), {}, {}, {}};
  std::size_t elsewhere = 0, broken = 0;
  for (const double x : values) {
    if (!std::isfinite(x)) {
      ++broken;
    } else if (!range.contains(x)) {
      ++elsewhere;
    } else {
      const double place = (x - range.first) / range.width() * number(bins);
      h.measured[std::min(static_cast<std::size_t>(place), bins - 1)] += 1;
    }
  }
  h.marks = std::move(marks);
  std::string note;
  if (elsewhere > 0) note = fmt::format("{} values lie outside of the picture. ", elsewhere);
  if (broken > 0) note += fmt::format("{} values are infinite or NaN.", broken);
  return {title, note, h};
}

bool few_values(std::span<const double> values) {
  std::set<double> seen;
  for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 2000); ++i) {
    if (std::isnan(values[i])) return true;
    if (seen.insert(values[i]).second && seen.size() > 12) return false;
  }
  return true;
}

double average_of(std::span<const double> values) {
  long double sum = 0;
  for (const double x : values)
    sum += x;
  return static_cast<double>(sum / static_cast<long double>(values.size()));
}

/// Plots the mean of the first n values. Omits the earliest means, whose error bars dwarf the rest.
Figure running_mean(std::span<const double> values, double mean, double sd) {
  PointsFigure p{"number of values", "mean so far", true, false, {}};
  const double off = std::abs(average_of(values) - mean);
  const double from = std::isfinite(off) && off > 0 ? std::pow(sd / off, 2) : 1;
  const double total = number(values.size());
  double next = std::clamp(from, 1.0, std::max(1.0, total / 32));
  long double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += values[i];
    if (number(i + 1) < next && i + 1 < values.size()) continue;
    next = number(i + 1) * std::pow(2, 0.5);
    const auto so_far = static_cast<double>(sum / static_cast<long double>(i + 1));
    p.points.push_back({number(i + 1), so_far, 3 * sd / std::sqrt(number(i + 1)), mean});
  }
  if (p.points.size() > most_points) {
    p.points.erase(p.points.begin(), p.points.end() - std::ptrdiff_t{most_points});
  }
  return {"The mean of the first n values", "Bars: three standard errors to either side.", p};
}

/// Formats with as many digits as distinguish the two, but no more than a double has.
std::string digits(double value, double other) {
  const bool close = std::abs(value - other) <= 1e-4 * std::abs(other);
  return close && value != other ? fmt::format("{:.16g}", value) : fmt::format("{:.6g}", value);
}

/// Returns "3.142 (pi)" for the factors that formulas lose most often.
std::string factor_text(double ratio) {
  constexpr double pi = 3.14159265358979;
  constexpr std::array names{std::pair{pi, " (pi)"}, std::pair{1 / pi, " (1/pi)"},
                             std::pair{2 * pi, " (2 pi)"}, std::pair{0.5 / pi, " (1/(2 pi))"},
                             std::pair{4 * pi, " (4 pi)"}};
  std::string text = fmt::format("{:.5g}", ratio);
  for (const auto& [value, name] : names) {
    if (std::abs(ratio / value - 1) < 1e-3) text += name;
  }
  return text;
}

struct Differences {
  std::size_t count = 0;
  double ratio = 0;  ///< the common ratio of all that differ; NaN if there is none
};

Differences differences(std::span<const double> measured, std::span<const double> expected,
                        const std::function<bool(std::size_t)>& wrong) {
  Differences d;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!wrong(i)) continue;
    const double ratio = measured[i] / expected[i];
    if (d.count++ == 0) d.ratio = ratio;
    if (!(std::abs(ratio - d.ratio) <= 1e-3 * std::abs(d.ratio))) d.ratio = std::nan("");
  }
  return d;
}

std::string differences_note(const Differences& d, std::size_t all) {
  std::string note = fmt::format("{} of {} differ.", d.count, all);
  if (d.count > 1 && std::isfinite(d.ratio) && d.ratio != 0 && std::abs(d.ratio - 1) > 1e-6) {
    note = fmt::format("{} of {} differ, and each is {} times what is expected.", d.count, all,
                       factor_text(d.ratio));
  }
  return note;
}

/// Returns `values` with `group` neighbours summed.
std::vector<double> added_up(std::span<const double> values, std::size_t group) {
  std::vector<double> sums((values.size() + group - 1) / group);
  for (std::size_t i = 0; i < values.size(); ++i)
    sums[i / group] += values[i];
  return sums;
}

std::size_t group_for(std::size_t size, std::size_t most) {
  return (size + most - 1) / most;
}

}  // namespace

Figure mean_figure(std::span<const double> values, double mean, double sd) {
  const double measured = average_of(values);
  const Range range = central_range(values, {mean, measured});
  const bool seen = std::abs(measured - mean) > 0.03 * range.width();
  if (!seen || few_values(values)) return running_mean(values, mean, sd);
  return histogram("The values and their mean", values, range,
                   {{measured, "measured mean", Mark::Role::measured},
                    {mean, "expected mean", Mark::Role::expected}});
}

Figure spread_figure(std::span<const double> values, double mean, double sd) {
  double squares = 0;
  for (const double x : values)
    squares += (x - mean) * (x - mean) / number(values.size());
  const double own = std::sqrt(squares);
  Range range = central_range(values, {mean - sd, mean + sd});
  // A spread inflated by outliers lies where there are almost no values: the picture ends before
  // it.
  std::vector<Mark> marks{{mean - sd, "expected spread", Mark::Role::expected},
                          {mean + sd, "", Mark::Role::expected}};
  if (range.contains(mean - own) && range.contains(mean + own)) {
    marks.push_back({mean - own, "measured spread", Mark::Role::measured});
    marks.push_back({mean + own, "", Mark::Role::measured});
  }
  Figure figure = histogram("How far the values spread", values, range, marks);
  figure.note = "Lines: one standard deviation to either side of the expected mean. " + figure.note;
  return figure;
}

Figure uniform_figure(std::span<const double> sorted, double lower, double upper) {
  constexpr std::size_t steps = 64;
  const double width = upper - lower;
  // A single wild value counts as outside, however far it is.
  const Range range{std::clamp(sorted.front(), lower - width, lower),
                    std::clamp(sorted.back(), upper, upper + width)};
  PointsFigure p{"x", "share of the values up to x", false, true, {}};
  for (std::size_t i = 0; i <= steps; ++i) {
    const double x = range.first + range.width() * number(i) / steps;
    const auto up_to = std::upper_bound(sorted.begin(), sorted.end(), x) - sorted.begin();
    p.points.push_back({x, static_cast<double>(up_to) / number(sorted.size()), 0,
                        std::clamp((x - lower) / width, 0.0, 1.0)});
  }
  return {"Distribution function", "A right answer follows the line.", p};
}

Figure counts_figure(const CellAxis& axis, std::span<const double> counts,
                     std::span<const double> expected) {
  const std::size_t group = group_for(counts.size(), most_bins);
  HistogramFigure h;
  h.x_label = axis.label;
  const bool numbered = !(axis.first < axis.last);
  h.first = numbered ? 0.5 : axis.first;
  h.last = numbered ? number(counts.size()) + 0.5 : axis.last;
  h.measured = added_up(counts, group);
  h.expected = added_up(expected, group);
  // The last bin is as wide as the others, even if it holds fewer cells.
  h.last +=
      (h.last - h.first) * (number(h.measured.size()) * number(group) / number(counts.size()) - 1);
  for (const double e : h.expected)
    h.band.push_back(3 * std::sqrt(std::max(0.0, e)));
  std::string note = "Band: three standard deviations around what is expected.";
  if (group > 1) note += fmt::format(" Each bar: {} cells.", group);
  return {"Samples in each cell", note, h};
}

Figure cells_figure(const std::string& column_label, const std::string& row_label,
                    std::size_t columns, std::span<const double> counts,
                    std::span<const double> expected) {
  const std::size_t rows = counts.size() / columns;
  const std::size_t across = group_for(columns, most_cells_a_side);
  const std::size_t down = group_for(rows, most_cells_a_side);
  GridFigure g{column_label, row_label, (columns + across - 1) / across, {}, {}, {}};
  const std::size_t cells = g.columns * ((rows + down - 1) / down);
  g.measured.resize(cells);
  g.expected.resize(cells);
  for (std::size_t i = 0; i < rows * columns; ++i) {
    const std::size_t cell = i / columns / down * g.columns + i % columns / across;
    g.measured[cell] += counts[i];
    g.expected[cell] += expected[i];
  }
  for (const double e : g.expected)
    g.sd.push_back(std::sqrt(std::max(1.0, e)));
  return {"Samples in each cell", "Colour: how many standard deviations a cell is off.", g};
}

Figure tiles_figure(std::size_t columns, std::span<const double> measured,
                    std::span<const double> expected, std::span<const double> sd) {
  const std::size_t rows = std::min(measured.size() / columns, most_cells_a_side);
  const std::size_t kept = std::min(columns, most_cells_a_side);
  GridFigure g{"x", "y, from the top", kept, {}, {}, {}};
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < kept; ++column) {
      const std::size_t i = row * columns + column;
      g.measured.push_back(measured[i]);
      g.expected.push_back(expected[i]);
      g.sd.push_back(sd[i]);
    }
  }
  return {"The image in tiles", "Colour: how many standard deviations a tile is off.", g};
}

Figure differences_listing(const std::string& place_title, const PlaceName& place,
                           std::span<const double> measured, std::span<const double> expected,
                           const std::function<bool(std::size_t)>& wrong) {
  ListingFigure listing{{place_title, "measured", "expected", "ratio"}, {}};
  for (std::size_t i = 0; i < measured.size() && listing.rows.size() < most_rows; ++i) {
    if (!wrong(i)) continue;
    if (!listing.rows.empty() && listing.rows.back().front() == place(i)) continue;
    const double ratio = measured[i] / expected[i];
    listing.rows.push_back({place(i), digits(measured[i], expected[i]),
                            digits(expected[i], measured[i]),
                            std::isfinite(ratio) ? fmt::format("{:.5g}", ratio) : "–"});
  }
  const Differences d = differences(measured, expected, wrong);
  const std::string title =
      d.count > listing.rows.size() ? "The first that differ" : "What differs";
  return {title, differences_note(d, measured.size()), listing};
}

Figure curve_figure(const std::string& x_label, std::span<const double> at,
                    std::span<const double> measured, std::span<const double> expected,
                    const std::function<bool(std::size_t)>& wrong) {
  const Range right = whole_range(expected), theirs = whole_range(measured);
  // Values far outside everything correct would flatten the curve.
  const double far = 3 * right.width();
  const Range shown{std::min(right.first, std::max(theirs.first, right.first - far)),
                    std::max(right.last, std::min(theirs.last, right.last + far))};
  PointsFigure p{x_label, "value", false, false, {}};
  std::size_t visible = 0, lost = 0;
  const std::size_t stride = group_for(at.size(), most_points);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const bool in_view = shown.contains(measured[i]);
    if (wrong(i)) {
      if (!in_view) ++lost;
      if (in_view && std::abs(measured[i] - expected[i]) > 0.02 * shown.width()) ++visible;
    }
    if (i % stride != 0 || !shown.contains(expected[i])) continue;
    p.points.push_back({at[i], in_view ? measured[i] : std::nan(""), 0, expected[i]});
  }
  if (visible < 3) {
    return differences_listing(
        x_label, [&](std::size_t i) { return fmt::format("{}", at[i]); }, measured, expected,
        wrong);
  }
  std::sort(p.points.begin(), p.points.end(),
            [](const PointsFigure::Point& a, const PointsFigure::Point& b) { return a.x < b.x; });
  std::string note = differences_note(differences(measured, expected, wrong), measured.size());
  if (lost > 0)
    note += fmt::format(" {} of them lie outside of the picture or are no numbers.", lost);
  return {"Measured and expected values", note, p};
}

}  // namespace carlo::grader
