#include "beside.h"
#include "context.h"
#include "render/interrupt.h"
#include "scene/needs.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
  std::string option;        ///< of --peer
  Peer peer;
  std::string script;
  std::vector<PeerWay> ways;
};

/// Options are the best of those tried for each renderer.
const std::vector<Renderer>& renderers() {
  static const std::vector<Renderer> all = {
      {"Mitsuba 3",
       "mitsuba",
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
       "cycles",
       Peer::cycles,
       "cycles_peer.py",
       {{"light tree", {{"light_tree", true}, {"guiding", false}}},
        {"no light tree", {{"light_tree", false}, {"guiding", false}}},
        {"guiding", {{"light_tree", true}, {"guiding", true}}}}},
      {"LuxCore",
       "pyluxcore",
       "luxcore",
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

/// A scene rendered by a peer's way: a row of the table, or why there is none.
struct PeerRow {
  std::string scene, way;
  std::vector<carlo::Cell> cells;
  std::optional<Spread> ratio;  ///< of their time to ours, if the images agree
  std::string failure;
};

json to_json(const PeerRow& m) {
  json cells = json::array(), ratio;
  for (const carlo::Cell& cell : m.cells)
    cells.push_back({cell.text, cell.value ? json(*cell.value) : json()});
  if (m.ratio) ratio = {m.ratio->median, m.ratio->least, m.ratio->greatest};
  return {{"scene", m.scene},
          {"way", m.way},
          {"cells", cells},
          {"ratio", ratio},
          {"failure", m.failure}};
}

PeerRow row_from(const json& from) {
  PeerRow m{from.at("scene"), from.at("way"), {}, std::nullopt, from.at("failure")};
  for (const json& cell : from.at("cells")) {
    m.cells.emplace_back(cell.at(0).get<std::string>());
    if (!cell.at(1).is_null()) m.cells.back().value = cell.at(1).get<double>();
  }
  const json& ratio = from.at("ratio");
  if (!ratio.is_null()) m.ratio = Spread{ratio.at(0), ratio.at(1), ratio.at(2)};
  return m;
}

/// What has been measured so far, in a file beside the page, from which the same command continues
/// after an interruption. The file of another program or of other settings is ignored.
class SoFar {
 public:
  SoFar(const Options& options, std::uint32_t samples)
      : file_(std::filesystem::path(options.page).replace_extension(".partial.json")),
        settings_({{"program", program()},
                   {"peers", options.peers},
                   {"seed", options.seed},
                   {"samples", samples}}) {
    if (!std::filesystem::exists(file_)) return;
    const json earlier = json::parse(carlo::read_file(file_), nullptr, /*allow_exceptions=*/false);
    if (earlier.is_discarded() || earlier.value("settings", json()) != settings_) return;
    for (const json& row : earlier.at("rows"))
      rows_.push_back(row_from(row));
  }

  std::size_t rows() const { return rows_.size(); }
  const std::filesystem::path& file() const { return file_; }

  const PeerRow* find(const std::string& scene, const std::string& way) const {
    const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const PeerRow& m) {
      return m.scene == scene && m.way == way;
    });
    return found == rows_.end() ? nullptr : &*found;
  }

  void add(PeerRow row) {
    rows_.push_back(std::move(row));
    json rows = json::array();
    for (const PeerRow& m : rows_)
      rows.push_back(to_json(m));
    carlo::write_file(file_, json{{"settings", settings_}, {"rows", rows}}.dump(1) + "\n");
  }

  void remove() { std::filesystem::remove(file_); }

 private:
  /// The time at which this program was built.
  static std::int64_t program() {
    return std::filesystem::last_write_time("/proc/self/exe").time_since_epoch().count();
  }

  std::filesystem::path file_;
  json settings_;
  std::vector<PeerRow> rows_;
};

class Peers {
 public:
  explicit Peers(Context& context) : context_(context), done_(context.options(), samples()) {
    if (done_.rows() == 0) return;
    context_.remark(fmt::format("an interrupted run's measurements are taken from {}: {}",
                                done_.file().string(), done_.rows()));
  }

  /// `from` and `to`: the renderer's fraction of the part.
  void measure_all(const Renderer& renderer, double from, double to) {
    const Choice choice = choose(context_.options(), renderer.peer);
    if (!choice.left_out.empty()) {
      const std::string line = fmt::format("{} has no exact equal of: {}.", renderer.name,
                                           fmt::join(choice.left_out, ", "));
      // Who names a scene is told at once.
      if (context_.options().peer_scenes.empty())
        context_.page().prose(line);
      else
        context_.remark(line);
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

  /// Forgets what an interrupted run would continue from.
  void finish() { done_.remove(); }

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
      if (done_.find(c.name, name) == nullptr) {
        const std::filesystem::path script = options.peer_scripts / renderer.script;
        const double begin = from + each * static_cast<double>(i);
        done_.add(measure_way({renderer.peer,
                               {name,
                                {"timeout", most_seconds, options.peers, script.string(), "--"},
                                options.scratch},
                               way.choices},
                              c, begin, begin + each));
      }
      add(*done_.find(c.name, name));
    }
  }

  /// A time counts only if the image agrees with ours.
  PeerRow measure_way(const Contender& contender, const Compared& c, double from, double to) {
    PeerRow measured{c.name, contender.program.name, {}, std::nullopt, ""};
    try {
      const Runs runs = measure(context_, contender, c, samples(), count(), from, to);
      const Agreement a = agreement(runs.theirs, c.reference.image, *c.reference.standard_error);
      measured.cells = beside_row(c.name, runs, a);
      measured.cells.insert(measured.cells.begin() + 1,
                            carlo::Cell{measured.way + " " + runs.version});
      measured.cells.emplace_back(a.holds() ? "yes" : "no: the image differs");
      if (a.holds()) measured.ratio = spread(runs.ratio);
    } catch (const carlo::Error& error) {
      if (carlo::interrupt_noted())
        throw carlo::Error("interrupted; the same command continues from here");
      measured.failure = error.what();
    }
    return measured;
  }

  void add(const PeerRow& m) {
    if (m.cells.empty()) {
      context_.remark(fmt::format("{}, {}: {}", m.scene, m.way, m.failure));
      return;
    }
    rows_.add_row(m.cells);
    if (!m.ratio) return;
    const auto [found, is_new] = best_.try_emplace(m.scene, Best{m.way, *m.ratio});
    if (!is_new && m.ratio->median < found->second.ratio.median) found->second = {m.way, *m.ratio};
  }

  Context& context_;
  SoFar done_;
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
    if (!context.options().peer.empty() && context.options().peer != renderer.option) continue;
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
  if (there.empty()) return;
  peers.report();
  peers.finish();
}

}  // namespace bench
