#pragma once

#include "numeric/vec.h"
#include "scene/camera.h"
#include "scene/sdf.h"
#include "scene/xml_source.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace carlo {

// The value of a property (<float name="radius" value="2"/>). Each function throws Error at the
// element if its kind is wrong, otherwise at the value.

float number_value(const XmlElement& property);
int integer_value(const XmlElement& property);
bool boolean_value(const XmlElement& property);
const std::string& text_value(const XmlElement& property);
/// x, y and z, or value="x, y, z".
glm::dvec3 point_value(const XmlElement& property);

/// <rgb> with three linear numbers or one, <srgb> with such numbers encoded by sRGB's curve or as
/// #rrggbb, or one number as <spectrum> or <float>.
Rgb colour_value(const XmlElement& property);

/// The same for emission: there a <spectrum> of one number is white in Mitsuba 0.6, and light of
/// equal energy at each wavelength in Mitsuba 3.
Rgb emission_value(const XmlElement& property);
/// True in the latter case.
bool is_equal_energy(const XmlElement& property);

/// A <float>, or a <string> with the name of a medium.
float ior_value(const XmlElement& property);

FovAxis fov_axis_value(const XmlElement& property);
sdf::Operation operation_value(const XmlElement& property);

// The values of attributes. Each function throws Error at the value.

double number_of(const XmlAttribute& attribute);
/// "x, y, z" or "x y z".
glm::dvec3 triple_of(const XmlAttribute& attribute);
/// The attribute's value for a message, with its source text if that contained $parameters.
std::string found(const XmlAttribute& attribute);

/// Throws Error "NAME ..." at the value of a property, or at the property if it has none.
template <class... Args>
[[noreturn]] void wrong(const XmlElement& property, fmt::format_string<Args...> format,
                        Args&&... args) {
  const XmlAttribute* value = property.find("value");
  fail(value != nullptr ? value->value_at : property.at, "{} {}", property.get("name").written,
       fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace carlo
