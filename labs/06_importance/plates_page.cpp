#include "plates_page.h"

#include "report/page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lab06 {
namespace {

/// Two hexadecimal digits a pixel.
std::string hex(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    const double v = std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 1.0;
    text += fmt::format("{:02x}", static_cast<int>(std::lround(255 * v)));
  }
  return text;
}

}  // namespace

std::string images_html(const std::vector<Grey>& images, std::string_view id) {
  std::string html = R"(<style>
.images { display: grid; gap: 1.5rem; margin: 1.5rem 0;
          grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); }
.images canvas { display: block; width: 100%; height: auto; margin-top: 0.7rem;
                 image-rendering: pixelated; background: #000; border-radius: 4px; }
</style>
<div class="images">
)";
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Grey& image = images[i];
    html += fmt::format(
        "<figure><figcaption>{0}<span>{1}</span></figcaption><canvas id=\"{2}-{3}\" width=\"{4}\" "
        "height=\"{5}\" role=\"img\" aria-label=\"{0}: {1}\"></canvas></figure>\n",
        carlo::html_escaped(image.title), carlo::html_escaped(image.note), id, i, image.width,
        image.height);
  }
  return html + "</div>\n";
}

std::string images_script(const std::vector<Grey>& images, std::string_view id) {
  std::string code = R"js((() => {
const paint = (name, width, height, hex) => {
  const context = document.getElementById(name).getContext('2d');
  const image = context.createImageData(width, height);
  for (let i = 0; i < width * height; ++i) {
    const grey = parseInt(hex.substr(2 * i, 2), 16);
    image.data.set([grey, grey, grey, 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
};
)js";
  for (std::size_t i = 0; i < images.size(); ++i) {
    code += fmt::format("paint('{}-{}', {}, {}, '{}');\n", id, i, images[i].width, images[i].height,
                        hex(images[i].values));
  }
  return code + "})();";
}

}  // namespace lab06
