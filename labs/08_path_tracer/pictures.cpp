#include "pictures.h"

#include "report/page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lab08 {
namespace {

constexpr std::string_view style = R"(<style>
.tiles { display: grid; gap: 1.2rem; margin: 1.5rem 0;
         grid-template-columns: repeat(auto-fill, minmax(min(100%, var(--tile)), 1fr)); }
.tiles img { display: block; width: 100%; height: auto; margin: auto 0 0;
             image-rendering: pixelated; border-radius: 4px; }
.tiles figcaption { margin-bottom: 0.6rem; }
@media (max-width: 34rem) {
  .tiles { grid-template-columns: repeat(auto-fill, minmax(min(100%, 8.5rem), 1fr)); gap: 0.7rem; }
  .tiles figure { padding: 0.7rem; }
}
</style>
)";

void put(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i)
    bytes += static_cast<char>(value >> (8 * i) & 255);
}

std::uint32_t shown(float linear, double white) {
  // The sRGB curve, nearly.
  const double x = std::clamp(static_cast<double>(linear) / white, 0.0, 1.0);
  return static_cast<std::uint32_t>(std::lround(255 * std::pow(x, 1 / 2.2)));
}

/// An image file that needs no compressor: a 24-bit BMP, stored from the bottom row up.
std::string bitmap(const carlo::Image& image, double white) {
  const auto width = static_cast<std::uint32_t>(image.width);
  const auto height = static_cast<std::uint32_t>(image.height);
  const std::uint32_t stride = (3 * width + 3) / 4 * 4, size = stride * height;
  constexpr std::uint32_t header = 14 + 40;
  std::string bytes = "BM";
  put(bytes, header + size, 4);
  put(bytes, 0, 4);
  put(bytes, header, 4);
  put(bytes, 40, 4);
  put(bytes, width, 4);
  put(bytes, height, 4);
  put(bytes, 1, 2);   // plane
  put(bytes, 24, 2);  // bits a pixel
  put(bytes, 0, 4);   // not compressed
  put(bytes, size, 4);
  for (int i = 0; i < 4; ++i)  // size on paper, both ways; no palette
    put(bytes, 0, 4);
  for (int y = image.height; y-- > 0;) {
    for (int x = 0; x < image.width; ++x) {
      const carlo::Rgb& c = image.at(x, y);
      for (const float channel : {c.b, c.g, c.r})
        put(bytes, shown(channel, white), 1);
    }
    bytes.append(stride - 3 * width, '\0');
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

std::string tiles(const std::vector<std::string>& pictures) {
  std::string html = fmt::format("{}<div class=\"tiles\" style=\"--tile: {}rem\">\n", style,
                                 pictures.size() <= 4   ? 15.0
                                 : pictures.size() == 5 ? 12.4
                                                        : 10.5);
  for (const std::string& picture : pictures)
    html += picture;
  return html + "</div>\n";
}

std::string image_picture(std::string_view title, std::string_view note, const carlo::Image& image,
                          double white) {
  return fmt::format(
      "<figure>\n<figcaption>{0}<span>{1}</span></figcaption>\n"
      "<img width=\"{2}\" height=\"{3}\" alt=\"{0}\" src=\"data:image/bmp;base64,{4}\">\n"
      "</figure>\n",
      carlo::html_escaped(title), carlo::html_escaped(note), image.width, image.height,
      base64(bitmap(image, white)));
}

}  // namespace lab08
