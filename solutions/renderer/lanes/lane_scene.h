#pragma once

#include "geometry/mesh_tracer.h"
#include "renderer/envmap_table.h"
#include "renderer/lanes/lane_lights.h"
#include "renderer/lanes/lane_sdf.h"
#include "renderer/mesh_light.h"
#include "scene/needs.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace renderer {

/// A parallelepiped as three slabs: |axis_k . p - center_k| <= half_k, axes of length 1.
struct LaneBox {
  std::array<std::array<float, 3>, 3> axis{};
  std::array<float, 3> center{}, half{};
  /// Bit 2 k + 1: the face where axis_k . p - center_k = half_k belongs to it; bit 2 k: the other.
  std::uint32_t faces = 0;
};

/// A scene of few parallelograms, disks and spheres as the vector kernels read it. Surfaces have
/// numbers; what belongs to a surface is found by its number in columns, a property a column.
///
/// Three kinds of parallelograms are told apart, since boxes are cheaper than their sides:
/// - solids: parallelepipeds of six sides without emission, none of them glass, black from outside
///   or covered by another, the camera and all lights outside. No path is ever inside of one, so
///   that it is met from outside only, and never by a ray that leaves it;
/// - the enclosure: a parallelepiped that holds the whole scene, of which some sides are there,
/// none
///   of them glass, and the camera on the inner side of each. Rays from surfaces start inside of
///   it, and rays of the camera meet it where they leave it. Nothing lies behind its sides: it
///   casts no shadow;
/// - all others.
struct LaneScene {
  static constexpr std::size_t most = 128;  ///< numbers of surfaces, and lights
  static_assert(most == LaneLights::most);
  static constexpr std::size_t most_materials = 32;
  static constexpr std::uint32_t sides = 8;       ///< numbers that a solid takes,
  static constexpr std::uint32_t sides_used = 6;  ///< and how many of them it uses
  template <class T>
  using Column = std::array<T, most>;
  template <class T>
  using MaterialColumn = std::array<T, most_materials>;

  /// Whether the kernels can render the scene: shapes of all kinds and of any material, at most
  /// `most` (a mesh is one) and `most_materials`; those that emit, points that do, and an image
  /// around, at most `most` of all, and light from around; independent and Sobol' points. What is
  /// not on this list goes to the scalar path tracer.
  static bool suits(const carlo::Needs& needs, const carlo::Scene& scene);

  explicit LaneScene(const carlo::Scene& scene);

  /// Solid i has the numbers from i * sides on, one for each side in the order of LaneBox::faces.
  /// The enclosure, if there is one, follows with the numbers that it uses; then other
  /// parallelograms, then disks, then spheres, then signed distance functions, then meshes.
  std::vector<LaneBox> solids;
  LaneBox enclosure;
  bool enclosed = false, camera_inside = false;
  std::uint32_t first_quad = 0, first_disk = 0, first_sphere = 0, first_sdf = 0, first_mesh = 0;
  std::uint32_t surfaces = 0;  ///< behind the last
  std::vector<LaneSdf> sdfs;
  std::unique_ptr<carlo::MeshTracer> meshes;          ///< if there are any; and of each
  std::vector<std::optional<MeshLight>> mesh_lights;  ///< that emits, points on it

  /// Of a parallelogram, or of the square around a disk: the plane n p = d with unit normal n.
  Column<float> nx{}, ny{}, nz{}, d{};
  /// And a p - a0, b p - b0: -1 to 1 across it.
  Column<float> ax{}, ay{}, az{}, a0{}, bx{}, by{}, bz{}, b0{};
  /// Of a sphere; its normal is (p - center) / radius, where radius < 0 if it is flipped.
  Column<float> cx{}, cy{}, cz{}, radius{};
  Column<float> width{};  ///< twice |radius|
  /// Of either, what its rounding is relative to: |d|, and a sphere's |center|_1 + |radius|.
  Column<float> coordinates{};
  /// Parallelograms of one plane have the same number here, and the same n and d but for a sign;
  /// spheres their own. A ray never meets the plane that it starts on. Only where one is shared by
  /// a light or by what is no side of a box (`coplanar`) these are more than the surfaces' numbers.
  Column<std::uint32_t> plane{};
  bool coplanar = false;
  /// Of a parallelogram outside of boxes: one more than the last number of those that follow it in
  /// a row and share its plane.
  Column<std::uint32_t> run_end{};
  /// Those of a row in patches of a few that lie together (lane_runs.h): of the first of each, one
  /// more than the last number, and the middle and half size of a rectangle around them, in the
  /// coordinates (a, b) of the row's first.
  Column<std::uint32_t> patch_end{};
  Column<float> patch_a{}, patch_b{}, patch_half_a{}, patch_half_b{};
  /// Whether a parallelogram or a sphere outside of boxes comes so close to another surface that an
  /// origin on one may be rounded beyond the other.
  bool touching = false;
  Column<std::uint32_t> material{};
  Column<float> le_r{}, le_g{}, le_b{};
  /// Per area, of the points that light sampling draws there once it has chosen this light; 0: no
  /// light. Of a sphere that emits outwards (`by_direction`) 1 / (2 pi): its directions are drawn
  /// instead. Of a mesh of one triangle: of others MeshLight knows it.
  Column<float> light_density{};
  Column<std::uint32_t> light_of{};  ///< the number of the light that a surface is
  /// Per area and pi, of the points where paths from lamps start: uniform over each one's area.
  Column<float> emission{};

  /// What the surface does with light: kd / pi, ks (n + 2) / (2 pi). `diffuse` is the share of kd
  /// in kd + ks.
  std::uint32_t materials = 0;
  MaterialColumn<float> kd_r{}, kd_g{}, kd_b{}, ks_r{}, ks_g{}, ks_b{}, exponent{}, diffuse{};
  MaterialColumn<std::uint32_t> two_sided{};  ///< glass is
  /// Of a mirror ks is its reflectance. Of glass `ior` is the index inside over that outside, of
  /// other materials 0.
  MaterialColumn<std::uint32_t> specular{};  ///< mirrors and glass
  MaterialColumn<float> ior{};
  bool any_specular = false;

  std::uint32_t lights = 0;
  std::uint32_t first_point = 0;  ///< among the lights: these are no surfaces,
  std::uint32_t sky_light = 0;    ///< nor is this, if there is a `sky`
  LaneLights choice;              ///< by what they are chosen
  /// Light i: its surface's number; of a parallelogram corner and edges, of a disk center and
  /// radii, of a point its place.
  Column<float> lx{}, ly{}, lz{}, lux{}, luy{}, luz{}, lvx{}, lvy{}, lvz{};
  Column<std::uint32_t> light_surface{};
  /// Of a point: its intensity, and the chance that a path starts there over 4 pi.
  Column<float> intensity_r{}, intensity_g{}, intensity_b{}, point_emission{};
  /// The radiance of the brightest lamp; a point's is what it brings to a surface a thousandth of
  /// the scene away.
  double brightest = 0;

  /// Of splats of so many paths from lamps: with room for pixels 2^13 times as bright as that.
  double splat_unit(std::uint64_t paths) const;

  float environment[3] = {0, 0, 0};
  /// The image around the scene, and a distance that is beyond all surfaces.
  std::optional<EnvmapTable> sky;
  float sky_far = 0;
  bool sobol = false;  ///< points, or independent ones
  bool phong = false, one_sided = false;

  bool sphere_lights = false, disk_lights = false, any_mesh_light = false;

  bool disks() const { return first_sphere > first_disk; }
  bool point_lights() const { return lights > first_point; }
  /// Whether some lights are no surfaces.
  bool other_lights() const { return point_lights() || sky; }
  /// Whether there are lights where paths may start.
  bool lamps() const { return lights > (sky ? 1u : 0u); }
  bool spheres() const { return first_sdf > first_sphere; }
  /// Whether there are surfaces that rays are asked about one by one, after all others.
  bool searched() const { return !sdfs.empty() || meshes != nullptr; }
  /// Whether it needs what Features::close is for, and what Features::full is for.
  bool close() const { return spheres() || touching || coplanar; }
  bool full() const {
    return any_specular || sphere_lights || disks() || other_lights() || searched();
  }
};

}  // namespace renderer
