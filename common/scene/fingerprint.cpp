#include "scene/fingerprint.h"

#include "random/hash.h"

#include <fmt/core.h>

#include <bit>
#include <type_traits>

namespace carlo {
namespace {

/// Digests values one after the other. Structs are taken apart by structured bindings, so that a
/// new member is a compile error here until it is digested too.
class Digest {
 public:
  std::uint64_t value() const { return value_; }

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T x) {
    if constexpr (std::is_same_v<T, float>) {
      put(std::bit_cast<std::uint32_t>(x));
    } else if constexpr (std::is_same_v<T, double>) {
      put(std::bit_cast<std::uint64_t>(x));
    } else {
      put(static_cast<std::uint64_t>(x));
    }
  }

  template <glm::length_t n, class T>
  void add(const glm::vec<n, T>& v) {
    for (glm::length_t i = 0; i < n; ++i)
      add(v[i]);
  }

  template <class T>
  void add(const std::vector<T>& list) {
    add(list.size());
    for (const T& item : list)
      add(item);
  }

  template <class... T>
  void add(const std::variant<T...>& v) {
    add(v.index());
    std::visit([this](const auto& x) { this->add(x); }, v);
  }

  void add(const Camera& camera) {
    const auto& [origin, right, up, forward, axis, half, half_x, half_y] = camera;
    add_all(origin, right, up, forward, half_x, half_y);
    // How the film's sides depend on each other does not affect the image.
    (void)axis, (void)half;
  }

  void add(const Diffuse& m) {
    const auto& [reflectance] = m;
    add(reflectance);
  }
  void add(const Phong& m) {
    const auto& [kd, ks, exponent] = m;
    add_all(kd, ks, exponent);
  }
  void add(const Mirror& m) {
    const auto& [reflectance] = m;
    add(reflectance);
  }
  void add(const Dielectric& m) {
    const auto& [int_ior, ext_ior] = m;
    add_all(int_ior, ext_ior);
  }
  void add(const Material& m) {
    const auto& [model, two_sided] = m;
    add_all(model, two_sided);
  }

  void add(const Parallelogram& s) {
    const auto& [origin, u, v] = s;
    add_all(origin, u, v);
  }
  void add(const Sphere& s) {
    const auto& [center, radius, flipped] = s;
    add_all(center, radius, flipped);
  }
  void add(const Disk& s) {
    const auto& [center, normal, radius] = s;
    add_all(center, normal, radius);
  }
  void add(const Mesh& s) {
    const auto& [positions, triangles, normals, normals_of, back_to_back] = s;
    (void)back_to_back;  // follows from the others
    add_all(positions, triangles);
    // Meshes without vertex normals keep the fingerprint that they had before these existed.
    if (!normals_of.empty()) add_all(normals, normals_of);
  }
  void add(const Sdf& s) {
    const auto& [steps, place, flipped] = s;
    add_all(steps, place, flipped);
  }
  void add(const Shape& s) {
    const auto& [geometry, material, radiance] = s;
    add_all(geometry, material, radiance);
  }
  void add(const PointLight& l) {
    const auto& [position, intensity] = l;
    add_all(position, intensity);
  }
  void add(const OtherLights& l) {
    const auto& [points, environment, envmap] = l;
    add_all(points, environment);
    // Scenes without one keep the fingerprint that they had before envmaps existed.
    if (envmap) add(*envmap);
  }
  void add(const Envmap& map) {
    const auto& [image, rotation] = map;
    const auto& [width, height, pixels] = image;
    add_all(width, height, pixels, rotation[0], rotation[1], rotation[2]);
  }

  void add(const Similarity& s) {
    const auto& [rotation, origin, scale] = s;
    add_all(rotation[0], rotation[1], rotation[2], origin, scale);
  }
  void add(const sdf::Ball& f) {
    const auto& [radius] = f;
    add(radius);
  }
  void add(const sdf::Torus& f) {
    const auto& [major_radius, minor_radius] = f;
    add_all(major_radius, minor_radius);
  }
  void add(const sdf::RoundedBox& f) {
    const auto& [half, radius] = f;
    add_all(half, radius);
  }
  void add(const sdf::Capsule& f) {
    const auto& [a, b, radius] = f;
    add_all(a, b, radius);
  }
  void add(const sdf::Gyroid& f) {
    const auto& [period, thickness] = f;
    add_all(period, thickness);
  }
  void add(const sdf::Solid& s) {
    const auto& [form, place] = s;
    add_all(form, place);
  }
  void add(const sdf::Combine& s) {
    const auto& [operation, smoothing] = s;
    add_all(operation, smoothing);
  }

  template <class... T>
  void add_all(const T&... values) {
    (add(values), ...);
  }

 private:
  void put(std::uint64_t x) { value_ = hash(value_, x); }
  std::uint64_t value_ = 0;
};

}  // namespace

std::string fingerprint(const Scene& scene) {
  const auto& [camera, width, height, spp, sampler, max_depth, materials, shapes, lights, notes] =
      scene;
  (void)spp, (void)notes;
  Digest digest;
  digest.add_all(camera, width, height, sampler, max_depth, materials, shapes, lights);
  return fmt::format("{:016x}", digest.value());
}

}  // namespace carlo
