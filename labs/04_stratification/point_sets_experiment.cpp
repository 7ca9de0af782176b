#include "course/viewer/tiles.h"
#include "experiments.h"
#include "pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>

// Pictures of the point sets.

namespace lab04 {
namespace {

constexpr std::int64_t shown = 64, lines = 8;

/// The numbers of cells of a grid, and of columns of a finer one, that hold no point.
struct Gaps {
  std::int64_t cells = 0, columns = 0;
};

Gaps gaps(const std::vector<Point>& points) {
  std::vector<bool> cells(lines * lines), columns(shown);
  const auto stratum = [](double x, std::int64_t n) {
    return std::min(static_cast<std::int64_t>(x * static_cast<double>(n)), n - 1);
  };
  for (const Point& p : points) {
    cells[static_cast<std::size_t>(stratum(p.y, lines) * lines + stratum(p.x, lines))] = true;
    columns[static_cast<std::size_t>(stratum(p.x, shown))] = true;
  }
  return {std::count(cells.begin(), cells.end(), false),
          std::count(columns.begin(), columns.end(), false)};
}

}  // namespace

void point_sets_experiment(Notebook& notebook) {
  notebook.begin("Five ways to place 64 points");
  std::vector<std::string> pictures;
  carlo::Table table({"points", "empty cells of 8 × 8", "empty columns of 64", "time a point"},
                     {"points", "empty_cells", "empty_columns", "seconds"});
  for (const PointSet& set : all_point_sets()) {
    carlo::Rng rng = notebook.rng();
    notebook.attempt([&] {
      const std::vector<Point> points = set.make(shown, rng);
      const Measurement timed =
          carlo::time_rule(4096, 0, [&] { return set.make(4096, rng).front().x; });
      const Gaps empty = gaps(points);
      table.add_row(
          {set.name, empty.cells, empty.columns, carlo::seconds_cell(timed.seconds / 4096)});
      pictures.push_back(point_picture(
          set.name, fmt::format("empty: {} cells, {} columns", empty.cells, empty.columns), points,
          lines));
    });
  }
  notebook.say(
      "Each point alone is uniform in all five; they differ in how the points depend on one another. "
      "The grid has 8 × 8 cells; the marks below and to the left show where the points fall along "
      "each axis.");
  notebook.raw_html(carlo::tiles(pictures, 12.25));
  notebook.table("point_sets", table, "Strata without a point, of 64 points");
}

}  // namespace lab04
