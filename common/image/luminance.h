#pragma once

#include <array>

namespace carlo {

/// Relative luminance of linear sRGB (ITU-R BT.709).
inline double luminance(const std::array<double, 3>& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

}  // namespace carlo
