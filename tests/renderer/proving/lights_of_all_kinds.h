#pragma once

#include "proving/parts.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace proving {

/// Lights of every kind that a scene can have, for pairs of them.
enum class LightKind { point, rectangle, disk, ball, mesh, room, image, sky };

constexpr LightKind light_kinds[] = {LightKind::point, LightKind::rectangle, LightKind::disk,
                                     LightKind::ball,  LightKind::mesh,      LightKind::room,
                                     LightKind::image, LightKind::sky};

const char* name_of(LightKind kind);

/// Whether it is all around: a sphere that shines inwards (room), an image, a sky of one radiance.
bool surrounds(LightKind kind);

/// Where a light stands as seen from the origin, whose surface has the normal +y: in the unit
/// direction w, so far away. Those that surround the origin are a sphere of five times that or
/// infinitely far away.
struct Stand {
  glm::dvec3 w;
  double distance;
};

/// A light of a scene, and what it does at the origin.
struct AddedLight {
  double irradiance = 0;  ///< if it is seen whole
  /// The irradiance that its outline takes from what is behind it, where that has radiance 1.
  double covers = 0;
};

/// Adds a black light that gives the origin about this irradiance (below the horizon: the one at
/// -w). All are symmetric about w and a
/// fifth of the distance in size, so that closed forms hold: L pi sin^2 cos for a disk or a ball
/// under a half-angle of that sine, Lambert's formula for what has corners, I cos / d^2 for points.
/// Material 1 of the scene is black.
AddedLight add_light(carlo::Scene& scene, LightKind kind, const Stand& stand, double irradiance);

/// A black square across the way to what stands there, half way, which hides all of it; what it
/// covers, as above.
double add_card(carlo::Scene& scene, const Stand& stand);

/// An image around the scene of 8 x 4 texels, each with the radiance of its column and row.
carlo::Envmap image_of(carlo::Rgb (*radiance)(int column, int row));

}  // namespace proving
