#include "geometry/planes.h"
#include "renderer/lanes/lane_plan.h"
#include "renderer/lanes/lane_scene.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

namespace renderer {
namespace {

using Vec3d = glm::dvec3;

constexpr std::size_t patch_size = 6;

Vec3d middle(const carlo::Scene& scene, std::size_t quad) {
  const auto& s = std::get<carlo::Parallelogram>(scene.shapes[quad].geometry);
  return Vec3d(s.origin) + 0.5 * (Vec3d(s.u) + Vec3d(s.v));
}

/// Halves the row across its longest extent, down to patches.
void sort_by_place(const carlo::Scene& scene, std::span<std::size_t> quads) {
  if (quads.size() <= patch_size) return;
  Vec3d lower = middle(scene, quads[0]), upper = lower;
  for (const std::size_t i : quads) {
    lower = glm::min(lower, middle(scene, i));
    upper = glm::max(upper, middle(scene, i));
  }
  const Vec3d extent = upper - lower;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t patches = (quads.size() + patch_size - 1) / patch_size;
  const std::size_t half = patches / 2 * patch_size;
  std::nth_element(quads.begin(), quads.begin() + static_cast<std::ptrdiff_t>(half), quads.end(),
                   [&](std::size_t a, std::size_t b) {
                     const double x = middle(scene, a)[axis], y = middle(scene, b)[axis];
                     return x != y ? x < y : a < b;
                   });
  sort_by_place(scene, quads.first(half));
  sort_by_place(scene, quads.subspan(half));
}

}  // namespace

std::vector<std::size_t> in_patches(const carlo::Scene& scene, std::vector<std::size_t> quads) {
  std::vector<carlo::Parallelogram> shapes;
  for (const std::size_t i : quads)
    shapes.push_back(std::get<carlo::Parallelogram>(scene.shapes[i].geometry));
  const carlo::Planes planes = carlo::find_planes(shapes);
  std::vector<std::vector<std::size_t>> of_plane(quads.size());
  for (std::size_t k = 0; k < quads.size(); ++k)
    of_plane[planes.of[k].first].push_back(quads[k]);
  std::vector<std::size_t> sorted;
  for (std::vector<std::size_t>& some : of_plane) {
    sort_by_place(scene, some);
    sorted.insert(sorted.end(), some.begin(), some.end());
  }
  return sorted;
}

namespace {

/// The least and largest value of a coordinate of some points, widened by its possible rounding
/// error.
struct Range {
  double low = 1e300, high = -1e300, blur = 0;

  void include(Vec3d axis, double origin, Vec3d p) {
    constexpr double rounding = 0x1p-20;
    const double value = glm::dot(axis, p) - origin;
    low = std::min(low, value), high = std::max(high, value);
    blur = std::max(blur, rounding * (glm::dot(glm::abs(axis), glm::abs(p)) + std::abs(origin)));
  }
  float middle() const { return static_cast<float>((low + high) / 2); }
  float half() const { return static_cast<float>((high - low) / 2 * (1 + 1e-5) + 2 * blur); }
};

}  // namespace

void bound_patches(const carlo::Scene& scene, const std::vector<std::size_t>& quads, LaneScene& s) {
  for (std::uint32_t first = s.first_quad; first < s.first_disk; first = s.run_end[first]) {
    const Vec3d along_a(s.ax[first], s.ay[first], s.az[first]);
    const Vec3d along_b(s.bx[first], s.by[first], s.bz[first]);
    for (std::uint32_t k = first; k < s.run_end[first]; ++k) {
      s.turned[k] = s.nx[k] != s.nx[first] || s.ny[k] != s.ny[first] || s.nz[k] != s.nz[first];
    }
    for (std::uint32_t k = first; k < s.run_end[first]; k = s.patch_end[k]) {
      s.patch_end[k] = std::min(k + static_cast<std::uint32_t>(patch_size), s.run_end[first]);
      Range a, b;
      for (std::uint32_t i = k; i < s.patch_end[k]; ++i) {
        const auto& shape = scene.shapes[quads[i - s.first_quad]];
        for (const Vec3d& p : corners(std::get<carlo::Parallelogram>(shape.geometry))) {
          a.include(along_a, static_cast<double>(s.a0[first]), p);
          b.include(along_b, static_cast<double>(s.b0[first]), p);
        }
      }
      s.patch_a[k] = a.middle(), s.patch_half_a[k] = a.half();
      s.patch_b[k] = b.middle(), s.patch_half_b[k] = b.half();
    }
  }
}

}  // namespace renderer
