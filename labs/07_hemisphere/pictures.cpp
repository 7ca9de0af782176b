#include "pictures.h"

#include "report/format.h"
#include "report/page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

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

void put(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i)
    bytes += static_cast<char>(value >> (8 * i) & 255);
}

/// An image file that needs no compressor: an 8-bit grey BMP, stored from the bottom row up.
std::string bitmap(std::span<const double> image, int width, double white) {
  const auto columns = static_cast<std::size_t>(width);
  const std::size_t rows = image.size() / columns, stride = (columns + 3) / 4 * 4;
  constexpr std::uint32_t header = 14 + 40 + 4 * 256;
  const auto size = static_cast<std::uint32_t>(stride * rows);
  std::string bytes = "BM";
  put(bytes, header + size, 4);
  put(bytes, 0, 4);
  put(bytes, header, 4);
  put(bytes, 40, 4);
  put(bytes, static_cast<std::uint32_t>(columns), 4);
  put(bytes, static_cast<std::uint32_t>(rows), 4);
  put(bytes, 1, 2);  // plane
  put(bytes, 8, 2);  // bits a pixel
  put(bytes, 0, 4);  // not compressed
  put(bytes, size, 4);
  put(bytes, 0, 4);  // size on paper, both ways
  put(bytes, 0, 4);
  put(bytes, 256, 4);
  put(bytes, 0, 4);
  for (std::uint32_t grey = 0; grey < 256; ++grey)
    put(bytes, grey * 0x010101, 4);
  for (std::size_t row = rows; row-- > 0;) {
    for (std::size_t column = 0; column < stride; ++column) {
      const double linear = column < columns ? image[row * columns + column] / white : 0;
      // The sRGB curve, nearly.
      const double shown = 255 * std::pow(std::clamp(linear, 0.0, 1.0), 1 / 2.2);
      put(bytes, static_cast<std::uint32_t>(std::lround(shown)), 1);
    }
  }
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group <<= 8;
      if (i + k < bytes.size()) group |= static_cast<unsigned char>(bytes[i + k]);
    }
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
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
  return figure(
      title, note,
      fmt::format("<img width=\"{0}\" height=\"{0}\" alt=\"{1}\" "
                  "src=\"data:image/bmp;base64,{2}\">\n",
                  width, carlo::html_escaped(title), base64(bitmap(image, width, white))));
}

}  // namespace lab07
