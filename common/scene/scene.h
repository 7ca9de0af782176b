#pragma once

#include "numeric/vec.h"
#include "scene/camera.h"
#include "scene/envmap.h"
#include "scene/sdf.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace carlo {

// Materials ---------------------------------------------------------------------------------------

/// f = reflectance / pi.
struct Diffuse {
  Rgb reflectance{0.5f};
  bool operator==(const Diffuse&) const = default;
};

/// Lafortune and Willems' modified Phong: f = kd/pi + ks (n+2)/(2 pi) cos^n alpha, with
/// kd + ks <= 1 in every channel (checked at load).
struct Phong {
  Rgb kd{0.5f};
  Rgb ks{0.2f};
  float exponent = 30;
  bool operator==(const Phong&) const = default;
};

/// A perfect mirror.
struct Mirror {
  Rgb reflectance{1};
  bool operator==(const Mirror&) const = default;
};

/// Smooth glass: Fresnel reflection and refraction between two media. The normal points into the
/// medium with `ext_ior`.
struct Dielectric {
  float int_ior = 1.5046f;
  float ext_ior = 1.000277f;
  bool operator==(const Dielectric&) const = default;
};

struct Material {
  std::variant<Diffuse, Phong, Mirror, Dielectric> model = Diffuse{};
  /// A one-sided surface is black on its back, the side that its normal points away from.
  bool two_sided = false;
  bool operator==(const Material&) const = default;
};

// Shapes ------------------------------------------------------------------------------------------

/// The points origin + a u + b v for a, b in [0, 1]; the normal is u x v.
struct Parallelogram {
  Vec3 origin, u, v;
};

/// The normal points outwards, inwards if `flipped`.
struct Sphere {
  Vec3 center;
  float radius;
  bool flipped = false;
};

struct Disk {
  Vec3 center, normal;  ///< normal of length 1
  float radius;
};

/// Triangles, which are counter-clockwise as seen from outside.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<glm::uvec3> triangles;
  /// Unit vertex normals, and those of each triangle's corners: x is `flat` for a triangle without.
  /// Both are empty if no triangle has any.
  std::vector<Vec3> normals = {};
  std::vector<glm::uvec3> normals_of = {};
  /// True for triangles that lie exactly on another one of the scene that faces the other way
  /// (mark_back_to_back()); empty if there are none. A ray meets the one that faces it.
  std::vector<char> back_to_back = {};
  static constexpr std::uint32_t flat = 0xFFFFFFFF;
};

struct Shape {
  std::variant<Parallelogram, Sphere, Disk, Mesh, Sdf> geometry;
  std::uint32_t material = 0;  ///< index into Scene::materials
  Rgb radiance{0};             ///< emitted on the side of the normal; 0 for most shapes, and always
                               ///< for Sdfs
  bool emits() const { return radiance != Rgb(0); }
};

// Lights that are not shapes ----------------------------------------------------------------------

struct PointLight {
  Vec3 position;
  Rgb intensity;  ///< W/sr
};

/// Code that handles these takes the struct apart by structured bindings, so that adding a kind is
/// a compile error wherever it is not handled.
struct OtherLights {
  std::vector<PointLight> points;
  Rgb environment{0};            ///< constant radiance from every direction that meets no shape
  std::optional<Envmap> envmap;  ///< the same with a radiance for each direction
};

// The scene ---------------------------------------------------------------------------------------

enum class SamplerKind { independent, stratified, sobol };

struct Scene {
  Camera camera;
  int width = 256, height = 256;
  int spp = 64;
  SamplerKind sampler = SamplerKind::sobol;
  /// The longest path, in segments from the camera (1: emission only, 2: direct light); 0 for no
  /// limit.
  int max_depth = 0;
  std::vector<Material> materials;
  std::vector<Shape> shapes;
  OtherLights lights;
  std::vector<std::string> notes;  ///< harmless facts about the file for reports
};

}  // namespace carlo
