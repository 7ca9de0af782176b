#pragma once

#include <fmt/core.h>

#include <string>

namespace lab01_tests {

/// "1 dimension", "2 dimensions".
inline std::string dimensions(int d) {
  return fmt::format("{} {}", d, d == 1 ? "dimension" : "dimensions");
}

}  // namespace lab01_tests
