// Agreement with an independent renderer (tests/references/README.md).

#include "course/cli/source_folder.h"
#include "image/exr.h"
#include "image/metrics.h"
#include "scene/load_scene.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace {

using namespace scene_tools;

/// Samples per pixel: as many as CI can afford, or CARLO_PEER_SPP for a sharper test.
std::uint32_t peer_spp() {
  const char* text = std::getenv("CARLO_PEER_SPP");
  return text == nullptr ? 128 : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

/// The independent images lack error estimates. At equal samples their relMSE is at most this many
/// times ours (64 samples per pixel), and they have at least 8192 samples per pixel.
constexpr double peer_variance_ratio = 2.3, peer_samples = 8192;

void check_against_peer(const std::string& name) {
  const std::string base = (source_folder() / "tests/references" / name).string();
  Scene scene = load_scene(base + ".xml");
  scene.sampler = SamplerKind::independent;
  const std::uint32_t spp = peer_spp();
  const RenderResult result = render_scene(scene, spp, 7);
  const Image image = result.film.mean(), error = result.film.standard_error();
  const Image reference = read_exr(base + ".exr").image;
  Image reference_error = error;
  const auto scale = static_cast<float>(std::sqrt(peer_variance_ratio * spp / peer_samples));
  for (Rgb& e : reference_error.pixels)
    e *= scale;

  CHECK(count_non_finite(image) == 0);
  CHECK(result.counts.bad == 0);
  for (const double z : bias_z(image, error, reference, reference_error)) {
    INFO("whole image: z = " << z);
    CHECK(std::abs(z) <= 3);
  }
  double worst = 0;
  for (const double z : tile_z(image, error, reference, reference_error, 16)) {
    worst = std::max(worst, std::abs(z));
  }
  WARN(name << ", " << spp << " samples a pixel: largest tile |z| = " << worst);
  CHECK(worst < 5);
}

TEST_CASE("The diffuse Cornell box agrees with an independent renderer") {
  check_against_peer("peer_cornell_lambert");
}

TEST_CASE("The Phong Cornell box agrees with an independent renderer") {
  check_against_peer("peer_cornell_phong");
}

TEST_CASE("Surfaces under an image of the sky agree with an independent renderer") {
  check_against_peer("peer_image_light");
}

}  // namespace
