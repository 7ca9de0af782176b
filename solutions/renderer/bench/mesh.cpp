#include "mesh.h"

#include "support/atomic_file.h"

#include <fmt/core.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace bench {
namespace {

template <class T>
void append(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Rings of corners between two poles.
struct Ball {
  int rings, slices;

  int corners() const { return rings * slices + 2; }
  int triangles() const { return 2 * rings * slices; }
  int corner(int ring, int slice) const { return ring * slices + slice % slices; }
  int pole(bool lower) const { return rings * slices + (lower ? 1 : 0); }
};

void append_corner(std::string& bytes, double theta, double phi) {
  const double r =
      1 + 0.04 * std::sin(7 * theta) * std::cos(9 * phi) + 0.01 * std::sin(31 * phi + 23 * theta);
  append(bytes, static_cast<float>(r * std::sin(theta) * std::cos(phi)));
  append(bytes, static_cast<float>(r * std::cos(theta)));
  append(bytes, static_cast<float>(r * std::sin(theta) * std::sin(phi)));
}

void append_triangle(std::string& bytes, int a, int b, int c) {
  append(bytes, std::uint8_t{3});
  for (const int corner : {a, b, c})
    append(bytes, static_cast<std::int32_t>(corner));
}

std::string ply(const Ball& ball) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      ball.corners(), ball.triangles());
  using std::numbers::pi;
  for (int ring = 0; ring < ball.rings; ++ring) {
    for (int slice = 0; slice < ball.slices; ++slice)
      append_corner(bytes, pi * (ring + 1) / (ball.rings + 1), 2 * pi * slice / ball.slices);
  }
  append_corner(bytes, 0, 0);
  append_corner(bytes, pi, 0);
  for (int slice = 0; slice < ball.slices; ++slice) {
    append_triangle(bytes, ball.pole(false), ball.corner(0, slice + 1), ball.corner(0, slice));
    append_triangle(bytes, ball.pole(true), ball.corner(ball.rings - 1, slice),
                    ball.corner(ball.rings - 1, slice + 1));
    for (int ring = 0; ring + 1 < ball.rings; ++ring) {
      const int a = ball.corner(ring, slice), b = ball.corner(ring, slice + 1);
      const int c = ball.corner(ring + 1, slice), d = ball.corner(ring + 1, slice + 1);
      append_triangle(bytes, a, b, d);
      append_triangle(bytes, a, d, c);
    }
  }
  return bytes;
}

}  // namespace

std::filesystem::path write_ball_scene(const std::filesystem::path& folder, int triangles) {
  const int rings = std::max(1, static_cast<int>(std::sqrt(triangles / 4.0)));
  const Ball ball{rings, std::max(3, triangles / (2 * rings))};
  const std::string name = fmt::format("ball_{}", ball.triangles());
  carlo::write_file(folder / (name + ".ply"), ply(ball));
  std::filesystem::path scene = folder / (name + ".xml");
  carlo::write_file(scene, fmt::format(R"(<scene version="0.6.0">
<integrator type="path"><integer name="maxDepth" value="4"/></integrator>
<sensor type="perspective"><float name="fov" value="40"/>
<transform name="toWorld"><lookat origin="0, 1, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
<sampler type="sobol"><integer name="sampleCount" value="4"/></sampler>
<film type="hdrfilm"><integer name="width" value="128"/><integer name="height" value="128"/>
<rfilter type="box"/></film></sensor>
<bsdf type="twosided" id="white"><bsdf type="diffuse"><rgb name="reflectance" value="0.7"/></bsdf>
</bsdf>
<shape type="ply"><string name="filename" value="{}.ply"/><ref id="white"/></shape>
<shape type="rectangle"><transform name="toWorld"><rotate x="1" angle="90"/>
<translate y="3"/></transform>
<emitter type="area"><rgb name="radiance" value="8"/></emitter></shape>
</scene>
)",
                                       name));
  return scene;
}

}  // namespace bench
