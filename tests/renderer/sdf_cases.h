#pragma once

// Signed distance functions and rays that are hard for root finders.

#include "lane_records.h"
#include "numeric/robust.h"
#include "random/rng.h"
#include "scene/sdf.h"
#include "sdf_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sdf_cases {

using namespace carlo::sdf;
using carlo::Rng, carlo::Sdf, carlo::Similarity, carlo::Vec3;
using Vec3d = glm::dvec3;
using sdf_places::random_direction, sdf_places::turned;

/// 10 to a power in [low, high), of random sign.
inline double of_any_size(Rng& rng, double low, double high) {
  const double size = std::pow(10, low + (high - low) * rng.uniform());
  return rng.uniform() < 0.5 ? -size : size;
}

struct Case {
  std::string name;
  Sdf sdf;
  /// Balls around the parts that rays should aim at, and some of the outside.
  struct Aim {
    Vec3d center;
    double radius;
  };
  std::vector<Aim> aims{{Vec3d(0), 1.2}};
};

/// The same solid in coordinates in which it is `factor` times as large; its placement undoes that.
inline Sdf grown(Sdf shape, double factor) {
  for (Step& step : shape.steps) {
    if (auto* solid = std::get_if<Solid>(&step)) {
      solid->place.scale *= factor;
      solid->place.origin *= factor;
    } else {
      std::get<Combine>(step).smoothing *= factor;
    }
  }
  shape.place.scale /= factor;
  return shape;
}

inline std::vector<Case> forms() {
  const Similarity aside = turned(0.7, {0.2, -0.1, 0.3}, 0.8);
  const auto one = [](std::string name, decltype(Solid::form) form, const Similarity& place) {
    return Case{std::move(name), {{Solid{form, place}}, {}, false}};
  };
  return {one("ball", Ball{0.8}, {}),
          one("torus", Torus{0.7, 0.2}, aside),
          one("thin torus", Torus{0.9, 0.002}, turned(1.3)),
          one("fat torus", Torus{0.5, 0.49}, {}),
          one("rounded box", RoundedBox{{0.5, 0.7, 0.4}, 0.1}, turned(0.3)),
          one("sharp box", RoundedBox{{0.5, 0.75, 0.375}, 0}, {}),
          one("turned sharp box", RoundedBox{{0.5, 0.7, 0.4}, 0}, aside),
          one("sheet", RoundedBox{{0.8, 0.7, 1e-4}, 0}, turned(0.2)),
          one("box that is a ball", RoundedBox{{0.5, 0.5, 0.5}, 0.5}, {}),
          one("capsule", Capsule{{-0.3, 0, 0.1}, {0.5, 0.6, 0}, 0.3}, aside),
          one("needle", Capsule{{-0.7, 0.1, 0}, {0.8, 0.3, 0.2}, 1e-3}, {}),
          one("small within", Ball{1}, turned(0.4, {300, 200, -100}, 0.01)),
          {"mirrored torus",
           {{Solid{Torus{0.7, 0.2}, {-turned(0.7).rotation, {0.1, 0, 0}, 0.9}}}, {}, true}}};
}

inline std::vector<Case> combinations() {
  const Similarity aside = turned(0.7, {0.2, -0.1, 0.3}, 0.8);
  const Solid ball{Ball{0.8}, {}}, torus{Torus{0.7, 0.2}, aside},
      box{RoundedBox{{0.5, 0.7, 0.4}, 0.1}, turned(0.3)},
      cube{RoundedBox{{0.625, 0.625, 0.625}, 0}, {}},
      capsule{Capsule{{-0.3, 0, 0.1}, {0.5, 0.6, 0}, 0.3}, aside}, gyroid{Gyroid{0.6, 0.06}, aside},
      thin{Gyroid{0.5, 1e-3}, turned(0.5)}, thinnest{Gyroid{0.2, 2e-5}, {}},
      tiny{Ball{1e-3}, {glm::dmat3(1), {0.805, 0, 0}, 1}},
      left{Ball{0.3}, turned(0, {-0.35, 0, 0})}, right{Ball{0.3}, turned(0, {0.35, 0, 0})};
  const auto made = [](std::string name, std::vector<Step> steps) {
    return Case{std::move(name), {std::move(steps), {}, false}};
  };
  const auto unite = [](double k = 0) { return Combine{Operation::unite, k}; };
  const auto intersect = [](double k = 0) { return Combine{Operation::intersect, k}; };
  const auto subtract = [](double k = 0) { return Combine{Operation::subtract, k}; };
  std::vector<Case> cases{
      made("union", {ball, torus, unite()}),
      made("smooth union", {ball, torus, unite(0.3), capsule, unite(0.2)}),
      made("barely smooth union", {ball, torus, unite(1e-4)}),
      made("smoother than its parts", {left, right, unite(3)}),
      made("smoother intersection than its parts", {ball, box, intersect(2)}),
      made("intersection", {ball, box, intersect()}),
      made("smooth intersection", {ball, cube, intersect(0.2)}),
      made("difference", {ball, capsule, subtract()}),
      made("smooth difference", {box, capsule, subtract(0.1)}),
      made("corner cut", {cube, Solid{cube.form, turned(0, {0.5, 0.5, 0.5})}, subtract()}),
      made("shell", {ball, Solid{Ball{0.7999}, {}}, subtract()}),
      made("lens", {Solid{Ball{5}, turned(0, {0, 0, 4.99})},
                    Solid{Ball{5}, turned(0, {0, 0, -4.99})}, intersect()}),
      made("touching balls", {Solid{Ball{0.5}, turned(0, {-0.5, 0, 0})},
                              Solid{Ball{0.5}, turned(0, {0.5, 0, 0})}, unite()}),
      made("the same twice", {torus, torus, unite(0.1)}),
      made("gyroid", {ball, gyroid, intersect(0.05)}),
      made("thin gyroid", {ball, thin, intersect()}),
      made("thinnest gyroid", {cube, thinnest, intersect(0.01)}),
      made("carved by a gyroid", {box, gyroid, subtract(0.02)}),
      made("nested", {ball, box, intersect(0.1), capsule, torus, unite(0.05), subtract(0.2), gyroid,
                      left, intersect(0.03), unite(0.4)}),
      made("beside", {ball, tiny, unite()}),
      made("far apart", {Solid{Ball{1e-3}, turned(0, {1, 0, 0})},
                         Solid{Ball{0.1}, turned(0, {-1, 0, 0})}, unite(0.02)}),
      made("scales within", {Solid{Torus{700, 200}, turned(0.3, Vec3d(0), 1e-3)},
                             Solid{Ball{1e-4}, turned(0.1, {0.2, 0.7, 0}, 3e3)}, unite(0.05)})};
  cases[cases.size() - 3].aims = {{{0.805, 0, 0}, 3e-3}, {Vec3d(0), 1.2}};
  cases[cases.size() - 2].aims = {{{1, 0, 0}, 3e-3}, {{-1, 0, 0}, 0.2}};
  return cases;
}

/// A point where F is 0, to the precision of double.
inline Vec3d surface_point(const Case& c, Rng& rng) {
  const Case::Aim& aim = c.aims[rng.next_u32() % c.aims.size()];
  const auto somewhere = [&] {
    return aim.center + aim.radius * std::cbrt(rng.uniform()) * random_direction(rng);
  };
  Vec3d a = somewhere(), b = somewhere();
  double f_a = distance(c.sdf, a);
  // Solids may be so thin that chance finds no point of them: then descend along F's slope.
  for (int i = 0; i < 200 && f_a * distance(c.sdf, b) > 0; ++i) {
    b = somewhere();
    for (int k = 0; k < 8 && f_a * distance(c.sdf, b) > 0; ++k) {
      const Vec3d slope = gradient(c.sdf, b);
      b -= 1.01 * distance(c.sdf, b) / std::max(glm::dot(slope, slope), 0.1) * slope;
    }
  }
  for (int i = 0; i < 100; ++i) {
    const Vec3d middle = 0.5 * (a + b);
    const double f = distance(c.sdf, middle);
    (f * f_a > 0 ? a : b) = middle;
  }
  return a;
}

inline Vec3d normal(const Sdf& sdf, Vec3d p) {
  const Vec3d g = gradient(sdf, p);
  const double length = glm::length(g);
  return length > 0 ? g / length : Vec3d(1, 0, 0);
}

/// A point near a crease of the surface, if there is one nearby.
inline Vec3d crease_point(const Case& c, Rng& rng) {
  const auto to_surface = [&](Vec3d p) {
    for (int i = 0; i < 4; ++i)
      p -= distance(c.sdf, p) * normal(c.sdf, p);
    return p;
  };
  Vec3d a = surface_point(c, rng), b = surface_point(c, rng);
  for (int i = 0; i < 40; ++i) {
    const Vec3d middle = to_surface(0.5 * (a + b)), n = normal(c.sdf, middle);
    (glm::dot(n, normal(c.sdf, a)) < glm::dot(n, normal(c.sdf, b)) ? b : a) = middle;
  }
  return a;
}

/// At right angles to n; now and then along an axis, if one is perpendicular.
inline Vec3d tangent(Vec3d n, Rng& rng) {
  const int axis = static_cast<int>(rng.next_u32() % 3);
  Vec3d along(0);
  along[axis] = 1;
  if (n[axis] == 0 && rng.uniform() < 0.5) return along;
  return glm::normalize(glm::cross(n, random_direction(rng)));
}

enum class Kind {
  outside,
  inside,
  leaving,  ///< from the surface, up to rounding to float, to either side
  grazing,  ///< the same, at small slopes
  beside,   ///< from near the surface
  ending,   ///< near the surface
  along,    ///< from near the surface along it
  tangent,  ///< from outside
  crease,
};
constexpr std::size_t kinds = 9;
constexpr std::array<const char*, kinds> kind_names{
    "outside", "inside", "leaving", "grazing", "beside", "ending", "along", "tangent", "crease"};

inline sdf_lanes::Ray to_world(const Similarity& place, Vec3d o, Vec3d d,
                               double far = std::numeric_limits<double>::infinity()) {
  return {Vec3(place(o)), Vec3(glm::normalize(place.rotation * d)),
          static_cast<float>(far * place.scale)};
}

/// A ray for a case whose sdf has a size of about 1.
inline sdf_lanes::Ray ray(const Case& c, const Similarity& place, Kind kind, Rng& rng) {
  const Vec3d p = kind == Kind::crease ? crease_point(c, rng) : surface_point(c, rng);
  const Vec3d n = normal(c.sdf, p), along = tangent(n, rng), anywhere = random_direction(rng);
  const double distant = rng.uniform() < 0.1 ? 1000 : 1 + 3 * rng.uniform();
  const auto sloped = [&](double slope) { return glm::normalize(along + slope * n); };
  switch (kind) {
    case Kind::outside: {
      const Case::Aim& aim = c.aims[rng.next_u32() % c.aims.size()];
      const Vec3d o = aim.center + distant * anywhere;
      const Vec3d to = aim.center + aim.radius * rng.uniform() * random_direction(rng);
      return to_world(place, o, glm::normalize(to - o));
    }
    case Kind::inside:
      return to_world(place, p - 0.1 * rng.uniform() * n, anywhere);
    case Kind::leaving:
      return to_world(place, p, anywhere);
    case Kind::grazing:
      return to_world(place, p, sloped(of_any_size(rng, -6, -1)));
    case Kind::beside: {
      const Vec3d o = p + of_any_size(rng, -9, -1) * n;
      return to_world(place, o, rng.uniform() < 0.5 ? anywhere : sloped(of_any_size(rng, -6, -1)));
    }
    case Kind::ending: {
      const double length = rng.uniform() < 0.5 ? distant : std::abs(of_any_size(rng, -6, 0));
      const double far = length + of_any_size(rng, -8, -1) * length;
      return to_world(place, p - length * anywhere, anywhere, far);
    }
    case Kind::along:
      return to_world(place, p + of_any_size(rng, -9, -2) * n, along);
    case Kind::tangent:
      return to_world(place, p + of_any_size(rng, -9, -2) * n - distant * along, along);
    case Kind::crease: {
      const Vec3d to = p + of_any_size(rng, -9, -2) * random_direction(rng);
      return to_world(place, rng.uniform() < 0.5 ? to : to - distant * anywhere, anywhere);
    }
  }
  return {};
}

/// An sdf of random forms with a size of about 1; may be empty.
inline Case random_forms(Rng& rng) {
  const auto place = [&] {
    return turned(6 * rng.uniform(), 0.6 * rng.uniform() * random_direction(rng),
                  0.3 + 0.7 * rng.uniform());
  };
  const auto solid = [&]() -> Solid {
    const double u = rng.uniform(), v = rng.uniform();
    switch (rng.next_u32() % 5) {
      case 0:
        return {Ball{0.1 + 0.7 * u}, place()};
      case 1:
        return {Torus{0.3 + 0.6 * u, (0.3 + 0.6 * u) * std::max(v * v, 1e-3)}, place()};
      case 2: {
        const Vec3d half(0.1 + 0.6 * u, 0.1 + 0.6 * v, 0.1 + 0.6 * rng.uniform());
        const double least = std::min({half.x, half.y, half.z});
        return {RoundedBox{half, rng.uniform() < 0.5 ? 0 : least * rng.uniform()}, place()};
      }
      case 3:
        return {Capsule{u * random_direction(rng), random_direction(rng), 0.01 + 0.4 * v * v},
                place()};
      default:
        return {Gyroid{0.2 + u, 0.2 * (0.2 + u) * std::pow(10, -3 * v)}, place()};
    }
  };
  Case c{"random", {{Solid{Ball{0.5 + 0.4 * rng.uniform()}, place()}}, {}, false}};
  const std::uint32_t more = rng.next_u32() % 5;
  for (std::uint32_t i = 0; i < more; ++i) {
    Solid next = solid();
    // A gyroid alone fills space.
    const bool gyroid = std::holds_alternative<Gyroid>(next.form);
    const std::array operations{Operation::intersect, Operation::subtract, Operation::unite};
    c.sdf.steps.emplace_back(next);
    const double k = rng.uniform() < 0.4 ? 0 : std::abs(of_any_size(rng, -4, 0.5));
    c.sdf.steps.emplace_back(Combine{operations[rng.next_u32() % (gyroid ? 2 : 3)], k});
  }
  return c;
}

/// A case that is not empty.
inline Case random_case(Rng& rng) {
  for (;;) {
    Case c = random_forms(rng);
    for (int i = 0; i < 300; ++i) {
      if (distance(c.sdf, 1.2 * rng.uniform() * random_direction(rng)) < 0) return c;
    }
  }
}

}  // namespace sdf_cases
