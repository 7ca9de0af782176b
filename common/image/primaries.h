#pragma once

#include "image/image.h"

#include <array>
#include <optional>
#include <string>

namespace carlo {

/// The CIE 1931 chromaticities (x, y) of an image's R, G, B and white.
struct Primaries {
  std::array<double, 2> red, green, blue, white;
};

/// The treatment of a white other than Rec. 709's, D65. OpenEXR's colours are X, Y, Z, whatever the
/// primaries: its project's versions of one picture in several primaries should look alike. In a
/// Radiance picture R = G = B is meant to be grey.
enum class White { kept, adapted };

/// The linear map from such colours to Rec. 709; an adapted white becomes D65 by the Bradford
/// transform. Nothing for Rec. 709 itself, as rounded to three digits. Throws Error if they span no
/// colours. Source: ICC.1:2022, annex E (Bradford); SMPTE RP 177 (primaries to XYZ).
std::optional<glm::dmat3> to_rec709(const Primaries& primaries, White white);

/// Applies the matrix to each pixel.
void convert(Image& image, const glm::dmat3& matrix);

/// "red (0.64, 0.33), green ..., white ...".
std::string text_of(const Primaries& primaries);

}  // namespace carlo
