#pragma once

#include "proving/parts.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace proving {

/// Lights of every kind that a scene can have, for pairs.
enum class LightKind { point, rectangle, disk, ball, mesh, room, image, sky };

constexpr LightKind light_kinds[] = {LightKind::point, LightKind::rectangle, LightKind::disk,
                                     LightKind::ball,  LightKind::mesh,      LightKind::room,
                                     LightKind::image, LightKind::sky};

const char* name_of(LightKind kind);

/// True for lights all around: a sphere that emits inwards (room), an image, a sky of constant
/// radiance.
bool surrounds(LightKind kind);

/// Where a light is as seen from the origin, whose surface has the normal +y: in the unit direction
/// w, at this distance. Lights that surround the origin are a sphere of five times that radius, or
/// infinitely far away.
struct Stand {
  glm::dvec3 w;
  double distance;
};

/// A light in a scene, and its effect at the origin.
struct AddedLight {
  double irradiance = 0;  ///< if it is entirely visible
  /// The irradiance that its outline takes away from a background of radiance 1.
  double covers = 0;
};

/// Adds a black light that gives the origin about this irradiance (if below the horizon: as if
/// it were at -w). All are symmetric about w and have a size of a fifth of the distance, so that
/// closed forms hold: L pi sin^2 cos for a disk or a ball with the sine of its half-angle,
/// Lambert's formula for polygons, I cos / d^2 for points. Material 1 of the scene is black.
AddedLight add_light(carlo::Scene& scene, LightKind kind, const Stand& stand, double irradiance);

/// A black square half way to the light, which hides all of it; returns what it covers, as above.
double add_card(carlo::Scene& scene, const Stand& stand);

/// An environment map of 8 x 4 texels, each with the radiance of its column and row.
carlo::Envmap image_of(carlo::Rgb (*radiance)(int column, int row));

}  // namespace proving
