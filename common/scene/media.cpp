#include "scene/media.h"

#include <array>
#include <utility>

namespace carlo {
namespace {

// Refractive indices at 589 nm (Bass et al., "Handbook of Optics"; the values of Mitsuba 0.6).
constexpr std::array<std::pair<std::string_view, float>, 9> indices = {{
    {"vacuum", 1.0f},
    {"air", 1.000277f},
    {"water", 1.333f},
    {"water ice", 1.31f},
    {"fused quartz", 1.458f},
    {"pyrex", 1.47f},
    {"acrylic glass", 1.49f},
    {"bk7", 1.5046f},
    {"diamond", 2.419f},
}};

}  // namespace

std::optional<float> medium_ior(std::string_view name) {
  for (const auto& [medium, ior] : indices) {
    if (medium == name) return ior;
  }
  return {};
}

std::vector<std::string> media() {
  std::vector<std::string> out;
  for (const auto& [medium, ior] : indices)
    out.emplace_back(medium);
  return out;
}

}  // namespace carlo
