// carlo_references (tests/references/make.sh): renders the reference images of common/scenes,
// checks them by other means, and prints the table of tests/references/README.md.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "image/metrics.h"
#include "lab_scenes.h"
#include "numeric/robust.h"
#include "reference_image.h"
#include "scene/needs.h"
#include "scene_renderer/lab_integrator.h"
#include "scene_tools.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace scene_tools;

struct Arguments {
  std::string folder;
  std::vector<std::string> scenes;
  double target = 0.01;
  std::uint32_t most = 16384;
  std::uint64_t seed = 101;
  int side = reference_image::size;  ///< in pixels
};

/// An image and its cost.
struct Rendered {
  Image image, error;
  MeanRadiance mean;
  std::uint32_t spp;
  double seconds;  ///< of one processor
};

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Rendered render_with(const Integrator& integrator, const Scene& scene, std::uint32_t spp) {
  const double start = processor_seconds();
  const RenderResult result =
      render(integrator, scene.width, scene.height, RenderOptions{spp, {}, 0, true});
  if (result.interrupted) throw Error("interrupted");
  if (result.counts.bad > 0) throw Error("{} samples are no radiance", result.counts.bad);
  return {result.film.mean(), result.film.standard_error(), mean_radiance(result.film), spp,
          processor_seconds() - start};
}

Rendered render_reference(const Scene& scene, std::uint64_t seed, std::uint32_t spp) {
  return render_with(*renderer::make_path_integrator(scene, {.seed = seed, .spp = spp}), scene,
                     spp);
}

/// The number of samples for the target, estimated by a short render with another seed; whole
/// blocks of 64.
std::uint32_t samples_for(const Scene& scene, const Arguments& a) {
  const Rendered pilot = render_reference(scene, a.seed + 1, 64);
  const double error = reference_image::mean_relative_error(pilot.image, pilot.error);
  const double wanted = 64 * (error / a.target) * (error / a.target);
  const double blocks = std::ceil(std::min(wanted, 1.0 * a.most) / 512);
  return 512 * std::max(1u, static_cast<std::uint32_t>(blocks));
}

/// An independent check of a scene's image.
struct Other {
  std::string name;
  double image_z, tile_z;  ///< the largest, over channels; tiles of 16 x 16
};

Other compared(std::string name, const Rendered& r, const Image& image, const Image& error) {
  return {std::move(name), reference_image::largest(bias_z(r.image, r.error, image, error)),
          reference_image::largest(tile_z(r.image, r.error, image, error, 16))};
}

/// The mean over the film: all of a furnace is 1, all of an integrating sphere its closed form. The
/// forty spokes, 0.96 x 0.024 from 0.04 on, overlap up to 0.012/tan 4.5 degrees from the hub, and
/// stand on a film plane of side 6 tan 20 degrees.
std::optional<double> closed_form(const std::string& scene) {
  if (scene == "furnace") return 1;
  if (scene == "integrating_sphere") return 0.8 * 0.04 * 5 / (1 - 0.8 * 0.96);
  if (scene == "antialiasing") {
    const double slope = std::tan(pi / 40), overlap = 0.012 / slope, side = 6 * std::tan(pi / 9);
    const double spoke = slope * (overlap * overlap - 0.04 * 0.04) + 0.024 * (1 - overlap);
    return 40 * spoke / (side * side);
  }
  return std::nullopt;
}

std::string closed_form_text(const std::string& name, const Rendered& r) {
  const auto exact = closed_form(name);
  if (!exact) return "";
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c)
    worst = std::max(worst, std::abs(r.mean.value[c] - *exact) / r.mean.standard_error[c]);
  return fmt::format("closed form {:.6g}: {:.1f}; ", *exact, worst);
}

void print_row(const std::string& name, const Rendered& r, const std::string& closed,
               const Other& other) {
  const auto& m = r.mean;
  fmt::print(
      "| {} | {} | {:.0f} | {:.5f} ± {:.5f}, {:.5f} ± {:.5f}, {:.5f} ± {:.5f} | {:.2g} | "
      "{}{}: {:.1f}, {:.1f} |\n",
      name, r.spp, r.seconds, m.value[0], m.standard_error[0], m.value[1], m.standard_error[1],
      m.value[2], m.standard_error[2], 100 * reference_image::mean_relative_error(r.image, r.error),
      closed, other.name, other.image_z, other.tile_z);
  std::fflush(stdout);
}

Scene prepared(Scene scene, int side) {
  resize(scene, side, side);
  scene.sampler = SamplerKind::independent;
  return scene;
}

/// Uses lab 8's path tracer, with other random numbers.
Other lab_view(const Scene& scene, const Rendered& r, const Arguments& a) {
  const std::uint32_t spp = std::max(512u, r.spp / 8 / 512 * 512);
  const auto integrator =
      lab08::make_lab_integrator(scene, {lab08::Method::iterative, a.seed + 2, spp});
  const Rendered lab = render_with(*integrator, scene, spp);
  return compared(fmt::format("lab 08, {} samples", spp), r, lab.image, lab.error);
}

/// Uses the scalar path tracer, for scenes that lab 8 does not support.
Other scalar_view(const Scene& scene, const Rendered& r, const Arguments& a) {
  const std::uint32_t spp = std::max(512u, r.spp / 4 / 512 * 512);
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = a.seed + 2, .spp = spp, .kernel = renderer::Kernel::scalar});
  const Rendered other = render_with(*integrator, scene, spp);
  return compared(fmt::format("scalar kernel, {} samples", spp), r, other.image, other.error);
}

Other other_view(const Scene& scene, const Rendered& r, const Arguments& a) {
  return needs(scene).envmap ? scalar_view(scene, r, a) : lab_view(scene, r, a);
}

void make(const std::string& name, const Arguments& a) {
  const Scene scene = prepared(lab_scenes::load(name), a.side);
  const Rendered r = render_reference(scene, a.seed, samples_for(scene, a));
  ExrFile file{r.image,
               r.error,
               {{"scene", "common/scenes/" + name + ".xml"},
                {"seed", std::to_string(a.seed)},
                {"spp", std::to_string(r.spp)}}};
  reference_image::drop_noise_digits(file);
  const fs::path scenes = fs::path(a.folder) / "scenes";
  fs::create_directories(scenes);
  write_exr(scenes / (name + ".exr"), file);
  print_row(name, r, closed_form_text(name, r), other_view(scene, r, a));
}

/// The independent renderer's scenes and images; the latter lack standard errors. At equal samples
/// its relMSE is 2.3 times ours, and it has 8192 samples in each of four pixels for one of ours.
void look_at_peer(const std::string& name, const Arguments& a) {
  const fs::path folder(a.folder);
  const Scene scene = prepared(load_scene(folder / (name + ".xml")), reference_image::size);
  const Rendered r = render_reference(scene, a.seed, samples_for(scene, a));
  Image error = r.error;
  for (Rgb& e : error.pixels)
    e *= std::sqrt(2.3f * static_cast<float>(r.spp) / (4 * 8192));
  const Image peer = reference_image::halved(read_exr(folder / (name + ".exr")).image);
  print_row(name, r, "", compared("Tungsten's image", r, peer, error));
}

int run(int argc, char** argv) {
  Arguments a;
  CommandLine app("Renders the reference images and prints their table.",
                  "tests/references/make.sh");
  app.option("--folder", a.folder, "tests/references").required().existing_folder();
  app.option("--target", a.target, "mean relative standard error of a pixel")
      .range(1e-4, 1.0)
      .show_default();
  app.option("--most", a.most, "samples a pixel at most").range(512u, 1u << 24).show_default();
  app.option("--side", a.side, "pixels in a row and in a column").range(16, 4096).show_default();
  app.option("scenes", a.scenes, "names in common/scenes, or peer_... (default: all)");
  if (const auto code = app.parse(argc, argv)) return *code;
  if (a.scenes.empty()) {
    a.scenes = lab_scenes::names();
    a.scenes.insert(a.scenes.end(), {"peer_cornell_lambert", "peer_cornell_phong"});
  }
  fmt::print(
      "| scene | samples a pixel | processor seconds | mean R, G, B | pixel's error, % | agrees "
      "with: \\|z\\| of the image, largest of a tile |\n|---|---|---|---|---|---|\n");
  for (const std::string& name : a.scenes) {
    if (name.starts_with("peer_")) {
      look_at_peer(name, a);
    } else {
      make(name, a);
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_main([&] { return run(argc, argv); });
}
