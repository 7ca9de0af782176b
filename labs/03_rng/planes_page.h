#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lab03 {

/// A cloud of points in the unit cube for the page, and the direction across its planes.
struct Cloud {
  std::string name, note;
  std::vector<std::array<double, 3>> points;
  std::array<double, 3> normal{};  ///< of the planes, any length; all 0 where there are none
};

/// The picture's HTML: a canvas that can be turned by mouse, touch and arrow keys, and its buttons.
std::string planes_html(const std::vector<Cloud>& clouds);

/// The script that draws it.
std::string planes_script(const std::vector<Cloud>& clouds);

}  // namespace lab03
