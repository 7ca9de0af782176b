// Tests the proving ground's own parts: its closed forms, and the files that it writes. Random only
// in the last test, whose seeds are fixed; see proving_test.cpp.

#include "closed_forms.h"
#include "proving/ground.h"
#include "proving/irradiance.h"
#include "proving/readings.h"
#include "proving/scene_xml.h"
#include "scene/load_scene.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace proving;

/// The largest difference of two vectors' coordinates, relative to the larger.
float difference(const carlo::Vec3& a, const carlo::Vec3& b) {
  return glm::length(a - b) / std::max({glm::length(a), glm::length(b), 1e-30f});
}

/// Checks that shapes are the same up to rounding and the scene's position.
void check_shape(const carlo::Shape& a, const carlo::Shape& b, const carlo::Vec3& moved) {
  REQUIRE(a.geometry.index() == b.geometry.index());
  CHECK(difference(a.radiance, b.radiance) < 1e-5f);
  if (const auto* s = std::get_if<carlo::Parallelogram>(&a.geometry)) {
    const auto& t = std::get<carlo::Parallelogram>(b.geometry);
    CHECK(glm::length(s->origin - moved - t.origin) <=
          1e-5f * (glm::length(t.origin) + glm::length(t.u) + glm::length(t.v)));
    CHECK(difference(s->u, t.u) < 1e-5f);
    CHECK(difference(s->v, t.v) < 1e-5f);
  }
  if (const auto* s = std::get_if<carlo::Sphere>(&a.geometry)) {
    const auto& t = std::get<carlo::Sphere>(b.geometry);
    CHECK(glm::length(s->center - moved - t.center) <= 1e-5f * (glm::length(t.center) + t.radius));
    CHECK(std::abs(s->radius / t.radius - 1) < 1e-5f);
    CHECK(s->flipped == t.flipped);
  }
  if (const auto* s = std::get_if<carlo::Disk>(&a.geometry))
    CHECK(difference(s->normal, std::get<carlo::Disk>(b.geometry).normal) < 1e-5f);
}

std::filesystem::path scratch_folder(const char* name) {
  return std::filesystem::temp_directory_path() /
         (std::string(name) + "." + std::to_string(::getpid()));
}

}  // namespace

TEST_CASE("The proving ground's closed forms agree with Lambert's formula") {
  // Each of them is a polygon, or nearly; for a ball that of the disk that hides it.
  constexpr int corners = 2000;
  std::vector<glm::dvec3> circle, tilted;
  for (int i = 0; i < corners; ++i) {
    const double phi = 2 * closed_forms::pi * i / corners;
    circle.emplace_back(.5 + std::cos(phi), 1, std::sin(phi));
    // Around the axis at 50 degrees, the cone of sin = 1/2.
    const double s = std::sin(50 * closed_forms::pi / 180),
                 c = std::cos(50 * closed_forms::pi / 180);
    const glm::dvec3 axis(-s, c, 0), x(c, s, 0), z(0, 0, 1);
    tilted.push_back(axis + (x * std::cos(phi) + z * std::sin(phi)) / std::sqrt(3.0));
  }
  const auto near = [](double a, double b) { return std::abs(a / b - 1) < 1e-5; };
  CHECK(near(polygon_irradiance(circle), closed_forms::disk_irradiance(1, 1, .5)));
  CHECK(near(polygon_irradiance(tilted),
             closed_forms::sphere_irradiance(2, 50 * closed_forms::pi / 180)));
  CHECK(near(polygon_irradiance({{-.5, 1, -.5}, {-.5, 1, .5}, {.5, 1, .5}, {.5, 1, -.5}}),
             4 * closed_forms::rectangle_irradiance(.5, .5)));
  CHECK(near(polygon_irradiance({{-1, 0, -.5}, {-1, 0, .5}, {-1, 1, .5}, {-1, 1, -.5}}),
             2 * closed_forms::perpendicular_irradiance(2, 2)));
  // A very wide square covers half a sphere of directions.
  CHECK(near(rectangle_solid_angle(1e9, 1e9, 1), 2 * closed_forms::pi));
  CHECK(near(rectangle_solid_angle(1, 1, 1), 4 * closed_forms::pi / 6));
}

TEST_CASE("Scenes that fail are written as they are") {
  const auto folder = scratch_folder("carlo_proving_files");
  for (const Proof& proof : proving_ground()) {
    if (hash_of(proof.name) % 32 != 0) continue;
    INFO(proof.name);
    const carlo::Scene& scene = proof.scene;
    const carlo::Scene read = carlo::load_scene(write_scene(scene, folder, "scene", proof.name));
    REQUIRE(read.shapes.size() == scene.shapes.size());
    CHECK(read.max_depth == scene.max_depth);
    CHECK(read.lights.environment == scene.lights.environment);
    CHECK(read.lights.points.size() == scene.lights.points.size());
    CHECK(difference(read.camera.right, scene.camera.right) < 1e-5f);
    CHECK(difference(read.camera.forward, scene.camera.forward) < 1e-5f);
    CHECK(std::abs(read.camera.tan_half_x / scene.camera.tan_half_x - 1) < 1e-5f);
    // A scene far from the origin is moved there when it is loaded.
    const carlo::Vec3 moved = read.camera.origin - scene.camera.origin;
    for (std::size_t i = 0; i < read.shapes.size(); ++i)
      check_shape(read.shapes[i], scene.shapes[i], moved);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("Rooms far from the origin are dark when read from a file") {
  // "leak/box" and "leak/sphere" of the proving ground must be as dark as if they were at the
  // origin.
  const auto folder = scratch_folder("carlo_proving_far");
  std::vector<Finding> findings;
  int rooms = 0;
  for (const Proof& proof : proving_ground()) {
    const auto has = [&](const char* part) { return proof.name.find(part) != std::string::npos; };
    if (!has("leak/") || !has("shift=10") || has("edge to edge")) continue;
    Proof near = proof;
    near.scene = carlo::load_scene(write_scene(proof.scene, folder, "room", proof.name));
    near.scene.sampler = carlo::SamplerKind::independent;
    near.rounding = 0;
    judge_exact(near, read_film(near.scene, near.spp, hash_of(near.name)), findings);
    ++rooms;
  }
  std::filesystem::remove_all(folder);
  CHECK(rooms >= 40);
  for (const Finding& finding : findings)
    fmt::print("  {} from a file: {}\n", finding.name, finding.line);
  CHECK(findings.empty());
}
