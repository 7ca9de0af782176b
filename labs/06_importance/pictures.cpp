#include "pictures.h"

#include "report/format.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lab06 {
namespace {

constexpr std::string_view style = R"(<style>
.tiles { display: grid; gap: 1.5rem; margin: 1.5rem 0;
         grid-template-columns: repeat(auto-fit, minmax(min(100%, var(--tile)), 1fr)); }
.tiles svg { display: block; width: 100%; height: auto; margin: auto 0 0; }
.tiles .axis, .family .axis { stroke: var(--soft); stroke-width: 1.5; fill: none; }
.tiles .marks, .family .marks { stroke: var(--soft); stroke-width: 1.5; fill: none; }
.tiles text, .family text { fill: var(--soft); font-size: 15px; }
.tiles .line, .family .line { fill: none; stroke-width: 3; stroke-linejoin: round; }
.tiles .key { margin: 0.5rem 0; font-size: 0.85rem; font-weight: 400; }
.tiles .key b { display: inline-block; width: 1.2em; height: 0.2em; margin: 0 0.4em 0.25em 0; }
.tiles .key span { display: inline-block; margin-right: 1rem; color: var(--soft); }
</style>
)";

constexpr double width = 440, height = 230;

/// Places of a view in the drawing, y upwards.
struct Frame {
  View view;
  double x(double value) const { return width * (value - view.first) / (view.last - view.first); }
  double y(double value) const { return height * (view.top - value) / (view.top - view.bottom); }
  bool shows(double value) const {
    const double down = y(value) / height;
    return down >= -0.04 && down <= 1.02;
  }
};

std::string path(const Frame& frame, const Line& line) {
  std::string d;
  bool pen_down = false;
  for (const carlo::Point& p : line.points) {
    if (frame.shows(p.y))
      d += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', frame.x(p.x), frame.y(p.y));
    pen_down = frame.shows(p.y);
  }
  return fmt::format("<path class=\"line\" style=\"stroke: var(--series-{})\" d=\"{}\"/>\n",
                     line.colour, d);
}

/// The y axis begins at 0 where nothing else is said.
std::string bottom_text(const View& view) {
  if (view.bottom == 0) return "";
  return fmt::format("<text x=\"6\" y=\"{:.0f}\">{}</text>", height - 7,
                     carlo::number_text(view.bottom, 3));
}

/// The text at an end of the x axis.
std::string end_text(const std::string& given, double value) {
  return given.empty() ? carlo::number_text(value, 3) : carlo::html_escaped(given);
}

}  // namespace

std::string tiles(const std::vector<std::string>& pictures, int narrowest) {
  std::string html = std::string(style) +
                     fmt::format("<div class=\"tiles\" style=\"--tile: {}rem\">\n", narrowest);
  for (const std::string& picture : pictures)
    html += picture;
  return html + "</div>\n";
}

Line line(std::string name, int colour, const View& view, const std::function<double(double)>& f) {
  constexpr int steps = 220;
  Line result{std::move(name), colour, {}};
  for (int i = 0; i < steps; ++i) {
    const double x = view.first + (view.last - view.first) * (i + 0.5) / steps;
    result.points.push_back({x, f(x)});
  }
  return result;
}

std::string graph_picture(std::string_view title, std::string_view note, const View& view,
                          const std::vector<Line>& lines, const std::vector<double>& marks) {
  const Frame frame{view};
  std::string drawing, key, ticks;
  for (const Line& l : lines) {
    drawing += path(frame, l);
    key += fmt::format("<span><b style=\"background: var(--series-{})\"></b>{}</span>", l.colour,
                       carlo::html_escaped(l.name));
  }
  for (const double mark : marks)
    ticks += fmt::format("M{:.1f} {:.0f}v12", frame.x(mark), height);
  return fmt::format(
      "<figure>\n<figcaption>{0}<span>{1}</span></figcaption>\n<p class=\"key\">{2}</p>\n"
      "<svg viewBox=\"-4 -24 448 284\" role=\"img\" aria-label=\"{0}: {1}\">\n{3}"
      "<path class=\"marks\" d=\"{4}\"/>\n<path class=\"axis\" d=\"M0 0V{5:.0f}H{6:.0f}\"/>\n"
      "<text y=\"{7:.0f}\">{8}</text><text x=\"{6:.0f}\" y=\"{7:.0f}\" text-anchor=\"end\">{9}"
      "</text><text y=\"-6\">{10}</text>{11}\n</svg>\n</figure>\n",
      carlo::html_escaped(title), carlo::html_escaped(note), key, drawing, ticks, height, width,
      height + 27, end_text(view.first_text, view.first), end_text(view.last_text, view.last),
      carlo::number_text(view.top, 3), bottom_text(view));
}

}  // namespace lab06
