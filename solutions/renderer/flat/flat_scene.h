#pragma once

#include "scene/needs.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>

namespace renderer {

/// A scene of a few parallelograms as the vector kernels read it: an array a property, one element
/// a parallelogram, so that a loop over all of them broadcasts from memory and a lookup by index is
/// a gather.
struct FlatScene {
  static constexpr std::size_t most = 64;
  template <class T>
  using Column = std::array<T, most>;

  /// Whether the kernels can render the scene: parallelograms only, at most `most`, with diffuse
  /// and Phong materials; lights are among them or around them.
  static bool suits(const carlo::Needs& needs);

  explicit FlatScene(const carlo::Scene& scene);

  std::uint32_t quads = 0;
  /// The plane n p = d with unit normal n, and a p, b p: -1 to 1 across the parallelogram.
  Column<float> nx{}, ny{}, nz{}, d{};
  Column<float> ax{}, ay{}, az{}, a0{}, bx{}, by{}, bz{}, b0{};
  /// What the surface does with light. `diffuse` is the chance of the diffuse lobe.
  Column<float> kd_r{}, kd_g{}, kd_b{}, ks_r{}, ks_g{}, ks_b{}, exponent{}, diffuse{};
  Column<std::uint32_t> two_sided{};
  Column<float> le_r{}, le_g{}, le_b{};
  Column<float>
      light_density{};  ///< per area, of the points that light sampling draws; 0: no light

  std::uint32_t lights = 0;
  /// Light i: corner, edges, normal, radiance over its density, its quad, and the running sum of
  /// the chances with which lights are chosen.
  Column<float> lx{}, ly{}, lz{}, lux{}, luy{}, luz{}, lvx{}, lvy{}, lvz{};
  Column<std::uint32_t> light_quad{};
  Column<float> light_cdf{};

  float environment[3] = {0, 0, 0};
  /// A ray may meet a surface this far behind its origin: the origin lies on another surface that
  /// touches it, and is rounded.
  float slack = 0;
  bool phong = false, one_sided = false;
};

}  // namespace renderer
