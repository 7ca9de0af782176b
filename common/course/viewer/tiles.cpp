#include "course/viewer/tiles.h"

#include "course/report/chart.h"
#include "course/report/html.h"
#include "course/viewer/packed.h"

#include <fmt/core.h>

namespace carlo {

std::string tiles(const std::vector<std::string>& pictures, double narrowest) {
  if (narrowest == 0) narrowest = pictures.size() <= 4 ? 15 : pictures.size() == 5 ? 12.4 : 10.5;
  std::string html = fmt::format("<div class=\"tiles\" style=\"--tile: {}rem\">\n", narrowest);
  for (const std::string& picture : pictures)
    html += picture;
  return html + "</div>\n";
}

std::string tile(std::string_view title, std::string_view note, std::string_view drawing) {
  return fmt::format("<figure>\n{}{}</figure>\n", caption_html(title, note), drawing);
}

std::string tile(std::string_view title, std::string_view note, const Plot& plot) {
  return tile(title, note, plot.svg(fmt::format("{}: {}", title, note)));
}

std::string histogram_tile(std::string_view title, std::string_view note, Stretch across,
                           double top, std::span<const double> bars,
                           const std::function<double(double)>& density) {
  const Axis axis{"", Unit::number, Scale::linear};
  const std::vector<double> ends{0, top};
  Plot plot(axis, across, axis, round_stretch(axis, ends), tile_size);
  const double width = (across.last - across.first) / static_cast<double>(bars.size());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double from = across.first + width * static_cast<double>(i);
    plot.bar("c1", from, from + width, bars[i]);
  }
  plot.line("c2", graph(density, across));
  return tile(title, note, plot);
}

std::string image_tile(std::string_view title, std::string_view note, const Image& image,
                       double white) {
  return tile(title, note,
              fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\">\n", image.width,
                          image.height, html_escaped(title), picture_url(image, white)));
}

Image grey_image(std::span<const double> values, std::size_t width) {
  Image image(static_cast<int>(width), static_cast<int>(values.size() / width));
  for (std::size_t i = 0; i < values.size(); ++i)
    image.pixels[i] = Rgb(static_cast<float>(values[i]));
  return image;
}

}  // namespace carlo
