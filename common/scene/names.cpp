#include "scene/names.h"

#include <algorithm>

namespace carlo {

std::string mitsuba06_name(std::string_view name) {
  const auto found = std::find_if(property_names.begin(), property_names.end(),
                                  [&](const Name& n) { return n.mitsuba3 == name; });
  return std::string(found == property_names.end() ? name : found->mitsuba06);
}

std::string name_in(Dialect dialect, std::string_view name) {
  const auto found = std::find_if(property_names.begin(), property_names.end(),
                                  [&](const Name& n) { return n.mitsuba06 == name; });
  const bool renamed = dialect == Dialect::mitsuba3 && found != property_names.end();
  return std::string(renamed ? found->mitsuba3 : name);
}

std::optional<Dialect> dialect_of(std::string_view version) {
  for (const std::string_view start : {"0.5.", "0.6."}) {
    if (version.starts_with(start)) return Dialect::mitsuba06;
  }
  for (const std::string_view start : {"2.", "3."}) {
    if (version.starts_with(start)) return Dialect::mitsuba3;
  }
  return {};
}

}  // namespace carlo
