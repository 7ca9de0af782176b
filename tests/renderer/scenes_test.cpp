// The scenes of common/scenes: all of them load and render without a bad sample; those with a
// closed form agree with it (4 standard errors, as in closed_form_scenes_test.cpp); one of them
// looks the same at every scale.

#include "lab_scenes.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>

#include <cmath>
#include <string>
#include <variant>

namespace {

using namespace scene_tools;

Scene small(const std::string& name, int size) {
  Scene scene = lab_scenes::load(name);
  resize(scene, size, size);
  scene.sampler = SamplerKind::independent;
  return scene;
}

/// The same scene `factor` times as large: radiance does not change.
void enlarge(Scene& scene, float factor) {
  scene.camera.origin *= factor;
  for (Shape& shape : scene.shapes) {
    if (auto* quad = std::get_if<Parallelogram>(&shape.geometry)) {
      quad->origin *= factor;
      quad->u *= factor;
      quad->v *= factor;
    } else if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      sphere->center *= factor;
      sphere->radius *= factor;
    } else if (auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
      for (Vec3& p : mesh->positions)
        p *= factor;
    } else if (auto* sdf = std::get_if<Sdf>(&shape.geometry)) {
      sdf->place.origin *= static_cast<double>(factor);
      sdf->place.scale *= static_cast<double>(factor);
    }
  }
}

}  // namespace

TEST_CASE("Every scene renders, without a sample that is no radiance") {
  REQUIRE(lab_scenes::names().size() >= 13);
  for (const std::string& name : lab_scenes::names()) {
    INFO(name);
    const RenderResult result = render_scene(small(name, 48), 16);
    CHECK(result.counts.bad == 0);
    CHECK(result.counts.cut == 0);
    CHECK(mean_radiance(result.film).value[0] > 0);
  }
}

TEST_CASE("Scenes with a closed form show it") {
  struct Case {
    const char* name;
    double exact;
  };
  for (const Case& c :
       {Case{"furnace", 1}, {"integrating_sphere", 0.8 * 0.04 * 5 / (1 - 0.8 * 0.96)}}) {
    const MeanRadiance mean = mean_radiance(render_scene(small(c.name, 32), 1024).film);
    INFO(c.name << ": " << mean.value[0] << " +- " << mean.standard_error[0] << " for " << c.exact);
    CHECK(std::abs(mean.value[0] - c.exact) <= 4 * mean.standard_error[0]);
    CHECK(mean.standard_error[0] <= 0.002 * c.exact);
  }
}

TEST_CASE("A scene looks the same at every scale from 1e-4 to 1e6") {
  // Independent seeds: means differ only by their standard errors.
  for (const char* name : {"soft_shadows", "caustics", "procedural", "knot"}) {
    const MeanRadiance one = mean_radiance(render_scene(small(name, 48), 64, 1).film);
    std::uint64_t seed = 2;
    for (const float factor : {1e-4f, 1e-2f, 1e2f, 1e4f, 1e6f}) {
      Scene scene = small(name, 48);
      enlarge(scene, factor);
      const RenderResult result = render_scene(scene, 64, seed++);
      const MeanRadiance mean = mean_radiance(result.film);
      CHECK(result.counts.bad == 0);
      for (std::size_t c = 0; c < 3; ++c) {
        INFO(name << " times " << factor << ", channel " << c << ": " << mean.value[c] << " +- "
                  << mean.standard_error[c] << " for " << one.value[c] << " +- "
                  << one.standard_error[c]);
        CHECK(std::abs(mean.value[c] - one.value[c]) <=
              4 * std::hypot(mean.standard_error[c], one.standard_error[c]));
      }
    }
  }
}
