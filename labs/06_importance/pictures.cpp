#include "pictures.h"

#include "course/viewer/tiles.h"

#include <fmt/core.h>

namespace lab06 {

std::string graph_picture(std::string_view title, std::string_view note, const View& view,
                          const std::vector<Line>& lines, const std::vector<double>& marks) {
  const bool runs = view.scale == carlo::Scale::log;
  const carlo::Axis x{runs ? "N" : "x", carlo::Unit::count, view.scale};
  const carlo::Axis y{"", carlo::Unit::number, carlo::Scale::linear};
  const std::vector<double> ends{view.bottom, view.top};
  carlo::Stretch across{view.first, view.last};
  const std::vector<double> sides{view.first, view.last};
  if (view.scale == carlo::Scale::log) across = carlo::round_stretch(x, sides);
  carlo::Plot plot(x, across, y, carlo::round_stretch(y, ends), carlo::tile_size);
  std::vector<carlo::Key> keys;
  for (const Line& line : lines) {
    plot.line(line.style, line.points);
    keys.push_back({line.style, "━", line.name});
  }
  std::string ticks;
  for (const double mark : marks)
    ticks += fmt::format("M{:.1f} {:.1f}v-8", plot.x(mark), plot.y(ends[0]));
  plot.add(fmt::format("<path class=\"axis\" d=\"{}\"/>\n", ticks));
  return carlo::tile(title, note,
                     carlo::legend_html(keys) + plot.svg(fmt::format("{}: {}", title, note)));
}

}  // namespace lab06
