#pragma once

#include "recap.h"

namespace lab08 {

/// A ball of light at the centre of a spherical room of diffuse walls, which may emit. Every point
/// of the wall sees the same, so what the wall shows is one number, and what the printed forms of
/// TracePath make of it is one, too. Lengths are in units of the room's radius, but for scene().
struct RecapRoom {
  double albedo = 0;         ///< of the wall, below 1
  double ball = 0;           ///< the ball's radius, between 0 and 1
  double wall_emits = 0;     ///< radiance
  double ball_radiance = 0;  ///< it reflects nothing

  /// The room with radius 2.
  carlo::Scene scene() const;
  BallLamp lamp() const { return {Vec3(0), static_cast<float>(2 * ball)}; }
  /// A ray that meets the wall first.
  static Ray ray() { return {{0, 0, 1.9f}, {0.6f, 0, 0.8f}}; }

  /// Of the ball, seen from the wall: the ball's whole cone stands above the horizon.
  double solid_angle() const;
  /// The share of cosine-weighted directions that meet the ball: cos integrates to pi sin^2 over
  /// its cone, and the sine is the ball's radius.
  double view_factor() const { return ball * ball; }

  /// What the wall shows.
  double exact() const;
  /// What a light ray is multiplied with in the Recap over what it should be, its solid angle.
  double light_ratio() const;
  /// The same for a non-light ray: the factor of each bounce. Negative for a solid angle below 1.
  double non_light_ratio() const;
  /// The mean of recap_as_printed(); infinite where each bounce brings more than the one before.
  double recap_mean() const;
  /// The mean of random_direction_as_printed().
  double random_direction_mean() const;
};

}  // namespace lab08
