#pragma once

#include "path_tracer.h"

namespace lab08 {

// The lecture's last TracePath (Recap) as printed, and corrected. Not an exercise: it runs on steps
// c and d. Surfaces are Phong surfaces.

/// The light that light rays are drawn towards: a ball that reflects nothing. Other shapes may
/// emit; they are met by chance.
struct BallLight {
  Vec3 centre{0};
  float radius = 0;

  /// The directions in which it is seen from a point outside it.
  Cone seen_from(Vec3 p) const { return cone_of(centre, radius, p); }
};

/// One path.
struct RecapPath {
  Rgb radiance{0};   ///< the estimate of the radiance along its first ray
  int calls = 0;     ///< of TracePath, including the first one
  bool cut = false;  ///< true if it needed more calls than allowed; these contributed 0
};

/// Every form of TracePath below makes at most `most_calls` calls, so that it ends.
using RecapForm = RecapPath (*)(const World& world, const BallLight& light, const Ray& ray,
                                int most_calls, Rng& rng);

/// TracePath before the Recap (lecture, Monte Carlo Path Tracer): emission with probability p_emit,
/// otherwise one "random direction d'", here uniform in the hemisphere. Does not divide by the
/// density of d'. Only chance finds the light.
RecapPath random_direction_as_printed(const World& world, const BallLight& light, const Ray& ray,
                                      int most_calls, Rng& rng);

/// TracePath as printed in the Recap: emission with probability p_emit, otherwise a ray towards the
/// light and one that is not, multiplied by p_light / 2 and by (1 - p_light) / 2, where p_light is
/// 1 over the solid angle of the light.
RecapPath recap_as_printed(const World& world, const BallLight& light, const Ray& ray,
                           int most_calls, Rng& rng);

/// The Recap, corrected: emission is added; then a light ray, a non-light ray or none, each with
/// the weight that its density demands. Where nothing hides the light, the variance is finite for
/// every albedo below 1; a surface that absorbs nothing is a carlo::Error.
RecapPath recap_mended(const World& world, const BallLight& light, const Ray& ray, int most_calls,
                       Rng& rng);

}  // namespace lab08
