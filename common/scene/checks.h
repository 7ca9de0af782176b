#pragma once

#include "scene/xml_source.h"

namespace carlo {

// Checks of a single property before it is used: its kind, its contents and the range of its value.
// Each throws Error at what is wrong.

/// Accepts any value of a kind: is<number_value>.
template <auto value>
void is(const XmlElement& property) {
  (void)value(property);
}

/// Accepts a property that is refused whatever its value.
void anything(const XmlElement& property);

void above_zero(const XmlElement& property);
void zero_or_above(const XmlElement& property);
void an_angle(const XmlElement& property);
void a_count(const XmlElement& property);
void a_depth(const XmlElement& property);
void an_ior(const XmlElement& property);
void a_reflectance(const XmlElement& property);
void an_emission(const XmlElement& property);
void a_transform(const XmlElement& property);

// Accept only one value: others would change the image.
void only_true(const XmlElement& property);
void only_false(const XmlElement& property);
void only_zero(const XmlElement& property);
void no_pixels(const XmlElement& property);
void only_half(const XmlElement& property);
void only_one(const XmlElement& property);
void only_none(const XmlElement& property);

/// Checks the parts of a property that can be judged separately: unknown attributes, attributes
/// that are not numbers, steps of a transform. Returns true if nothing is wrong.
bool check_parts(const XmlElement& property, SceneErrors& errors);

}  // namespace carlo
