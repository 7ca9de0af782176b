// The scenes that `./carlo bench` gives to Blender, and its judgement of the results;
// bench_parts_test.sh runs it.

#include "random/rng.h"
#include "renderer/bench/agreement.h"
#include "renderer/bench/peer_scene.h"
#include "scene_tools.h"
#include "support/error.h"

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <limits>

namespace {

using namespace scene_tools;
using nlohmann::json;

/// A one-sided light over a mesh of one triangle, coordinates up to 40.
Scene light_over_triangle() {
  Scene scene;
  scene.camera = look_at({1, 2, 40}, {1, 2, 0}, {0, 1, 0}, 40);
  scene.materials = {{Diffuse{{.5f, .25f, .125f}}, true}, {Diffuse{Rgb(.75f)}, false}};
  Mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 0, -4}}, {{0, 1, 2}}};
  scene.shapes.push_back({mesh, 0, Rgb(0)});
  scene.shapes.push_back({Parallelogram{{0, 8, 0}, {2, 0, 0}, {0, 0, 2}}, 1, {3, 2, 1}});
  return scene;
}

Vec3 vec(const json& v) {
  return {v.at(0), v.at(1), v.at(2)};
}

/// The normal of a mesh's first face, by its first three corners.
Vec3 normal(const json& mesh) {
  const json& face = mesh.at("faces").at(0);
  const auto corner = [&](std::size_t i) {
    return vec(mesh.at("positions").at(face.at(i).get<std::size_t>()));
  };
  return glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

TEST_CASE("Cycles gets our corners, scaled by a power of two below 1, facing as ours do") {
  const json spec = bench::peer_scene(light_over_triangle(), bench::Peer::cycles);
  REQUIRE(spec.at("meshes").size() == 2);
  const json &triangle = spec.at("meshes").at(0), &light = spec.at("meshes").at(1);
  // The camera's 40 is the largest coordinate: 40 / 64 lies in [1/2, 1).
  CHECK(vec(spec.at("camera").at("origin")) == Vec3(1, 2, 40) / 64.0f);
  CHECK(vec(triangle.at("positions").at(1)) == Vec3(4, 0, 0) / 64.0f);
  CHECK(normal(triangle) == Vec3(0, 1, 0));
  REQUIRE(light.at("positions").size() == 4);
  CHECK(vec(light.at("positions").at(2)) == Vec3(2, 8, 2) / 64.0f);
  CHECK(light.at("faces") == json::parse("[[0, 1, 2, 3]]"));
  CHECK(normal(light) == Vec3(0, -1, 0));
}

TEST_CASE("Cycles gets our radiances and reflectances as they are, and our camera") {
  const Scene scene = light_over_triangle();
  const json spec = bench::peer_scene(scene, bench::Peer::cycles);
  const json& light =
      spec.at("materials").at(spec.at("meshes").at(1).at("material").get<std::size_t>());
  CHECK(vec(light.at("radiance")) == Rgb(3, 2, 1));
  CHECK(vec(light.at("reflectance")) == Rgb(.75f));
  CHECK(light.at("two_sided") == false);
  const json& under =
      spec.at("materials").at(spec.at("meshes").at(0).at("material").get<std::size_t>());
  CHECK(vec(under.at("radiance")) == Rgb(0));
  CHECK(vec(under.at("reflectance")) == Rgb(.5f, .25f, .125f));
  CHECK(under.at("two_sided") == true);
  CHECK(vec(spec.at("camera").at("right")) == Vec3(1, 0, 0));
  CHECK(vec(spec.at("camera").at("up")) == Vec3(0, 1, 0));
  CHECK(vec(spec.at("camera").at("forward")) == Vec3(0, 0, -1));
  CHECK(spec.at("camera").at("tan_half_x").get<float>() == scene.camera.tan_half_x);
}

TEST_CASE("Shapes of one material and radiance share Cycles' material") {
  Scene scene = light_over_triangle();
  scene.shapes.push_back(scene.shapes.back());
  scene.shapes.push_back(scene.shapes.back());
  scene.shapes.back().radiance = Rgb(5);
  const json spec = bench::peer_scene(scene, bench::Peer::cycles);
  CHECK(spec.at("materials").size() == 3);
  CHECK(spec.at("meshes").at(1).at("material") == spec.at("meshes").at(2).at("material"));
  CHECK(spec.at("meshes").at(1).at("material") != spec.at("meshes").at(3).at("material"));
}

TEST_CASE("Cycles' bounces are our segments without the camera's and the light's") {
  Scene scene = light_over_triangle();
  const auto bounces = [&](int depth) {
    scene.max_depth = depth;
    return bench::peer_scene(scene, bench::Peer::cycles).at("bounces").get<int>();
  };
  CHECK(bounces(2) == 0);
  CHECK(bounces(5) == 3);
  CHECK(bounces(0) == 1024);
  CHECK(bounces(1) == 0);
  // Direct light is Cycles' minimum; where our scene has none, nothing reflects.
  const json spec = bench::peer_scene(scene, bench::Peer::cycles);
  REQUIRE(!spec.at("materials").empty());
  for (const json& material : spec.at("materials"))
    CHECK(vec(material.at("reflectance")) == Rgb(0));
}

TEST_CASE("Scenes that Cycles has no exact equal of are refused with the reason") {
  const auto obstacle = [](auto change) {
    Scene scene = light_over_triangle();
    change(scene);
    CHECK_THROWS_AS(bench::peer_scene(scene, bench::Peer::cycles), Error);
    return bench::obstacle(scene, bench::Peer::cycles).value_or("nothing");
  };
  CHECK(!bench::obstacle(light_over_triangle(), bench::Peer::cycles));
  CHECK(obstacle([](Scene& s) { s.shapes[0].geometry = Sphere{Vec3(0), 1}; }) == "spheres");
  CHECK(obstacle([](Scene& s) { s.shapes[0].geometry = Disk{Vec3(0), {0, 1, 0}, 1}; }) == "disks");
  CHECK(obstacle([](Scene& s) { s.materials[0].model = Phong{}; }) == "Phong's lobes");
  CHECK(obstacle([](Scene& s) { s.materials[0].model = Mirror{}; }) ==
        "surfaces that are not diffuse");
  CHECK(obstacle([](Scene& s) {
          s.lights.points.push_back({Vec3(1), Rgb(1)});
        }) == "a point light");
  CHECK(obstacle([](Scene& s) { s.lights.environment = Rgb(1); }) == "a constant environment");
  CHECK(obstacle([](Scene& s) { s.camera.right = -s.camera.right; }) == "a camera that mirrors");
}

TEST_CASE("Mitsuba gets an environment map: rows from the top, and where its axes point") {
  Scene scene = light_over_triangle();
  Envmap map{Image(2, 1), glm::dmat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0})};
  map.image.pixels = {Rgb(1, 2, 3), Rgb(4, 5, 6)};
  scene.lights.envmap = map;
  CHECK(bench::obstacle(scene, bench::Peer::cycles) == "an environment map");
  CHECK(bench::obstacle(scene, bench::Peer::luxcore) == "an environment map");
  REQUIRE(!bench::obstacle(scene, bench::Peer::mitsuba));
  const json spec = bench::peer_scene(scene, bench::Peer::mitsuba).at("envmap");
  CHECK(spec.at("width") == 2);
  CHECK(spec.at("height") == 1);
  CHECK(spec.at("radiance") == json::parse("[1, 2, 3, 4, 5, 6]"));
  CHECK(vec(spec.at("x")) == Vec3(0, 0, -1));
  CHECK(vec(spec.at("z")) == Vec3(1, 0, 0));
  scene.lights.envmap.reset();
  CHECK(bench::peer_scene(scene, bench::Peer::mitsuba).at("envmap").is_null());
}

// Images of 64 x 64 pixels, brighter to the right, with noise of 10 % a pixel.
constexpr int size = 64;
constexpr float noise = .1f;

Image noisy(std::uint64_t seed, float factor = 1, bool mirrored = false) {
  Rng rng(seed);
  Image image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int from = mirrored ? size - 1 - x : x;
      const float value = .5f + .5f * static_cast<float>(from) / size;
      for (int c = 0; c < 3; ++c) {
        // A uniform number of standard deviation 1.
        const float u = std::sqrt(12.0f) * (static_cast<float>(rng.uniform()) - .5f);
        image.at(x, y)[c] = factor * value * (1 + noise * u);
      }
    }
  }
  return image;
}

std::vector<Image> five(float factor = 1, bool mirrored = false) {
  std::vector<Image> images;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    images.push_back(noisy(seed, factor, mirrored));
  return images;
}

Image reference() {
  return noisy(6);
}

/// The same for all pixels: .75 is about the root mean square of their values.
Image reference_error() {
  Image error(size, size);
  for (Rgb& e : error.pixels)
    e = Rgb(.75f * noise);
  return error;
}

// alpha: 16 tiles' 48 channels and three means beyond 5 standard errors, 3e-5 with other seeds.
TEST_CASE("Images that differ by their noise agree") {
  const bench::Agreement a = bench::agreement(five(), reference(), reference_error());
  CHECK(a.holds());
  CHECK(a.tile_z <= 5);
  CHECK(a.mean_z <= 5);
  CHECK(std::abs(a.mean_ratio - 1) <= .005);
}

// Power: the standard error of a channel's mean difference is .075 / 64 sqrt(1/5 + 1) = .0013, and
// 2 % of .75 is 11 of them, so the limit of 5 is almost certainly exceeded.
TEST_CASE("A scene that is 2 % brighter does not agree") {
  const bench::Agreement a = bench::agreement(five(1.02f), reference(), reference_error());
  CHECK(!a.holds());
  CHECK(a.mean_z > 5);
}

TEST_CASE("A scene that is mirrored does not agree, although the mean is the same") {
  const bench::Agreement a = bench::agreement(five(1, true), reference(), reference_error());
  CHECK(!a.holds());
  CHECK(a.tile_z > 5);
}

TEST_CASE("A pixel that is not a number does not agree") {
  std::vector<Image> images = five();
  images[2].at(3, 4).y = std::numeric_limits<float>::quiet_NaN();
  CHECK(!bench::agreement(images, reference(), reference_error()).holds());
}

TEST_CASE("A difference without any noise does not agree, equal images do") {
  Image black(size, size), grey(size, size);
  for (Rgb& p : grey.pixels)
    p = Rgb(.5f);
  CHECK(!bench::agreement({grey, grey}, black, black).holds());
  CHECK(bench::agreement({grey, grey}, grey, black).holds());
}

TEST_CASE("Agreement wants two images of the reference's size") {
  CHECK_THROWS_AS(bench::agreement({noisy(1)}, reference(), reference_error()), Error);
  CHECK_THROWS_AS(bench::agreement({noisy(1), Image(8, 8)}, reference(), reference_error()), Error);
  CHECK_THROWS_AS(bench::agreement({Image(8, 8), Image(8, 8)}, reference(), reference_error()),
                  Error);
}

TEST_CASE("The reference's noise adds its relative variance to relMSE") {
  Image image(2, 1), error(2, 1);
  image.pixels = {Rgb(0), Rgb(.3f)};
  error.pixels = {Rgb(.1f), Rgb(.1f)};
  // .01 / .01 in the black pixel, .01 / (.09 + .01) in the other.
  CHECK(bench::rel_mse_noise(image, error) == Catch::Approx(.55).epsilon(1e-5));
}

TEST_CASE("Time at an error follows the power law between two measurements and beyond them") {
  const bench::Rung fewer{16, 2, .04}, more{64, 8, .01};
  const bench::Rung same = bench::at_error(fewer, more, .02);
  CHECK(same.samples == Catch::Approx(32));
  CHECK(same.seconds == Catch::Approx(4));
  CHECK(bench::at_error(fewer, more, .08).seconds == Catch::Approx(1));
  CHECK(bench::at_error(fewer, more, .001).seconds == Catch::Approx(80));
  // Errors that fall faster than samples rise: at a quarter of the error twice the time.
  CHECK(bench::at_error({16, 2, .04}, {32, 4, .01}, .02).seconds == Catch::Approx(std::sqrt(8.0)));
}

}  // namespace
