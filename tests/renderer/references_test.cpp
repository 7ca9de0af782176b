// Every scene of common/scenes still looks like its reference image (tests/references/README.md),
// in a fresh render with another seed.
//
// Error rates, for normal means: the image's mean is outside 4 standard errors with probability
// 6.3e-5 per channel, a tile's outside 4.5 with 6.8e-6; for 15 scenes with 64 tiles another seed
// would fail somewhere with probability at most .02. Scenes whose light comes by few paths get
// enough samples for normal tiles (agreement_test.cpp counts them). Power: a deviation of 7.1
// standard errors of an image's mean, which are printed, is detected with probability .999.

#include "course/cli/source_folder.h"
#include "image/metrics.h"
#include "lab_scenes.h"
#include "reference_image.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace {

using namespace scene_tools;

constexpr int tile = 16;

std::uint32_t samples_of(const std::string& scene) {
  return scene == "rare_paths" || scene == "caustics" || scene == "highlights" ? 256 : 64;
}

ExrFile reference_of(const std::string& scene) {
  const std::filesystem::path path =
      source_folder() / "tests/references" / "scenes" / (scene + ".exr");
  INFO("there is no reference image: tests/references/make.sh " << scene);
  REQUIRE(std::filesystem::exists(path));
  return read_exr(path);
}

void check_scene(const std::string& name) {
  const ExrFile reference = reference_of(name);
  REQUIRE(reference.standard_error.has_value());
  Scene scene = lab_scenes::load(name);
  resize(scene, reference_image::size, reference_image::size);
  scene.sampler = SamplerKind::independent;
  const RenderResult result = render_scene(scene, samples_of(name), 5);
  const Image image = result.film.mean(), error = result.film.standard_error();
  const double image_z =
      reference_image::largest(bias_z(image, error, reference.image, *reference.standard_error));
  const double worst = reference_image::largest(
      tile_z(image, error, reference.image, *reference.standard_error, tile));
  const MeanRadiance mean = mean_radiance(result.film);
  fmt::print("{:<20} {:>8.2f} {:>9.2f} {:>9.2f}\n", name,
             100 * mean.standard_error[0] / mean.value[0], image_z, worst);
  INFO(name);
  CHECK(count_non_finite(reference.image) == 0);
  CHECK(count_non_finite(*reference.standard_error) == 0);
  CHECK(result.counts.bad == 0);
  CHECK(image_z <= 4);
  CHECK(worst <= 4.5);
}

}  // namespace

TEST_CASE("Every scene looks like its reference image") {
  fmt::print("{:<20} {:>8} {:>9} {:>9}\n", "scene", "error %", "image |z|", "tile |z|");
  for (const std::string& name : lab_scenes::names())
    check_scene(name);
}

TEST_CASE("Dropping the digits that are noise moves a reference by less than its error") {
  ExrFile file{Image(1, 1), Image(1, 1), {}};
  for (const float error : {1e-6f, 0.0123f, 3.0f}) {
    for (const float value : {0.0f, 1e-5f, 0.34567f, 1.0f, 59.999f}) {
      file.image.pixels[0] = Rgb(value);
      file.standard_error->pixels[0] = Rgb(error);
      reference_image::drop_noise_digits(file);
      // Half a step, and the rounding of the float itself.
      CHECK(std::abs(file.image.pixels[0].r - value) <= error / 16 + value * 0x1p-24f);
      CHECK(std::abs(file.standard_error->pixels[0].r - error) <= error / 256);
    }
  }
  // Pixels without an error stay unchanged.
  file.image.pixels[0] = Rgb(0.1f);
  file.standard_error->pixels[0] = Rgb(0);
  reference_image::drop_noise_digits(file);
  CHECK(file.image.pixels[0] == Rgb(0.1f));
}
