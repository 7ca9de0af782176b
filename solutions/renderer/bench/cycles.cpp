#include "beside.h"
#include "context.h"
#include "course/report/viewer.h"
#include "render/interrupt.h"
#include "support/error.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

// Cycles beside us: seconds at equal error on scenes that are the same in both.

namespace bench {
namespace {

void compare_all(Context& context, const Contender& cycles) {
  const Choice choice = choose(context.options(), Peer::cycles);
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
    const Runs runs = measure(context, cycles, c, samples, count, number / all, (number + 1) / all);
    const Agreement a = agreement(runs.theirs, c.reference.image, *c.reference.standard_error);
    table.add_row(beside_row(c.name, runs, a));
    viewers.push_back(beside_viewer("Cycles", c, runs));
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
  const Options& options = context.options();
  if (!starts({options.blender, "--version"})) {
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
    compare_all(context,
                {Peer::cycles,
                 blender(options.blender, options.peer_scripts / "cycles_peer.py", options.scratch),
                 nlohmann::json::object()});
  } catch (const carlo::Error& error) {
    if (carlo::interrupt_noted()) throw;
    context.fault(error.what());  // the other parts may still be measured
  }
}

}  // namespace bench
