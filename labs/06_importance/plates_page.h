#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lab06 {

/// An image of grey values in [0, 1], row by row, for the page.
struct Grey {
  std::string title, note;
  std::size_t width = 0, height = 0;
  std::vector<double> values;
};

/// Canvases side by side, and the script that paints them.
std::string images_html(const std::vector<Grey>& images, std::string_view id);
std::string images_script(const std::vector<Grey>& images, std::string_view id);

}  // namespace lab06
