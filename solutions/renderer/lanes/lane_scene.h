#pragma once

#include "geometry/mesh_tracer.h"
#include "renderer/envmap_table.h"
#include "renderer/lanes/lane_lights.h"
#include "renderer/lanes/lane_sdf.h"
#include "renderer/lanes/lane_tree.h"
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
  bool upright = false;   ///< its axes are those of the coordinates, in some order
  bool parallel = false;  ///< of LaneScene::solids: its axes are those of the one before
};

/// A scene as the vector kernels read it. Surfaces are numbered, and there is a column of entries
/// for each of their properties.
///
/// Parallelograms are of three kinds, since boxes are cheaper than their sides:
/// - solids: parallelepipeds of six sides without emission, none of them glass, black from outside
///   or covered by another, with the camera and all lights outside. No path is ever inside one, so
///   it is met only from outside, and never by a ray that leaves it;
/// - the enclosure: a parallelepiped that holds the whole scene and has some of its sides, none of
///   them glass, with the camera on the inner side of each. Rays from surfaces start inside it, and
///   rays from the camera meet it where they leave it. Nothing lies behind its sides: it casts no
///   shadow;
/// - all others.
struct LaneScene {
  static constexpr std::size_t most = 1 << 16;  ///< largest number of surfaces, and of lights
  static constexpr std::size_t few = 128;       ///< largest number of sdfs and meshes
  /// Rays test all surfaces one by one if there are at most `few`, and at most this many when each
  /// box and each plane counts once. Beyond, a tree takes less time.
  static constexpr std::size_t most_tried = 48;
  static constexpr std::size_t most_materials = 32;
  static constexpr std::uint32_t sides = 8;       ///< numbers reserved for a solid
  static constexpr std::uint32_t sides_used = 6;  ///< numbers that it uses
  template <class T>
  using MaterialColumn = std::array<T, most_materials>;

  /// True if the kernels can render the scene: shapes of all kinds and of any material, at most
  /// `most` (a mesh counts as one) and `most_materials`; emitting shapes, point lights and an image
  /// around the scene, at most `most` in all; constant light from around; independent and Sobol'
  /// points. Other scenes go to the scalar path tracer.
  static bool suits(const carlo::Needs& needs, const carlo::Scene& scene);

  explicit LaneScene(const carlo::Scene& scene);

  /// True if there are too many surfaces to test one by one. Then the trees find parallelograms,
  /// disks and spheres, and there are no boxes.
  bool many = false;
  LaneTree quad_tree, disk_tree, sphere_tree;
  std::size_t room, light_room;  ///< entries of a column of surfaces, and of lights

  /// Solid i has the numbers from i * sides on, one for each side in the order of LaneBox::faces.
  /// The enclosure, if there is one, follows with the numbers that it uses; then other
  /// parallelograms, disks, spheres, signed distance functions and meshes.
  std::vector<LaneBox> solids;
  LaneBox enclosure;
  bool enclosed = false, camera_inside = false;
  std::uint32_t first_quad = 0, first_disk = 0, first_sphere = 0, first_sdf = 0, first_mesh = 0;
  std::uint32_t surfaces = 0;  ///< one past the last
  std::vector<LaneSdf> sdfs;
  std::unique_ptr<carlo::MeshTracer> meshes;          ///< null if there are none
  std::vector<std::optional<MeshLight>> mesh_lights;  ///< for each mesh: points on it if it emits

  /// For a parallelogram, or the square around a disk: the plane n p = d with unit normal n.
  Column<float> nx{room}, ny{room}, nz{room}, d{room};
  /// a p - a0 and b p - b0 run from -1 to 1 across it.
  Column<float> ax{room}, ay{room}, az{room}, a0{room}, bx{room}, by{room}, bz{room}, b0{room};
  /// For a sphere; its normal is (p - center) / radius, where radius < 0 if it is flipped.
  Column<float> cx{room}, cy{room}, cz{room}, radius{room};
  Column<float> width{room};  ///< twice |radius|
  /// The size of coordinates that rounding errors are relative to: |d|, or |center|_1 + |radius|
  /// for a sphere.
  Column<float> coordinates{room};
  /// Parallelograms of one plane have the same number here, and the same n and d but for a sign;
  /// each sphere has its own. A ray never meets the plane that it starts on. These differ from the
  /// surfaces' numbers only if some plane (`coplanar`) is shared by a light or by something that is
  /// not a side of a box.
  Column<std::uint32_t> plane{room};
  bool coplanar = false;
  /// For a parallelogram outside boxes: one past the last of the consecutive numbers from here on
  /// that share its plane.
  Column<std::uint32_t> run_end{room};
  Column<std::uint32_t> turned{
      room};  ///< true if its normal is opposite to that of the row's first
  /// Patches: a few parallelograms of a row that lie together (lane_plan.h). For the first of each:
  /// one past the last number, and the middle and half size of a rectangle around the patch, in the
  /// coordinates (a, b) of the row's first.
  Column<std::uint32_t> patch_end{room};
  Column<float> patch_a{room}, patch_b{room}, patch_half_a{room}, patch_half_b{room};
  /// True if a parallelogram or a sphere outside boxes comes so close to another surface that
  /// rounding may put an origin on one beyond the other.
  bool touching = false;
  Column<std::uint32_t> material{room};
  Column<float> le_r{room}, le_g{room}, le_b{room};
  /// The density per area of the points that light sampling draws there once it has chosen this
  /// light; 0: no light. For a sphere that emits outwards (`by_direction`) 1 / (2 pi), since
  /// directions are drawn instead. For a mesh only if it is one triangle; otherwise MeshLight knows
  /// it.
  Column<float> light_density{room};
  Column<std::uint32_t> light_of{room};  ///< the number of the light that a surface is
  /// The density, per area and pi, of the points where light paths start: uniform over each
  /// light's area.
  Column<float> emission{room};

  /// Reflection properties of the surface: kd / pi, ks (n + 2) / (2 pi). `diffuse` is the share of
  /// kd in kd + ks.
  std::uint32_t materials = 0;
  MaterialColumn<float> kd_r{}, kd_g{}, kd_b{}, ks_r{}, ks_g{}, ks_b{}, exponent{}, diffuse{};
  MaterialColumn<std::uint32_t> two_sided{};  ///< true for glass
  /// ks is a mirror's reflectance. `ior` is the index inside glass over that outside, 0 for other
  /// materials.
  MaterialColumn<std::uint32_t> specular{};  ///< mirrors and glass
  MaterialColumn<float> ior{};
  bool any_specular = false;
  bool smooth = false;  ///< some meshes have vertex normals

  std::uint32_t lights = 0;
  std::uint32_t first_point = 0;  ///< among the lights: point lights are no surfaces,
  std::uint32_t sky_light = 0;    ///< nor is the image (`sky`), if there is one
  LaneLights choice;              ///< how they are chosen
  /// Light i: its surface's number; corner and edges of a parallelogram, center and radii of a
  /// disk, position of a point.
  Column<float> lx{light_room}, ly{light_room}, lz{light_room}, lux{light_room}, luy{light_room},
      luz{light_room}, lvx{light_room}, lvy{light_room}, lvz{light_room};
  Column<std::uint32_t> light_surface{light_room};
  /// For a point light: its intensity, and the probability that a path starts there over 4 pi.
  Column<float> intensity_r{light_room}, intensity_g{light_room}, intensity_b{light_room},
      point_emission{light_room};
  /// The radiance of the brightest light; for a point, its irradiance on a surface a thousandth of
  /// the scene away.
  double brightest = 0;

  /// The unit of splats for this many light paths; leaves room for pixels 2^13 times as bright
  /// as `brightest`.
  double splat_unit(std::uint64_t paths) const;

  float environment[3] = {0, 0, 0};
  /// The environment map, and a distance that is beyond all surfaces.
  std::optional<EnvmapTable> sky;
  float sky_far = 0;
  bool sobol = false;  ///< otherwise independent points
  bool phong = false, one_sided = false;

  /// True if pixels see no other lights directly than parallelograms outside boxes.
  bool flat_lights = false;
  bool sphere_lights = false, disk_lights = false, any_mesh_light = false;

  bool disks() const { return first_sphere > first_disk; }
  bool point_lights() const { return lights > first_point; }
  /// True if some lights are no surfaces.
  bool other_lights() const { return point_lights() || sky; }
  /// True if there are lights where paths may start. Light paths know no vertex normals, which
  /// make a BRDF and its reverse differ.
  bool has_path_starts() const { return !smooth && lights > (sky ? 1u : 0u); }
  bool spheres() const { return first_sdf > first_sphere; }
  /// True if some surfaces are tested one by one, after all others.
  bool searched() const { return !sdfs.empty() || meshes != nullptr; }
  /// True if the scene needs Features::close, or Features::full.
  bool close() const { return spheres() || touching || coplanar; }
  /// True if pixels can share what paths find from their second vertices on: diffuse surfaces
  /// alone.
  bool can_share() const { return !phong && !any_specular && sdfs.empty(); }
  bool full() const {
    return any_specular || sphere_lights || disks() || other_lights() || searched() || many ||
           choice.many();
  }
  /// True if the first surfaces of paths need nothing that only full code has: which lights emit
  /// there, and what reflects, does not matter.
  bool straight() const { return !(disks() || searched() || many || sky); }
};

}  // namespace renderer
