#pragma once

#include "image/image.h"

#include <array>
#include <optional>
#include <string>

namespace carlo {

/// The CIE 1931 chromaticities (x, y) of what an image's R, G, B and white are.
struct Primaries {
  std::array<double, 2> red, green, blue, white;
};

/// From such colours to those of Rec. 709 (white: D65), linearly; the white of the one becomes that
/// of the other by the Bradford transform. Nothing for Rec. 709 itself, as rounded to three digits.
/// Throws Error if they span no colours.
/// Source: ICC.1:2022, annex E (Bradford); SMPTE RP 177 (primaries to XYZ).
std::optional<glm::dmat3> to_rec709(const Primaries& primaries);

/// Takes each pixel through the matrix.
void convert(Image& image, const glm::dmat3& matrix);

/// "red (0.64, 0.33), green ..., white ...".
std::string text_of(const Primaries& primaries);

}  // namespace carlo
