#include "beside.h"
#include "context.h"
#include "render/interrupt.h"
#include "scene/needs.h"
#include "support/error.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

// Mitsuba 3, Cycles and LuxCore beside ours: seconds at equal error, on each scene that one of them
// can express exactly.

namespace bench {
namespace {

using nlohmann::json;

/// One of a peer's integrators.
struct PeerWay {
  std::string name;
  json choices;
  bool for_caustics = false;  ///< useless, or endless, without mirrors and glass
};

/// The time limit for one render.
constexpr const char* most_seconds = "900";

struct Renderer {
  std::string name, module;  ///< for display, and for Python
  Peer peer;
  std::string script;
  std::vector<PeerWay> ways;
};

/// Options are the best of those tried for each renderer.
const std::vector<Renderer>& renderers() {
  static const std::vector<Renderer> all = {
      {"Mitsuba 3",
       "mitsuba",
       Peer::mitsuba,
       "mitsuba_peer.py",
       {{"path", {{"variant", "scalar_rgb"}, {"integrator", "path"}, {"points", "multijitter"}}},
        {"path, LLVM",
         {{"variant", "llvm_ad_rgb"}, {"integrator", "path"}, {"points", "multijitter"}}},
        {"ptracer",
         {{"variant", "scalar_rgb"}, {"integrator", "ptracer"}, {"points", "independent"}}},
        {"ptracer, LLVM",
         {{"variant", "llvm_ad_rgb"}, {"integrator", "ptracer"}, {"points", "independent"}}}}},
      {"Cycles",
       "bpy",
       Peer::cycles,
       "cycles_peer.py",
       {{"light tree", {{"light_tree", true}, {"guiding", false}}},
        {"no light tree", {{"light_tree", false}, {"guiding", false}}},
        {"guiding", {{"light_tree", true}, {"guiding", true}}}}},
      {"LuxCore",
       "pyluxcore",
       Peer::luxcore,
       "luxcore_peer.py",
       {{"PATHCPU", {{"integrator", "PATHCPU"}, {"caustic_cache", false}}},
        {"BIDIRCPU", {{"integrator", "BIDIRCPU"}, {"caustic_cache", false}}},
        {"PATHCPU, caustic cache",
         {{"integrator", "PATHCPU"}, {"caustic_cache", true}},
         /*for_caustics=*/true}}}};
  return all;
}

/// Ours beside their best, for one scene.
struct Best {
  std::string peer;
  Spread ratio;
};

class Peers {
 public:
  explicit Peers(Context& context) : context_(context) {}

  /// `from` and `to`: the renderer's fraction of the part.
  void measure_all(const Renderer& renderer, double from, double to) {
    const Choice choice = choose(context_.options(), renderer.peer);
    if (!choice.left_out.empty()) {
      context_.page().prose(fmt::format("{} has no exact equal of: {}.", renderer.name,
                                        fmt::join(choice.left_out, ", ")));
    }
    const double share = (to - from) / static_cast<double>(choice.scenes.size());
    for (std::size_t i = 0; i < choice.scenes.size(); ++i)
      measure_scene(renderer, choice.scenes[i], from + share * static_cast<double>(i), share);
  }

  void report() {
    carlo::Table table({"scene", "best peer", "its time at equal error over ours [range]"},
                       {"scene", "peer", "ratio"});
    for (const auto& [scene, best] : best_)
      table.add_row({scene, best.peer, spread_cell(best.ratio)});
    context_.table(
        "best_peers", table,
        fmt::format("The best of all peers' ways beside ours; medians of {} runs", count()));
    context_.table("peers", rows_,
                   fmt::format("All of them, with {} samples a pixel, ours at the same relMSE; "
                               "processor seconds of one thread, medians of {} runs",
                               samples(), count()));
  }

 private:
  std::uint32_t samples() const { return context_.options().full ? 256 : 64; }
  int count() const { return context_.options().full ? 5 : 3; }

  void measure_scene(const Renderer& renderer, const Compared& c, double from, double share) {
    const Options& options = context_.options();
    const double each = share / static_cast<double>(renderer.ways.size());
    for (std::size_t i = 0; i < renderer.ways.size(); ++i) {
      const PeerWay& way = renderer.ways[i];
      const carlo::Needs needs = carlo::needs(c.scene);
      if (way.for_caustics && !needs.mirror && !needs.dielectric) continue;
      const std::string name = renderer.name + " " + way.name;
      const std::filesystem::path script = options.peer_scripts / renderer.script;
      const double begin = from + each * static_cast<double>(i);
      try {
        const Runs runs = measure(context_,
                                  {renderer.peer,
                                   {name,
                                    {"timeout", most_seconds, options.peers, script.string(), "--"},
                                    options.scratch},
                                   way.choices},
                                  c, samples(), count(), begin, begin + each);
        add(name, c, runs);
      } catch (const carlo::Error& error) {
        if (carlo::interrupt_noted()) throw;
        context_.remark(fmt::format("{}, {}: {}", c.name, name, error.what()));
      }
    }
  }

  /// A time counts only if the image agrees with ours.
  void add(const std::string& name, const Compared& c, const Runs& runs) {
    const Agreement a = agreement(runs.theirs, c.reference.image, *c.reference.standard_error);
    std::vector<carlo::Cell> row = beside_row(c.name, runs, a);
    row.insert(row.begin() + 1, carlo::Cell{name + " " + runs.version});
    row.push_back(a.holds() ? "yes" : "no: the image differs");
    rows_.add_row(std::move(row));
    if (!a.holds()) return;
    const Spread ratio = spread(runs.ratio);
    const auto [found, is_new] = best_.try_emplace(c.name, Best{name, ratio});
    if (!is_new && ratio.median < found->second.ratio.median) found->second = {name, ratio};
  }

  Context& context_;
  std::map<std::string, Best> best_;
  carlo::Table rows_{
      {"scene", "renderer", "its time [range]", "relMSE", "our samples", "our time [range]",
       "its over ours [range]", "means", "tile |z|", "mean |z|", "counts"},
      {"scene", "renderer", "peer_seconds", "rel_mse", "samples", "seconds", "ratio", "mean_ratio",
       "tile_z", "mean_z", "counts"}};
};

}  // namespace

void bench_peers(Context& context) {
  const std::string& python = context.options().peers;
  if (python.empty()) return;
  context.begin("Beside Mitsuba 3, Cycles and LuxCore");
  context.page().prose(
      "Each renders our scenes on one thread with a box filter, without clamping or denoising. "
      "Ours takes the samples that leave the same relMSE as theirs, by the technique that it "
      "chooses for itself, its pilot's time included. Seconds are the processor's, without the "
      "start of the program; of Mitsuba's LLVM variant without compiling, of Cycles without what "
      "a render of one sample takes. A time counts where the mean of the images agrees with our "
      "reference image, in tiles and as a whole. Where a peer has no spheres, it gets meshes of "
      "81 920 triangles.");
  Peers peers(context);
  std::vector<Renderer> there;
  for (const Renderer& renderer : renderers()) {
    if (starts({python, "-c", "import " + renderer.module})) {
      there.push_back(renderer);
    } else {
      context.remark(renderer.name + " is not installed, so it is not measured");
    }
  }
  for (std::size_t i = 0; i < there.size(); ++i) {
    const auto all = static_cast<double>(there.size()), number = static_cast<double>(i);
    peers.measure_all(there[i], number / all, (number + 1) / all);
  }
  if (!there.empty()) peers.report();
}

}  // namespace bench
