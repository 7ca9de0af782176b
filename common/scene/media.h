#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// The refractive index of a medium by its name in Mitsuba; nothing for unknown names.
std::optional<float> medium_ior(std::string_view name);

/// The names of all media.
std::vector<std::string> media();

}  // namespace carlo
