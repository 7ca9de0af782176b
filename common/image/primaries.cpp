#include "image/primaries.h"

#include "support/error.h"

#include <fmt/format.h>

#include <cmath>

namespace carlo {
namespace {

using Xy = std::array<double, 2>;

constexpr Primaries rec709{{.64, .33}, {.3, .6}, {.15, .06}, {.3127, .329}};

/// Three numbers in the ratio of a colour's X, Y, Z.
glm::dvec3 direction(const Xy& xy) {
  return {xy[0], xy[1], 1 - xy[0] - xy[1]};
}

/// The X, Y, Z of a white with Y = 1.
glm::dvec3 white_of(const Primaries& p) {
  return direction(p.white) / p.white[1];
}

glm::dmat3 xyz_from(const Primaries& p) {
  const glm::dmat3 directions(direction(p.red), direction(p.green), direction(p.blue));
  const glm::dvec3 lengths = glm::inverse(directions) * white_of(p);
  return {directions[0] * lengths[0], directions[1] * lengths[1], directions[2] * lengths[2]};
}

/// Maps one white to another, both in XYZ.
glm::dmat3 bradford(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dmat3 cones = glm::transpose(
      glm::dmat3(.8951, .2664, -.1614, -.7502, 1.7135, .0367, .0389, -.0685, 1.0296));
  const glm::dvec3 gain = (cones * to) / (cones * from);
  return glm::inverse(cones) * glm::dmat3(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z) * cones;
}

bool near(const Xy& a, const Xy& b) {
  constexpr double rounding = 6e-4;
  return std::abs(a[0] - b[0]) < rounding && std::abs(a[1] - b[1]) < rounding;
}

bool is_finite(const glm::dmat3& m) {
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      // Larger numbers come from primaries that nearly coincide.
      if (!(std::abs(m[c][r]) < 1e3)) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<glm::dmat3> to_rec709(const Primaries& p, White white) {
  if (near(p.red, rec709.red) && near(p.green, rec709.green) && near(p.blue, rec709.blue) &&
      near(p.white, rec709.white))
    return std::nullopt;
  const glm::dmat3 adaptation =
      white == White::adapted ? bradford(white_of(p), white_of(rec709)) : glm::dmat3(1);
  const glm::dmat3 matrix = glm::inverse(xyz_from(rec709)) * adaptation * xyz_from(p);
  if (!is_finite(matrix)) throw Error("its primaries span no colours: {}", text_of(p));
  return matrix;
}

void convert(Image& image, const glm::dmat3& matrix) {
  for (Rgb& pixel : image.pixels)
    pixel = Rgb(matrix * glm::dvec3(pixel));
}

std::string text_of(const Primaries& p) {
  const auto text = [](const Xy& xy) { return fmt::format("({:.4g}, {:.4g})", xy[0], xy[1]); };
  return fmt::format("red {}, green {}, blue {}, white {}", text(p.red), text(p.green),
                     text(p.blue), text(p.white));
}

}  // namespace carlo
