#include "pictures.h"

#include "report/format.h"
#include "report/page.h"
#include "report/picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lab07 {
namespace {

constexpr std::string_view style = R"(<style>
.tiles { display: grid; gap: 1.2rem; margin: 1.5rem 0;
         grid-template-columns: repeat(auto-fit, minmax(min(100%, var(--tile)), 1fr)); }
.tiles svg, .tiles img { display: block; width: 100%; height: auto; margin: auto 0 0; }
.tiles img { image-rendering: pixelated; border-radius: 4px; }
.tiles figcaption { margin-bottom: 0.6rem; }
.tiles .axis { stroke: var(--soft); stroke-width: 1.5; fill: none; }
.tiles text { fill: var(--soft); font-size: 15px; }
.tiles .bars { fill: var(--series-1); fill-opacity: 0.35; stroke: var(--series-1); }
.tiles .line { fill: none; stroke: var(--series-2); stroke-width: 3; stroke-linejoin: round; }
@media (max-width: 34rem) {
  .tiles { grid-template-columns: repeat(auto-fit, minmax(min(100%, 8.5rem), 1fr)); gap: 0.7rem; }
  .tiles.wide { grid-template-columns: 1fr; }
  .tiles figure { padding: 0.7rem; }
}
</style>
)";

std::string figure(std::string_view title, std::string_view note, const std::string& drawing) {
  return fmt::format("<figure>\n<figcaption>{}<span>{}</span></figcaption>\n{}</figure>\n",
                     carlo::html_escaped(title), carlo::html_escaped(note), drawing);
}

}  // namespace

std::string tiles(const std::vector<std::string>& pictures, int width) {
  std::string html = fmt::format("{}<div class=\"tiles{}\" style=\"--tile: {}rem\">\n", style,
                                 width > 14 ? " wide" : "", width);
  for (const std::string& picture : pictures)
    html += picture;
  return html + "</div>\n";
}

std::string histogram_picture(std::string_view title, std::string_view note, double first,
                              double last, std::span<const double> bars,
                              const std::function<double(double)>& pdf) {
  constexpr double plot_width = 440, plot_height = 220;
  constexpr int steps = 220;
  std::vector<double> line;
  for (int i = 0; i < steps; ++i)
    line.push_back(pdf(first + (last - first) * (i + 0.5) / steps));
  const double top = 1.08 * std::max(*std::max_element(bars.begin(), bars.end()),
                                     *std::max_element(line.begin(), line.end()));
  const auto y = [&](double value) { return plot_height * (1 - value / top); };
  const double width = plot_width / static_cast<double>(bars.size());
  std::string bar_path, line_path;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    bar_path += fmt::format("M{:.1f} 220V{:.1f}h{:.2f}V220", static_cast<double>(i) * width,
                            y(bars[i]), width);
  }
  for (int i = 0; i < steps; ++i) {
    const double value = line[static_cast<std::size_t>(i)];
    if (!std::isfinite(value)) continue;
    line_path += fmt::format("{}{:.1f} {:.1f}", line_path.empty() ? 'M' : 'L',
                             plot_width * (i + 0.5) / steps, y(value));
  }
  return figure(
      title, note,
      fmt::format("<svg viewBox=\"-4 -24 448 268\" role=\"img\" aria-label=\"Histogram of {}\">\n"
                  "<path class=\"bars\" d=\"{}\"/>\n<path class=\"line\" d=\"{}\"/>\n"
                  "<path class=\"axis\" d=\"M0 0V220H440\"/>\n<text y=\"240\">{}</text>"
                  "<text x=\"440\" y=\"240\" text-anchor=\"end\">{}</text><text "
                  "y=\"-6\">{}</text>\n</svg>\n",
                  carlo::html_escaped(title), bar_path, line_path, carlo::number_text(first, 3),
                  carlo::number_text(last, 3), carlo::number_text(top, 3)));
}

std::string image_picture(std::string_view title, std::string_view note,
                          std::span<const double> image, int width, double white) {
  const int height = static_cast<int>(image.size()) / width;
  carlo::Image grey(width, height);
  for (std::size_t i = 0; i < image.size(); ++i)
    grey.pixels[i] = carlo::Rgb(static_cast<float>(image[i]));
  return figure(title, note,
                fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\">\n", width,
                            height, carlo::html_escaped(title), carlo::picture_url(grey, white)));
}

}  // namespace lab07
