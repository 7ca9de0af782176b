#include "renderer/lanes/guide.h"

#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace renderer {
namespace {

constexpr std::size_t bins = std::size_t{Guide::rows} * Guide::columns;
constexpr std::uint32_t places = Guide::grid * Guide::grid * Guide::grid * Guide::sides;
constexpr std::uint32_t none = ~std::uint32_t{0};

/// What is known of a bin counts as this many visits with what is known of the same bin in the
/// cell of twice the size.
constexpr double prior_visits = 12;
/// A place with fewer visits takes the table of the cell of twice the size, from which its own
/// would hardly differ.
constexpr double least_visits = 200;

/// Sums over the visits of a place, by the strips and rectangles of an even table: whole numbers,
/// since lanes note visits in an order that depends on how many there are.
struct Histogram {
  std::array<std::uint64_t, bins> squares{};
  std::array<std::uint32_t, bins> visits{};
};
using Densities = std::array<double, bins>;  ///< relative

double visits_of(const Histogram& of) {
  double visits = 0;
  for (const std::uint32_t some : of.visits)
    visits += some;
  return visits;
}

/// Mean squares in each bin; bins with few visits follow `above`, the densities of the cell of
/// twice the size.
Densities mean_squares(const Histogram& of, const Densities& above) {
  double squares = 0, visits = 0, whole = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    squares += static_cast<double>(of.squares[b]), visits += of.visits[b];
    whole += above[b];
  }
  Densities found{};
  if (!(squares > 0 && whole > 0)) return above;
  const double scale = squares / visits * bins / whole;
  for (std::size_t b = 0; b < bins; ++b) {
    found[b] = (static_cast<double>(of.squares[b]) + prior_visits * scale * above[b]) /
               (of.visits[b] + prior_visits);
  }
  return found;
}

/// The ends of `count` intervals of equal mass, in units of 1/256, for a piecewise constant density
/// with these masses above 0, of pieces of equal length.
template <std::size_t count>
std::array<std::uint32_t, count + 1> equal_parts(const std::array<double, count>& masses) {
  double whole = 0;
  for (const double mass : masses)
    whole += mass;
  std::array<std::uint32_t, count + 1> ends{};
  std::size_t piece = 0;
  double below = 0;
  for (std::size_t i = 1; i < count; ++i) {
    const double part = whole * static_cast<double>(i) / count;
    while (piece + 1 < count && below + masses[piece] < part)
      below += masses[piece++];
    const double at = static_cast<double>(piece) + std::min((part - below) / masses[piece], 1.0);
    ends[i] = static_cast<std::uint32_t>(std::lround(at * 256 / count));
    ends[i] = std::clamp(ends[i], ends[i - 1] + 1, static_cast<std::uint32_t>(256 - count + i));
  }
  ends[count] = 256;
  return ends;
}

/// Appends the table for these densities.
void add_table(const Densities& densities, std::vector<std::uint32_t>& tables) {
  double whole = 0;
  for (const double density : densities)
    whole += density;
  Densities mass{};
  std::array<double, Guide::rows> strips{};
  for (std::size_t b = 0; b < bins; ++b) {
    const double learnt = whole > 0 ? densities[b] / whole : 1.0 / bins;
    mass[b] = Guide::even_share / bins + (1 - Guide::even_share) * learnt;
    strips[b / Guide::columns] += mass[b];
  }
  const auto x = equal_parts(strips);
  constexpr std::uint32_t per_strip = 256 / Guide::rows;
  for (std::size_t i = 0; i < Guide::rows; ++i) {
    std::array<double, Guide::columns> inside{};
    for (std::uint32_t strip = 0; strip < Guide::rows; ++strip) {
      const std::uint32_t from = std::max(strip * per_strip, x[i]),
                          to = std::min((strip + 1) * per_strip, x[i + 1]);
      for (std::size_t j = 0; from < to && j < Guide::columns; ++j)
        inside[j] += (to - from) * mass[strip * Guide::columns + j];
    }
    const auto y = equal_parts(inside);
    for (std::size_t j = 0; j < Guide::columns; ++j) {
      tables.push_back(x[i] << 24 | (x[i + 1] - x[i]) << 16 | y[j] << 8 | (y[j + 1] - y[j]));
    }
  }
}

std::uint32_t cell_along(float p, float lower, float cells_per_unit) {
  const float at = (p - lower) * cells_per_unit;
  if (!(at > 0)) return 0;
  return static_cast<std::uint32_t>(std::min(at, Guide::grid - 0.5f));
}

/// The grid's extent along an axis: all but the outermost hundredth of the visits to either side.
void cover(const Visits& visits, std::size_t axis, Guide& guide) {
  std::vector<float> all;
  const auto step = static_cast<std::uint32_t>(visits.size() / 4096 + 1);
  for (const Visit& visit : visits)
    if (visit.path % step == 0) all.push_back(visit.p[axis]);
  if (all.empty()) return;
  const auto at = [&](std::size_t rank) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rank), all.end());
    return all[rank];
  };
  const float lower = at(all.size() / 100), upper = at(all.size() - 1 - all.size() / 100);
  guide.lower[axis] = lower;
  // Visits of one plane stay in one cell, whatever their rounding.
  const bool flat = !(upper - lower > 1e-5f * std::max(std::abs(lower), std::abs(upper)));
  guide.cells_per_unit[axis] = flat ? 0 : static_cast<float>(Guide::grid) / (upper - lower);
}

/// The cell of twice the size that holds a place of a grid.
std::uint32_t around(std::uint32_t place, std::uint32_t grid) {
  const std::uint32_t side = place % Guide::sides, cell = place / Guide::sides;
  const std::uint32_t z = cell % grid / 2, y = cell / grid % grid / 2, x = cell / (grid * grid) / 2;
  return ((x * (grid / 2) + y) * (grid / 2) + z) * Guide::sides + side;
}

/// The square of what the path found after a visit.
double square_ahead(const Visit& visit, std::span<const float> radiances) {
  const float* const rgb = radiances.data() + std::size_t{3} * visit.path;
  const double all = carlo::luminance({rgb[0], rgb[1], rgb[2]});
  const double ahead = all - static_cast<double>(visit.gathered);
  if (!(ahead > 1e-6 * all)) return 0;  // less is rounding
  const double found = ahead / static_cast<double>(visit.throughput);
  return found * found;
}

/// A unit for sums of squares: about 2^-20 of a typical one, so that sums have room for 2^20 times
/// as much from each of 2^20 visits.
double unit_for(const Visits& visits, std::span<const float> radiances) {
  std::int64_t exponents = 0, count = 0;
  for (const Visit& visit : visits) {
    const double square = square_ahead(visit, radiances);
    if (!(square > 0 && square < 1e60)) continue;
    exponents += std::ilogb(square), ++count;
  }
  return std::ldexp(1.0, static_cast<int>(count > 0 ? exponents / count : 0) - 20);
}

}  // namespace

Guide::Guide() : table_of(places, 0) {
  add_table(Densities{}, tables);
}

std::uint32_t Guide::place(const std::array<float, 3>& p, std::uint32_t side) const {
  std::uint32_t cell = 0;
  for (std::size_t k = 0; k < 3; ++k)
    cell = cell * grid + cell_along(p[k], lower[k], cells_per_unit[k]);
  return cell * sides + side;
}

/// The visited places of a grid.
struct GuideLearner::Histograms {
  explicit Histograms(std::uint32_t cells)
      : grid(cells), number(std::size_t{cells} * cells * cells * Guide::sides, none) {}

  Histogram& at(std::uint32_t place) {
    if (number[place] == none) {
      number[place] = static_cast<std::uint32_t>(all.size());
      all.emplace_back();
    }
    return all[number[place]];
  }

  Histograms coarser() const {
    Histograms sums(grid / 2);
    for (std::uint32_t place = 0; place < number.size(); ++place) {
      if (number[place] == none) continue;
      Histogram& to = sums.at(around(place, grid));
      const Histogram& from = all[number[place]];
      for (std::size_t b = 0; b < bins; ++b)
        to.squares[b] += from.squares[b], to.visits[b] += from.visits[b];
    }
    return sums;
  }

  /// What is known of each visited place, by its number, whose table is added to the guide's.
  struct Known {
    Densities mean_squares;
    std::uint32_t table;  ///< its first word
  };
  std::vector<Known> learn(Guide& guide) const {
    std::vector<Known> found(all.size());
    std::optional<Histograms> sums;
    std::vector<Known> above;
    if (grid > 1) sums = coarser(), above = sums->learn(guide);
    Known even{{}, 0};
    even.mean_squares.fill(1);
    for (std::uint32_t place = 0; place < number.size(); ++place) {
      if (number[place] == none) continue;
      const Known& wider = sums ? above[sums->number[around(place, grid)]] : even;
      const Histogram& here = all[number[place]];
      Known& known = found[number[place]];
      known = wider;
      if (visits_of(here) < least_visits) continue;
      known.mean_squares = mean_squares(here, wider.mean_squares);
      known.table = static_cast<std::uint32_t>(guide.tables.size());
      Densities roots = known.mean_squares;
      for (double& density : roots)
        density = std::sqrt(density);
      add_table(roots, guide.tables);
    }
    return found;
  }

  std::uint32_t grid;
  std::vector<std::uint32_t> number;  ///< of each place among `all`, or `none`
  std::vector<Histogram> all;
};

GuideLearner::GuideLearner() = default;
GuideLearner::~GuideLearner() = default;

void GuideLearner::add(const Visits& visits, std::span<const float> radiances) {
  if (visits.empty()) return;
  if (!finest_) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      cover(visits, axis, grid_);
    finest_ = std::make_unique<Histograms>(Guide::grid);
    per_unit_ = 1 / unit_for(visits, radiances);
  }
  for (const Visit& visit : visits) {
    const double square = square_ahead(visit, radiances) * per_unit_;
    const auto strip = static_cast<std::size_t>(visit.u[0] * static_cast<float>(Guide::rows));
    const auto part = static_cast<std::size_t>(visit.u[1] * static_cast<float>(Guide::columns));
    Histogram& here = finest_->at(grid_.place(visit.p, visit.side));
    const std::size_t bin = strip * Guide::columns + part;
    here.squares[bin] += static_cast<std::uint64_t>(square < 0x1p40 ? square : 0x1p40);
    ++here.visits[bin];
  }
}

Guide GuideLearner::learn() const {
  Guide guide = grid_;
  if (!finest_) return guide;
  const std::vector<Histograms::Known> known = finest_->learn(guide);
  for (std::size_t place = 0; place < finest_->number.size(); ++place) {
    if (finest_->number[place] != none) guide.table_of[place] = known[finest_->number[place]].table;
  }
  return guide;
}

}  // namespace renderer
