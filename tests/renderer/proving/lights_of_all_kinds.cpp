#include "proving/lights_of_all_kinds.h"

#include "closed_forms.h"
#include "proving/irradiance.h"
#include "proving/spots.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene, carlo::Vec3;
using closed_forms::pi;
using glm::dvec3;

constexpr double relative_size = .2, room_size = 5;

/// A square of this half side about `centre` that faces the origin: its corners lie on a circle
/// about the direction to the origin.
struct Square {
  dvec3 centre, a, b;

  Square(const Stand& stand, double half) : centre(stand.distance * stand.w) {
    const dvec3 x = glm::normalize(glm::cross(stand.w, dvec3(.3, .2, .9)));
    a = half * x, b = half * glm::cross(-stand.w, x);
  }
  double irradiance() const {
    return polygon_irradiance({centre - a - b, centre + a - b, centre + a + b, centre - a + b});
  }
};

/// The square as two triangles: each is a light, which divides probabilities by their number.
carlo::Shape as_mesh(const Square& square) {
  const dvec3 &c = square.centre, &a = square.a, &b = square.b;
  carlo::Mesh mesh{{Vec3(c - a - b), Vec3(c + a - b), Vec3(c + a + b), Vec3(c - a + b)},
                   {{0, 1, 2}, {0, 2, 3}}};
  return {std::move(mesh)};
}

/// As in add_light(), for shapes that do not surround the origin: with radiance 1, and the
/// resulting irradiance.
std::pair<carlo::Shape, double> small_light(LightKind kind, const Stand& stand) {
  const double size = relative_size * stand.distance, cosine = std::abs(stand.w.y);
  if (kind == LightKind::ball)
    return {ball(stand.distance * stand.w, size), pi * relative_size * relative_size * cosine};
  if (kind == LightKind::disk) {
    const double sin2 = relative_size * relative_size / (1 + relative_size * relative_size);
    return {{carlo::Disk{Vec3(stand.distance * stand.w), Vec3(-stand.w), static_cast<float>(size)}},
            pi * sin2 * cosine};
  }
  const Square square(stand, size);
  if (kind == LightKind::mesh) return {as_mesh(square), square.irradiance()};
  return {panel(square.centre, square.a, square.b), square.irradiance()};
}

AddedLight add_point(Scene& scene, const Stand& stand, double irradiance) {
  const auto intensity =
      static_cast<float>(irradiance * stand.distance * stand.distance / std::abs(stand.w.y));
  scene.lights.points.push_back({Vec3(stand.distance * stand.w), Rgb(intensity)});
  return {irradiance, 0};
}

AddedLight add_around(Scene& scene, LightKind kind, const Stand& stand, double irradiance) {
  const auto radiance = static_cast<float>(irradiance / pi);
  if (kind == LightKind::sky) scene.lights.environment = Rgb(radiance);
  if (kind == LightKind::image) {
    scene.lights.envmap = image_of([](int, int) { return Rgb(1); });
    for (Rgb& texel : scene.lights.envmap->image.pixels)
      texel *= radiance;
  }
  if (kind == LightKind::room)
    scene.shapes.push_back(
        ball(dvec3(0), room_size * stand.distance, {1, Rgb(radiance)}, Facing::inwards));
  return {irradiance, pi};
}

}  // namespace

const char* name_of(LightKind kind) {
  switch (kind) {
    case LightKind::point:
      return "point";
    case LightKind::rectangle:
      return "rectangle";
    case LightKind::disk:
      return "disk";
    case LightKind::ball:
      return "ball";
    case LightKind::mesh:
      return "mesh";
    case LightKind::room:
      return "room";
    case LightKind::image:
      return "image";
    case LightKind::sky:
      return "sky";
  }
  return "";
}

bool surrounds(LightKind kind) {
  return kind == LightKind::room || kind == LightKind::image || kind == LightKind::sky;
}

AddedLight add_light(Scene& scene, LightKind kind, const Stand& stand, double irradiance) {
  if (kind == LightKind::point) return add_point(scene, stand, irradiance);
  if (surrounds(kind)) return add_around(scene, kind, stand, irradiance);
  auto [shape, brings] = small_light(kind, stand);
  scene.shapes.push_back(lit(std::move(shape), 1, Rgb(static_cast<float>(irradiance / brings))));
  return {irradiance, brings};
}

double add_card(Scene& scene, const Stand& stand) {
  const Square card({stand.w, .5 * stand.distance}, .65 * relative_size * stand.distance);
  scene.shapes.push_back(panel(card.centre, card.a, card.b, {1}));
  return card.irradiance();
}

carlo::Envmap image_of(Rgb (*radiance)(int column, int row)) {
  carlo::Envmap map{carlo::Image(8, 4)};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 8; ++column)
      map.image.at(column, row) = radiance(column, row);
  }
  return map;
}

}  // namespace proving
