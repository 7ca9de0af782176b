// One to 1e5 lights over a spot of a floor, few of which matter. The numbers lie on both
// sides of those at which the renderer changes its method (128 and 65536 lights in the vector
// kernel).
//
// Each light has a direction of its own, spread evenly over the sphere, so none hides another.
// Exact: albedo / pi times the sum of the contributions of those above the horizon: I cos / d^2 for
// points, L pi sin^2 cos for balls, Lambert's formula for squares and triangles.

#include "closed_forms.h"
#include "proving/ground.h"
#include "proving/irradiance.h"
#include "proving/parts.h"
#include "proving/spots.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene, carlo::Vec3;
using closed_forms::pi;
using glm::dvec3;

constexpr double crowd_albedo = .5;

/// The i-th of `count` directions on a Fibonacci spiral, from +y to -y: about 3 / sqrt(count)
/// apart.
dvec3 spread(int i, int count) {
  const double y = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - y * y);
  const double turn = i * pi * (3 - std::sqrt(5.0)) + 2;
  return {r * std::cos(turn), y, r * std::sin(turn)};
}

struct CrowdLight {
  dvec3 w;  ///< direction
  double distance, size, irradiance_if_it_faced;
};

enum class CrowdKind { points, balls, squares, triangles };
constexpr CrowdKind crowd_kinds[] = {CrowdKind::points, CrowdKind::balls, CrowdKind::squares,
                                     CrowdKind::triangles};
const char* name_of(CrowdKind kind) {
  constexpr const char* names[] = {"points", "balls", "squares", "triangles"};
  return names[static_cast<std::size_t>(kind)];
}

/// Three lights matter: they are near, and contribute 1, 1/4 and 1/16 (times the cosine). The
/// others are a hundred units away: if they are `around`, also above the horizon, and each
/// contributes a little. If they are below it, they have up to 1e4 times the power; not so
/// triangles, which share one radiance and would have to be that much larger.
std::vector<CrowdLight> crowd(CrowdKind kind, int count, bool around) {
  Random random(static_cast<std::uint64_t>(count));
  std::vector<CrowdLight> lights;
  const double size = std::min(.05, .2 / std::sqrt(count));
  const double strength = (around || kind == CrowdKind::triangles ? 1 : 100) / std::sqrt(count);
  int near = 0;
  for (int i = 0; i < count; ++i) {
    dvec3 w = count == 1 ? dvec3(.48, .8, -.36) : spread(i, count);
    const double brings = strength * std::pow(10.0, random.uniform(-4, -2));
    // Numbers 1/8, 2/8 and 3/8 of all, which are above the horizon.
    if (near < 3 && w.y > .1 && i >= (near + 1) * count / 8) {
      lights.push_back({w, 1.2, size, std::pow(4.0, -near++)});
      continue;
    }
    if (!around && w.y > 0) w = -w;
    // The horizon cuts none: closed forms hold for lights entirely above or below it.
    if (std::abs(w.y) < 3 * size) w = glm::normalize(dvec3(w.x, -1, w.z));
    lights.push_back({w, 100, size, brings});
  }
  return lights;
}

/// Adds lights that face the origin, triangles to one mesh; `sum` is the irradiance there.
struct CrowdBuilder {
  Scene& scene;
  carlo::Mesh mesh{};
  double sum = 0;

  void add(CrowdKind kind, const CrowdLight& light) {
    const dvec3 at = light.distance * light.w;
    const double up = std::max(0.0, light.w.y), half = light.size * light.distance;
    const double sin2 = light.size * light.size;
    const dvec3 x = half * glm::normalize(glm::cross(light.w, dvec3(.3, .2, .9)));
    const dvec3 y = glm::cross(-light.w, x);
    switch (kind) {
      case CrowdKind::points: {
        const auto intensity =
            static_cast<float>(light.irradiance_if_it_faced * light.distance * light.distance);
        scene.lights.points.push_back({Vec3(at), Rgb(intensity)});
        sum += light.irradiance_if_it_faced * up;
        return;
      }
      case CrowdKind::balls: {
        const auto radiance = static_cast<float>(light.irradiance_if_it_faced / (pi * sin2));
        scene.shapes.push_back(ball(at, half, {1, Rgb(radiance)}));
        sum += light.irradiance_if_it_faced * up;
        return;
      }
      case CrowdKind::squares: {
        const auto radiance = static_cast<float>(light.irradiance_if_it_faced / (4 * sin2));
        scene.shapes.push_back(panel(at, x, y, {1, Rgb(radiance)}));
        if (up > 0)
          sum += static_cast<double>(radiance) *
                 polygon_irradiance({at - x - y, at + x - y, at + x + y, at - x + y});
        return;
      }
      case CrowdKind::triangles: {
        // One mesh has one radiance: sizes differ instead.
        const double by = std::sqrt(light.irradiance_if_it_faced);
        const dvec3 corner[] = {at - by * (x + y), at + by * (x - y), at + by * y};
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const dvec3& p : corner)
          mesh.positions.push_back(Vec3(p));
        mesh.triangles.push_back({first, first + 1, first + 2});
        if (up > 0) sum += polygon_irradiance({corner[0], corner[1], corner[2]}) / (2 * sin2);
        return;
      }
    }
  }
  void finish(double size) {
    if (mesh.triangles.empty()) return;
    const auto radiance = static_cast<float>(1 / (2 * size * size));
    scene.shapes.push_back({std::move(mesh), 1, Rgb(radiance)});
  }
};

void add_crowd(std::vector<Proof>& proofs, CrowdKind kind, int count, bool around) {
  Scene scene = empty();
  scene.materials = {diffuse(Rgb(crowd_albedo), true), diffuse(Rgb(0), false)};
  scene.shapes = {level(50, 0)};
  scene.camera = spot_camera();
  scene.max_depth = 2;
  CrowdBuilder builder{scene};
  const std::vector<CrowdLight> lights = crowd(kind, count, around);
  for (const CrowdLight& light : lights)
    builder.add(kind, light);
  builder.finish(lights[0].size);
  Proof proof{fmt::format("crowds/{}/{}/{}", name_of(kind), count, around ? "around" : "below"),
              std::move(scene), exact_of(crowd_albedo * builder.sum / pi),
              count < 100 ? 1024U : 8192U};
  // Small distant triangles lose digits: corners of 100 are accurate to 4e-6.
  proof.rounding = kind == CrowdKind::points || kind == CrowdKind::balls ? 1e-5 : 5e-5;
  proof.for_lab = count <= 10;
  proofs.push_back(std::move(proof));
}

}  // namespace

std::vector<Proof> light_crowd_proofs() {
  std::vector<Proof> proofs;
  for (const CrowdKind kind : crowd_kinds) {
    for (const int count : {1, 2, 10, 100, 127, 128, 129, 1000, 10000, 100000}) {
      // Each ball or square is a separate primitive of the intersector: 1e5 take long to build.
      const bool many = count == 100000;
      if (many && (kind == CrowdKind::balls || kind == CrowdKind::squares)) continue;
      add_crowd(proofs, kind, count, false);
      if (!many) add_crowd(proofs, kind, count, true);
    }
  }
  return proofs;
}

}  // namespace proving
