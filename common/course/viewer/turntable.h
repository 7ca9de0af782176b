#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Places joined by straight lines; coordinates as those of the points below.
using Polyline = std::vector<std::array<double, 3>>;

/// A cloud of points in the unit cube, y upwards.
struct Cloud {
  std::string name, note;
  std::vector<std::array<double, 3>> points;
  std::array<double, 3> normal{};    ///< a normal to look across, any length; 0 if there is none
  std::vector<Polyline> lines = {};  ///< drawn with this cloud only, in another colour
};

/// A picture of clouds in space that the reader can turn, by mouse, touch and arrow keys, one cloud
/// at a time. At most one per page.
struct Turntable {
  std::string caption;          ///< "Points of a cube"
  std::string label;            ///< description for readers who cannot see it
  std::string along;            ///< label of the button that looks across a cloud's normal
  std::vector<Polyline> wires;  ///< the lines in which the clouds float
  std::vector<Cloud> clouds;
};

/// Returns HTML and script for Page::raw_html() and Page::script().
std::string turntable_html(const Turntable& picture);
std::string_view turntable_script();

}  // namespace carlo
