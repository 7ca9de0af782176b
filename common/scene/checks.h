#pragma once

#include "scene/xml_source.h"

namespace carlo {

// What may be asked of a property by itself, before it is used: its kind, what stands in it and in
// which range its value lies. Each throws Error at what is at fault.

/// Any value of a kind: is<number_value>.
template <auto value>
void is(const XmlElement& property) {
  (void)value(property);
}

/// A property that is refused whatever it is.
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

// One value only: others would change the image.
void only_true(const XmlElement& property);
void only_false(const XmlElement& property);
void only_zero(const XmlElement& property);
void no_pixels(const XmlElement& property);
void only_half(const XmlElement& property);
void only_one(const XmlElement& property);
void only_none(const XmlElement& property);

/// What stands inside a property and can be told apart: attributes that it does not have, those
/// that are no numbers, steps of a transform. Whether nothing is wrong.
bool check_parts(const XmlElement& property, SceneErrors& errors);

}  // namespace carlo
