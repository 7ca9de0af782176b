#pragma once

#include "recap.h"

namespace lab08 {

/// A ball of light at the centre of a spherical room with diffuse walls, which may emit. Every
/// point of the wall is equivalent, so its radiance is a single number, and so is the result of
/// each printed form of TracePath. Lengths are in units of the room's radius, except in scene().
struct RecapRoom {
  double albedo = 0;         ///< of the wall, below 1
  double ball = 0;           ///< the ball's radius, between 0 and 1
  double wall_emits = 0;     ///< radiance
  double ball_radiance = 0;  ///< it reflects nothing

  /// The room with radius 2.
  carlo::Scene scene() const;
  BallLight light() const { return {Vec3(0), static_cast<float>(2 * ball)}; }
  /// A ray that meets the wall first.
  static Ray ray() { return {{0, 0, 1.9f}, {0.6f, 0, 0.8f}}; }

  /// The solid angle of the ball, seen from the wall: the ball's whole cone is above the horizon.
  double solid_angle() const;
  /// The fraction of cosine-weighted directions that meet the ball: cos integrates to pi sin^2 over
  /// its cone, and the sine is the ball's radius.
  double view_factor() const { return ball * ball; }

  /// The wall's radiance.
  double exact() const;
  /// The factor of a light ray in the Recap, relative to the right one, its solid angle.
  double light_ratio() const;
  /// The same for a non-light ray: the factor per bounce. Negative for a solid angle below 1.
  double non_light_ratio() const;
  /// The mean of recap_as_printed(); infinite if each bounce adds more than the one before.
  double recap_mean() const;
  /// The mean of random_direction_as_printed().
  double random_direction_mean() const;
};

}  // namespace lab08
