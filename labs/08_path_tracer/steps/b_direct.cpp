#include "course/not_implemented.h"
#include "hemisphere.h"
#include "numeric/robust.h"
#include "path_tracer.h"

#include <cmath>

// Lab 08, step b: light that comes straight from a light. path_tracer.h says what each function
// takes and returns.

namespace lab08 {

// Lab 8.2 -----------------------------------------------------------------------------------------

Rgb direct_by_area(const World& world, const Surface& surface, const Brdf& f, Rng& rng) {
  // 1. Without lights it is dark.
  // 2. One number for world.choose(), which says what light, then a point of it: two more numbers,
  //    a statement each.
  // 3. The direction to the point, its distance, and two cosines: at the surface and at the light.
  //    Where one of them is not above 0, nothing arrives.
  // 4. One shadow ray: does the surface see the point?
  // 5. The integrand of the area form, divided by the density of this point. Of which choices is
  //    that density the product?
  carlo::not_implemented("Lab 8.2", "Monte Carlo Path Tracer");
}

Rgb direct_by_hemisphere(const World& world, const Surface& surface, const Brdf& f, Rng& rng) {
  // 1. A cosine-weighted direction (lab 7), turned from the normal's frame into the world.
  // 2. A ray in this direction that leaves the surface without meeting it again.
  // 3. The surface that it meets emits towards you, or does not; if it meets nothing there is no
  //    light.
  // 4. The integrand of the hemisphere form over the density; cancel what cancels by hand.
  carlo::not_implemented("Lab 8.2", "Monte Carlo Path Tracer");
}

}  // namespace lab08
