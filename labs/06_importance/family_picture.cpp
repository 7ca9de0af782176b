#include "course/report/chart.h"
#include "course/viewer/tiles.h"
#include "pictures.h"

#include <fmt/core.h>

#include <cmath>

// The page's slider along the family of densities (n + 1) x^n.

namespace lab06 {
namespace {

constexpr double k = 4;  ///< f = (k + 1) x^k

/// The power function with integral 1.
auto power(double n) {
  return [n](double x) { return (n + 1) * std::pow(x, n); };
}

std::string words(double n) {
  const double variance = (k + 1) * (k + 1) / ((n + 1) * (2 * k - n + 1)) - 1;
  return fmt::format("n = {:.2f}: variance of one sample {}{}", n,
                     n < 2 * k + 1 ? fmt::format("{:.4f}", variance) : "infinite",
                     n > k ? fmt::format(", tail index {:.2f}", (n + 1) / (n - k)) : "");
}

/// p, f/p and the points of 60 evenly spread u, in a drawing of their own with the axes of `axes`.
std::string layer(const carlo::Plot& axes, double n) {
  carlo::Plot plot = axes;
  plot.line("c2", carlo::graph(power(n), {0, 1}));
  plot.line("c3", carlo::graph([n](double x) { return power(k)(x) / power(n)(x); }, {0, 1}));
  std::string strokes;
  for (int i = 0; i < 60; ++i)
    strokes +=
        fmt::format("M{:.1f} {:.1f}v-8", plot.x(std::pow((i + 0.5) / 60, 1 / (n + 1))), plot.y(0));
  return plot.body() + fmt::format("<path class=\"axis\" d=\"{}\"/>", strokes);
}

}  // namespace

std::string family_slider() {
  const carlo::Axis x{"x", carlo::Unit::number, carlo::Scale::linear};
  const carlo::Axis y{"", carlo::Unit::number, carlo::Scale::linear};
  const carlo::Plot axes(x, {0, 1}, y, {0, 6}, {400, 250});
  carlo::Plot plot = axes;
  plot.line("c1", carlo::graph(power(k), {0, 1}));
  std::vector<std::string> said;
  for (std::size_t i = 0; i <= 32; ++i) {
    const double n = 0.5 * static_cast<double>(i);
    said.push_back(words(n));
    plot.add(carlo::shown_at(i, i, layer(axes, n)));
  }
  const std::vector<carlo::Key> keys{{"c1", "━", "f"}, {"c2", "━", "p"}, {"c3", "━", "f/p"}};
  const std::string figure = carlo::tile(
      "Move p towards f, and past it",
      "f = 5x⁴ is fixed; p is (n + 1)xⁿ. The strokes on the axis are where 60 evenly spread u "
      "land. Watch f/p at the left end.",
      carlo::slider_html("n of p", said, 4,
                         carlo::legend_html(keys) + plot.svg("f, p and f/p for the chosen n")));
  return "<div class=\"charts\">" + figure + "</div>\n";
}

}  // namespace lab06
