#include "cli/error.h"
#include "context.h"
#include "cycles_blender.h"
#include "cycles_check.h"
#include "cycles_scene.h"
#include "image/exr.h"
#include "image/metrics.h"
#include "methods.h"
#include "render/interrupt.h"
#include "render/render_app.h"
#include "report/format.h"
#include "report/viewer.h"
#include "scene/load_scene.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

// Cycles beside us: seconds at equal error on scenes that are the same in both.

namespace bench {
namespace {

namespace fs = std::filesystem;
using carlo::Image;
using carlo::Scene;

struct Compared {
  std::string name;
  Scene scene;
  carlo::ExrFile reference;
  double noise = 0;  ///< the reference's part of relMSE
};

/// The scenes of the references that Cycles can render, and why the others are left out.
struct Choice {
  std::vector<Compared> scenes;
  std::vector<std::string> left_out;
};

Choice choose(const Options& options) {
  std::set<fs::path> names;
  for (const auto& entry : fs::directory_iterator(options.references)) {
    if (entry.path().extension() == ".exr") names.insert(entry.path().stem());
  }
  Choice choice;
  for (const fs::path& name : names) {
    Scene scene = carlo::load_scene(options.scenes / (name.string() + ".xml"));
    if (const auto obstacle = cycles_obstacle(scene)) {
      choice.left_out.push_back(fmt::format("{} ({})", name.string(), *obstacle));
      continue;
    }
    carlo::ExrFile reference = carlo::read_exr(options.references / (name.string() + ".exr"));
    if (!reference.standard_error) continue;
    carlo::resize(scene, reference.image.width, reference.image.height);
    scene.sampler = carlo::SamplerKind::sobol;
    const double noise = rel_mse_noise(reference.image, *reference.standard_error);
    choice.scenes.push_back({name.string(), std::move(scene), std::move(reference), noise});
  }
  if (choice.scenes.empty()) {
    throw carlo::Error("no scene with a reference image in {} is one that Cycles can render",
                       options.references.string());
  }
  return choice;
}

/// Our time at their error, and what else is known of one scene.
struct Runs {
  std::vector<Image> cycles;
  std::vector<double> seconds, rel_mse, our_samples, our_seconds, ratio;
  Image ours;
  std::string version;
};

Rung render_ours(const Compared& c, std::uint64_t seed, std::uint32_t samples, Image& image) {
  const auto integrator = make_integrator(Method::best, c.scene, seed, samples);
  const Rendered rendered = render_timed(*integrator, c.scene, samples);
  image = rendered.film.mean();
  return {static_cast<double>(samples), rendered.seconds,
          carlo::compare(image, c.reference.image).rel_mse - c.noise};
}

/// Halves or doubles the samples until the error lies between two measurements.
Rung ours_at(const Compared& c, std::uint64_t seed, std::uint32_t samples, double rel_mse,
             Image& image) {
  constexpr std::uint32_t most = 1u << 16;
  Rung rung = render_ours(c, seed, samples, image);
  const bool fewer = rung.rel_mse < rel_mse;
  while (true) {
    if (fewer ? samples == 1 : samples >= most) return at_error(rung, rung, rel_mse);
    samples = fewer ? samples / 2 : 2 * samples;
    const Rung next = render_ours(c, seed, samples, image);
    if (fewer && next.rel_mse >= rel_mse) return at_error(next, rung, rel_mse);
    if (!fewer && next.rel_mse <= rel_mse) return at_error(rung, next, rel_mse);
    rung = next;
  }
}

/// Cycles and ours take turns, so that what disturbs the machine disturbs both.
Runs measure(Context& context, const Blender& blender, const Compared& c, std::uint32_t samples,
             int count, double from, double to) {
  Runs runs;
  (void)render_ours(c, 1, samples, runs.ours);  // the first render also pays for what is done once
  for (int i = 0; i < count; ++i) {
    const double done = from + (to - from) * i / count;
    const std::uint64_t seed = context.options().seed + static_cast<std::uint64_t>(i);
    nlohmann::json spec = cycles_scene(c.scene);
    spec["samples"] = samples;
    spec["seed"] = seed;
    CyclesImage theirs = render_by_cycles(blender, spec, [&] { context.progress(done); });
    const double rel_mse = carlo::compare(theirs.image, c.reference.image).rel_mse - c.noise;
    if (!(rel_mse > 0)) {
      throw carlo::Error("Cycles' image of {} is nearer to the reference than its noise", c.name);
    }
    const Rung ours = ours_at(c, seed, samples, rel_mse, runs.ours);
    runs.seconds.push_back(theirs.seconds);
    runs.rel_mse.push_back(rel_mse);
    runs.our_samples.push_back(ours.samples);
    runs.our_seconds.push_back(ours.seconds);
    runs.ratio.push_back(theirs.seconds / ours.seconds);
    runs.cycles.push_back(std::move(theirs.image));
    runs.version = theirs.version;
  }
  return runs;
}

void add_row(carlo::Table& table, const std::string& scene, const Runs& runs,
             const Agreement& agreement) {
  const Spread rel_mse = spread(runs.rel_mse), samples = spread(runs.our_samples);
  table.add_row({scene,
                 seconds_spread_cell(spread(runs.seconds)),
                 {carlo::number_text(rel_mse.median, 3), rel_mse.median},
                 {carlo::number_text(samples.median, 3), samples.median},
                 seconds_spread_cell(spread(runs.our_seconds)),
                 spread_cell(spread(runs.ratio)),
                 {fmt::format("{:.4f}", agreement.mean_ratio), agreement.mean_ratio},
                 {fmt::format("{:.1f}", agreement.tile_z), agreement.tile_z},
                 {fmt::format("{:.1f}", agreement.mean_z), agreement.mean_z}});
}

carlo::Viewer viewer(const Compared& c, const Runs& runs) {
  return {c.name + " by Cycles and by us, one run of each",
          "Ours has about as many samples as Cycles' error takes.",
          {{"Cycles", runs.cycles.back()}, {"ours", runs.ours}},
          carlo::ViewerImage{"reference image", c.reference.image, c.reference.standard_error}};
}

void compare_all(Context& context, const Blender& blender) {
  const Choice choice = choose(context.options());
  const std::uint32_t samples = context.options().full ? 256 : 64;
  const int count = context.options().full ? 9 : 5;
  if (!choice.left_out.empty()) {
    context.page().prose(
        fmt::format("Left out, since Cycles has no exact equal of what is in them: {}.",
                    fmt::join(choice.left_out, ", ")));
  }
  carlo::Table table({"scene", "Cycles' time [range]", "relMSE", "our samples", "our time [range]",
                      "Cycles' over ours [range]", "means", "tile |z|", "mean |z|"},
                     {"scene", "cycles_seconds", "rel_mse", "samples", "seconds", "ratio",
                      "mean_ratio", "tile_z", "mean_z"});
  std::vector<carlo::Viewer> viewers;
  std::string version;
  const auto all = static_cast<double>(choice.scenes.size());
  for (std::size_t i = 0; i < choice.scenes.size(); ++i) {
    const Compared& c = choice.scenes[i];
    const auto number = static_cast<double>(i);
    const Runs runs =
        measure(context, blender, c, samples, count, number / all, (number + 1) / all);
    const Agreement a = agreement(runs.cycles, c.reference.image, *c.reference.standard_error);
    add_row(table, c.name, runs, a);
    viewers.push_back(viewer(c, runs));
    version = runs.version;
    if (!a.holds()) {
      context.fault(
          fmt::format("Cycles' image of {} is not ours: largest |z| of a tile {:.1f}, of "
                      "the mean {:.1f} (limit {}), means {:.4f} : 1",
                      c.name, a.tile_z, a.mean_z, agreement_limit, a.mean_ratio));
    }
  }
  context.table("cycles", table,
                fmt::format("Cycles of Blender {} with {} samples a pixel, ours at the same "
                            "relMSE; {} x {} pixels, processor seconds of one thread, medians "
                            "of {} runs; right, Cycles' mean image beside the reference",
                            version, samples, choice.scenes.front().scene.width,
                            choice.scenes.front().scene.height, count));
  for (const carlo::Viewer& v : viewers)
    carlo::add_viewer(context.page(), v);
}

}  // namespace

void bench_cycles(Context& context) {
  context.begin("Beside Blender's Cycles");
  const Blender blender{context.options().blender, context.options().cycles_script,
                        context.options().scratch};
  if (!blender_installed(blender)) {
    context.remark(
        "Blender is not installed, so Cycles is not measured: apt-get install "
        "--no-install-recommends blender");
    return;
  }
  context.page().prose(
      "Cycles is a path tracer with next-event estimation, multiple importance sampling and "
      "roulette, as ours is. It renders the same polygons, diffuse surfaces and lamps: box filter, "
      "no clamping, no denoising, no adaptive sampling, Owen-scrambled Sobol' points, one thread, "
      "else its own choices. Ours takes the samples that leave the same relMSE, found between two "
      "powers of two; at equal error the ratio of times is that of relMSE x seconds. Seconds are "
      "the processor's. Cycles' are those that samples take: a render of one sample is subtracted, "
      "and with it Blender's start, the scene's translation and the tree. Ours are those of the "
      "whole render once the scene is loaded.");
  context.page().prose(fmt::format(
      "That both rendered the same scene is checked: the mean of Cycles' images against our "
      "reference image, in tiles of {0} x {0} pixels and as a whole, may differ by {1} standard "
      "errors of that difference.",
      agreement_tile, agreement_limit));
  try {
    compare_all(context, blender);
  } catch (const carlo::Error& error) {
    if (carlo::interrupt_noted()) throw;
    context.fault(error.what());  // the other parts may still be measured
  }
}

}  // namespace bench
