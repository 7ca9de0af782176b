#include "proving/spots.h"

#include "closed_forms.h"
#include "proving/irradiance.h"

#include <cmath>
#include <utility>

namespace proving {
namespace {

using glm::dvec3;

/// A parallelogram about `centre`, its normal downwards, by Lambert's formula.
Light slanted_rectangle(dvec3 centre, dvec3 a, dvec3 b) {
  return {"slanted", panel(centre, a, b),
          polygon_irradiance({centre - a - b, centre + a - b, centre + a + b, centre - a + b})};
}

Light triangle(dvec3 a, dvec3 b, dvec3 c) {
  carlo::Mesh mesh{{carlo::Vec3(a), carlo::Vec3(b), carlo::Vec3(c)}, {{0, 1, 2}}};
  return {"triangle", {std::move(mesh)}, polygon_irradiance({a, b, c})};
}

}  // namespace

std::vector<Light> lights() {
  using namespace closed_forms;
  const double s = std::sin(50 * pi / 180), c = std::cos(50 * pi / 180);
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {{"ball", ball({0, 2, 0}, 1), sphere_irradiance(2, 0)},
          {"ball aside", ball({-2 * s, 2 * c, 0}, 1), sphere_irradiance(2, 50 * pi / 180)},
          {"disk", {carlo::Disk{{0, 1, 0}, {0, -1, 0}, 1}}, disk_irradiance(1, 1, 0)},
          {"disk aside", {carlo::Disk{{-.5f, 1, 0}, {0, -1, 0}, 1}}, disk_irradiance(1, 1, .5)},
          {"rectangle", panel(y, .5 * x, .5 * z), 4 * rectangle_irradiance(.5, .5)},
          {"wall", panel({-1, .5, 0}, .5 * y, .5 * z), 2 * perpendicular_irradiance(2, 2)},
          slanted_rectangle({-.3, 1.1, .2}, {.4, .3, .1}, {.1, -.2, .5}),
          triangle({-.5, .9, -.5}, {.4, 1.2, -.3}, {.1, .8, .6})};
}

carlo::Camera spot_camera() {
  return camera_at({.6, .5, .3}, {0, 0, 0}, .01);
}

double spot_rounding(double shift) {
  return 1e-5 + 5e-7 * shift;
}

carlo::Shape lit(carlo::Shape light, std::uint32_t material, carlo::Rgb radiance) {
  light.material = material;
  light.radiance = radiance;
  return light;
}

}  // namespace proving
