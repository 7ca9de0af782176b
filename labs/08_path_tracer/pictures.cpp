#include "pictures.h"

#include "report/page.h"
#include "report/picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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
      "<img width=\"{2}\" height=\"{3}\" alt=\"{0}\" src=\"{4}\">\n"
      "</figure>\n",
      carlo::html_escaped(title), carlo::html_escaped(note), image.width, image.height,
      carlo::picture_url(image, white));
}

}  // namespace lab08
