// Meshes with vertex normals against closed forms. Each mean must lie within 4 standard errors, and
// the standard error must be below .5 %; seeds are fixed.

#include "renderer/lanes/lane_kernel.h"
#include "scene/duplicates.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace scene_tools;

using std::numbers::pi;

RenderResult render_by(renderer::Kernel kernel, const Scene& scene, std::uint32_t spp) {
  const auto integrator =
      renderer::make_path_integrator(scene, {.seed = 1, .spp = spp, .kernel = kernel});
  const bool vector = integrator->name().starts_with("vector");
  CHECK(vector == (kernel == renderer::Kernel::best && renderer::lanes_suit_machine()));
  return render(*integrator, scene.width, scene.height,
                {.spp = spp, .threads = 0, .progress = false});
}

constexpr std::array kernels{renderer::Kernel::best, renderer::Kernel::scalar};

void check_mean(const Scene& scene, double exact) {
  for (const renderer::Kernel kernel : kernels) {
    const RenderResult result = render_by(kernel, scene, 4096);
    const MeanRadiance mean = mean_radiance(result.film);
    INFO((kernel == renderer::Kernel::best ? "vector: " : "scalar: ")
         << result.counts.cut << " cut; " << mean.value[0] << " +- " << mean.standard_error[0]
         << " for " << exact);
    CHECK(result.counts.bad == 0);
    CHECK(std::abs(mean.value[0] - exact) <= 4 * mean.standard_error[0] + 2e-4 * exact);
    CHECK(mean.standard_error[0] <= 0.005 * exact);
  }
}

/// A square sheet of half side `size` in z = 0 with these vertex normals at its corners (-, -),
/// (+, -), (+, +), (-, +); seen from `height` above, at (x, y), through a pinhole so narrow that
/// all rays are one.
Scene sheet(const std::vector<Vec3>& normals, float size, Vec2 at = Vec2(0)) {
  Scene scene;
  scene.width = scene.height = 4;
  scene.sampler = SamplerKind::independent;
  scene.camera = look_at(size * Vec3(at.x, at.y, 3), size * Vec3(at.x, at.y, 0), {0, 1, 0}, 0.01f);
  Mesh mesh;
  mesh.positions = {{-size, -size, 0}, {size, -size, 0}, {size, size, 0}, {-size, size, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const Vec3 n : normals)
    mesh.normals.push_back(glm::normalize(n));
  mesh.normals_of = mesh.triangles;
  scene.shapes = {{mesh}};
  return scene;
}

Vec3 tilted(double angle) {
  return {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
}

/// A ball of triangles whose vertex normals are those of the sphere around it.
Mesh ball(float radius) {
  constexpr std::uint32_t rings = 12, sectors = 24;
  Mesh mesh;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    for (std::uint32_t k = 0; k < sectors; ++k) {
      const double theta = pi * i / rings, phi = 2 * pi * k / sectors;
      const Vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                   std::cos(theta));
      mesh.normals.push_back(n);
      mesh.positions.push_back(radius * n);
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t k = 0; k < sectors; ++k) {
      const std::uint32_t a = i * sectors + k, b = i * sectors + (k + 1) % sectors;
      if (i > 0) mesh.triangles.push_back({a, a + sectors, b});
      if (i + 1 < rings) mesh.triangles.push_back({b, a + sectors, b + sectors});
    }
  }
  mesh.normals_of = mesh.triangles;
  return mesh;
}

}  // namespace

TEST_CASE("Vertex normals: a tilted lobe loses what lies below the triangle") {
  // Of a cosine lobe that is tilted by an angle a, (1 + cos a)/2 lies above.
  for (const float size : {1e-4f, 1.0f, 1e6f}) {
    for (const double angle : {0.0, 0.3, 1.0, 1.5}) {
      INFO("half side " << size << ", tilted by " << angle);
      Scene scene = sheet(std::vector<Vec3>(4, tilted(angle)), size);
      scene.lights.environment = Rgb(1);
      scene.materials = {{Diffuse{Rgb(0.8f)}, false}};
      check_mean(scene, 0.8 * (1 + std::cos(angle)) / 2);
      // From behind, with the same normals and with opposite ones.
      scene.camera = look_at(size * Vec3(0, 0, -3), Vec3(0), {0, 1, 0}, 0.01f);
      scene.materials = {{Diffuse{Rgb(0.8f)}, true}};
      check_mean(scene, 0.8 * (1 + std::cos(angle)) / 2);
      for (Vec3& n : std::get<Mesh>(scene.shapes[0].geometry).normals)
        n = -n;
      check_mean(scene, 0.8 * (1 + std::cos(angle)) / 2);
    }
  }
}

TEST_CASE("Vertex normals: interpolated between the corners") {
  // A far point light: rho/pi I cos/d^2, or nothing from behind the sheet.
  const std::vector<Vec3> normals = {{1, 0, 1}, {0, 1, 2}, {-1, -1, 3}, {0.5f, 0, 1}};
  const glm::dvec3 light(300, 0, 400);
  for (const Vec2 at : {Vec2(0.5f, -0.6f), Vec2(-0.7f, 0.1f), Vec2(0.1f, 0.9f)}) {
    // Barycentric coordinates: the triangles are below and above the diagonal x = y.
    const double x = (at.x + 1) / 2, y = (at.y + 1) / 2;
    const auto n = [&](std::size_t i) { return glm::normalize(glm::dvec3(normals[i])); };
    const glm::dvec3 smooth = glm::normalize(x > y ? (1 - x) * n(0) + (x - y) * n(1) + y * n(2)
                                                   : (1 - y) * n(0) + x * n(2) + (y - x) * n(3));
    const glm::dvec3 way = light - glm::dvec3(at.x, at.y, 0);
    Scene scene = sheet(normals, 1, at);
    scene.materials = {{Diffuse{Rgb(0.5f)}, false}};
    scene.lights.points = {{Vec3(light), Rgb(1e6f)}};
    const double d2 = glm::dot(way, way), cosine = glm::dot(smooth, way) / std::sqrt(d2);
    check_mean(scene, 0.5 / pi * 1e6 * std::max(0.0, cosine) / d2);
    scene.lights.points[0].position.z = -1;
    for (const renderer::Kernel kernel : kernels)
      CHECK(mean_radiance(render_by(kernel, scene, 64).film).value[0] == 0);
  }
}

TEST_CASE("Vertex normals: mirrors and glass lose nothing in a furnace") {
  for (const float size : {1e-3f, 1.0f, 1e5f}) {
    Scene scene;
    scene.width = scene.height = 16;
    scene.sampler = SamplerKind::independent;
    scene.camera = look_at({0, size, 4 * size}, {0, 0, 0}, {0, 1, 0}, 24);
    scene.lights.environment = Rgb(1);
    scene.shapes = {{ball(size)}};
    scene.materials = {{Dielectric{1.5f, 1}, false}};
    check_mean(scene, 1);
    scene.materials = {{Mirror{Rgb(1)}, false}};
    check_mean(scene, 1);
  }
}

/// A ball of the material over a floor, under a rectangle, a point, a small ball and the sky, which
/// all emit.
Scene ball_in_light(const Material& material) {
  Scene scene;
  scene.width = scene.height = 32;
  scene.sampler = SamplerKind::independent;
  scene.camera = look_at({0, 1, 4}, {0, 0, 0}, {0, 1, 0}, 40);
  scene.lights.environment = Rgb(0.2f);
  scene.lights.points = {{{2, 3, 2}, Rgb(9)}};
  scene.materials = {material, {Diffuse{Rgb(0.6f)}, true}};
  Mesh small = ball(0.3f);
  for (Vec3& p : small.positions)
    p += Vec3(-1, 1, 1);
  scene.shapes = {{ball(1)},
                  {Parallelogram{{-3, -1, -3}, {0, 0, 6}, {6, 0, 0}}, 1},
                  {Parallelogram{{1, 2, -1}, {1, 0, 0}, {0, 0, 1}}, 1, Rgb(5)},
                  {small, 1, Rgb(3)}};
  return scene;
}

struct Difference {
  double z = 0, error = 0;  ///< the largest of |z| and of the relative standard error
};

/// Compares two images of 32 x 32 pixels by their four quarters and three channels.
Difference compare(const Film& a, const Film& b) {
  Difference most;
  for (std::size_t part = 0; part < 12; ++part) {
    const int x0 = part % 2 == 0 ? 0 : 16, y0 = part / 2 % 2 == 0 ? 0 : 16;
    const std::size_t channel = part / 4;
    double difference = 0, sum = 0, variance = 0;
    for (int y = y0; y < y0 + 16; ++y) {
      for (int x = x0; x < x0 + 16; ++x) {
        difference += a.mean(x, y, channel) - b.mean(x, y, channel);
        sum += b.mean(x, y, channel);
        variance += a.variance(x, y, channel) + b.variance(x, y, channel);
      }
    }
    most.z = std::max(most.z, std::abs(difference) / std::sqrt(variance));
    most.error = std::max(most.error, std::sqrt(variance) / sum);
  }
  return most;
}

TEST_CASE("Vertex normals: both kernels agree with all materials and lights") {
  // 36 comparisons: the chance that some |z| of two right renderers exceeds 4.5 is 2.5e-4. A
  // difference of 4 % is seen with certainty, one of 2 % in half of all cases.
  const std::vector<Material> materials = {{Phong{Rgb(0.4f), Rgb(0.5f), 40}, true},
                                           {Mirror{Rgb(0.9f)}, true},
                                           {Dielectric{1.5f, 1}, false}};
  for (const Material& material : materials) {
    const Scene scene = ball_in_light(material);
    const Difference most =
        compare(render_by(kernels[0], scene, 1024).film, render_by(kernels[1], scene, 1024).film);
    INFO("material " << material.model.index() << ": |z| up to " << most.z);
    CHECK(most.z < 4.5);
    CHECK(most.error < 0.005);
  }
}

TEST_CASE("Vertex normals: light paths are refused, and never chosen") {
  const Scene scene = ball_in_light({Diffuse{Rgb(0.5f)}, true});
  CHECK_FALSE(renderer::light_paths_suit(scene));
  using enum renderer::Technique;
  CHECK_THROWS_WITH(renderer::make_path_integrator(scene, {.technique = bidirectional}),
                    Catch::Matchers::ContainsSubstring("light paths do not know vertex normals"));
  CHECK(renderer::make_path_integrator(scene, {.technique = automatic})->light_paths() == 0);
}

TEST_CASE("Triangles back to back: a ray meets the one that faces it") {
  // A point below the middle of a square of half side 1 at height 1.5, of radiance 1, that shines
  // both ways; a ray may count for half of the light by MIS, and must meet the right half.
  const double x = 1 / 1.5 / std::sqrt(1 + 1 / (1.5 * 1.5));
  const double exact = 0.5 * 4 / pi * x * std::atan(x);
  for (const float size : {1e-3f, 1.0f, 1e5f}) {
    for (const bool apart : {false, true}) {
      INFO("half side " << size << ", " << (apart ? "two meshes" : "one mesh"));
      Mesh up;
      up.positions = {{-1, -1, 1.5f}, {1, -1, 1.5f}, {1, 1, 1.5f}, {-1, 1, 1.5f}};
      for (Vec3& p : up.positions)
        p *= size;
      up.triangles = {{0, 1, 2}, {0, 2, 3}};
      Mesh down = up;
      down.triangles = {{1, 0, 2}, {2, 0, 3}};
      Scene scene;
      scene.width = scene.height = 4;
      scene.max_depth = 2;
      scene.sampler = SamplerKind::independent;
      scene.camera = look_at({3 * size, 0, size}, {0, 0, 0}, {0, 1, 0}, 0.01f);
      scene.materials = {{Diffuse{Rgb(0.5f)}, false}};
      scene.shapes = {
          {Parallelogram{{-5 * size, -5 * size, 0}, {10 * size, 0, 0}, {0, 10 * size, 0}}}};
      if (apart) {
        scene.shapes.push_back({up, 0, Rgb(1)});
        scene.shapes.push_back({down, 0, Rgb(1)});
      } else {
        for (const glm::uvec3 t : down.triangles)
          up.triangles.push_back(t);
        scene.shapes.push_back({up, 0, Rgb(1)});
      }
      mark_back_to_back(scene);
      check_mean(scene, exact);
      // Glass is met from both sides.
      scene.materials = {{Dielectric{1.5f, 1}, false}};
      for (Shape& shape : scene.shapes)
        if (auto* mesh = std::get_if<Mesh>(&shape.geometry)) mesh->back_to_back.clear();
      mark_back_to_back(scene);
      CHECK(std::get<Mesh>(scene.shapes.back().geometry).back_to_back.empty());
    }
  }
}
