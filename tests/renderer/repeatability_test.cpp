#include "course/cli/source_folder.h"
#include "scene/load_scene.h"
#include "scene/sampler_kind.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>

#include <string>

namespace {

using namespace scene_tools;

TEST_CASE("A render has the same bits for 1, 2 and 7 threads and from run to run") {
  Scene scene = load_scene(source_folder() / "tests/references/peer_cornell_phong.xml");
  resize(scene, 50, 34);
  for (const SamplerKind kind : sampler_kinds) {
    scene.sampler = kind;
    const RenderResult one = render_scene(scene, 16, 5, 1);
    for (const int threads : {1, 2, 7}) {
      const RenderResult again = render_scene(scene, 16, 5, threads);
      CHECK(again.film.mean().pixels == one.film.mean().pixels);
      CHECK(again.film.standard_error().pixels == one.film.standard_error().pixels);
      CHECK(again.counts.rays == one.counts.rays);
    }
    CHECK(render_scene(scene, 16, 6, 1).film.mean().pixels != one.film.mean().pixels);
  }
}

TEST_CASE("The samplers agree with each other, and better ones have less noise") {
  Scene scene = load_scene(source_folder() / "tests/references/peer_cornell_lambert.xml");
  resize(scene, 32, 32);
  scene.sampler = SamplerKind::independent;
  const RenderResult plain = render_scene(scene, 256, 1);
  const MeanRadiance a = mean_radiance(plain.film);
  for (const SamplerKind kind : {SamplerKind::stratified, SamplerKind::sobol}) {
    scene.sampler = kind;
    const MeanRadiance b = mean_radiance(render_scene(scene, 256, 2).film);
    for (std::size_t c = 0; c < 3; ++c) {
      // The error estimates of stratified samples are upper bounds.
      const double error = std::hypot(a.standard_error[c], b.standard_error[c]);
      CHECK(std::abs(a.value[c] - b.value[c]) <= 4 * error);
    }
  }
}

}  // namespace
