#pragma once

#include "scene/similarity.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <variant>
#include <vector>

namespace carlo {

/// The parts of a signed distance function F: negative inside, positive outside. Each part, and so
/// every F made of them, has the Lipschitz bound 1, |F(p) - F(q)| <= |p - q|: |F| never exceeds the
/// distance to the surface. Source: Hart, "Sphere tracing: a geometric method for the antialiased
/// ray tracing of implicit surfaces", 1996.
namespace sdf {

/// About the origin. The exact distance.
struct Ball {
  double radius;
};

/// Swept by a circle of radius `minor` whose centre goes round the z axis at distance `major`;
/// minor < major. The exact distance.
struct Torus {
  double major, minor;
};

/// [-half, half] with edges and corners rounded to `radius`, which is at most the least of `half`.
/// The exact distance.
struct RoundedBox {
  glm::dvec3 half;
  double radius;
};

/// The points within `radius` of the segment from a to b. The exact distance.
struct Capsule {
  glm::dvec3 a, b;
  double radius;
};

/// A wall along Schoen's gyroid, g = sin x cos y + sin y cos z + sin z cos x = 0 with x, y, z in
/// units of period/(2 pi). It fills space. |grad g| <= sqrt 3 (by Cauchy and Schwarz the squares of
/// its components are at most cos^2 y + sin^2 z, cos^2 z + sin^2 x, cos^2 x + sin^2 y), so |g|
/// divided by sqrt 3 and by the unit is less than the distance, and the wall at least `thickness`
/// thick. thickness < period/4: from sqrt 2 on, the levels of g have points without a normal.
struct Gyroid {
  double period, thickness;
};

/// A form with its placement.
struct Solid {
  std::variant<Ball, Torus, RoundedBox, Capsule, Gyroid> form;
  Similarity place;
};

enum class Operation { unite, intersect, subtract };

/// Combines two distances a, b: min(a, b), max(a, b) or max(a, -b). With a smoothing k > 0, min(a,
/// b) becomes min(a, b) - max(k - |a - b|, 0)^2 / (4 k), and max(a, b) = -min(-a, -b) likewise. The
/// gradient is a weighted mean of those of a and b (or -b), which keeps the bound 1.
struct Combine {
  Operation operation;
  double smoothing = 0;
};

using Step = std::variant<Solid, Combine>;

/// The most intermediate results that may wait for their partner in a list of steps.
constexpr std::size_t most_waiting = 16;

}  // namespace sdf

/// The surface F = 0 of a signed distance function. `steps` is F in postfix order: a Solid pushes
/// its distance onto a stack, a Combine replaces the top two; one is left at the end.
struct Sdf {
  std::vector<sdf::Step> steps;
  Similarity place;      ///< maps F's coordinates to the world's
  bool flipped = false;  ///< the normal points along grad F, against it if `flipped`
};

namespace sdf {

/// F at a point of F's own coordinates.
double distance(const Sdf& sdf, glm::dvec3 p);

/// The gradient of F there, of length at most 1; on creases that of one side. 0 where F has none,
/// as in the centre of a ball.
glm::dvec3 gradient(const Sdf& sdf, glm::dvec3 p);

/// Empty if a coordinate of `lower` exceeds that of `upper`; may be infinite.
struct Box {
  glm::dvec3 lower, upper;
};

/// A box around all points with F <= 0, in the coordinates that `frame` maps F's to: sdf.place for
/// the world's.
Box bounds(const Sdf& sdf, const Similarity& frame);

}  // namespace sdf
}  // namespace carlo
