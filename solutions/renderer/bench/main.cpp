// `./carlo bench`: all measurements in one run, on one page.

#include "context.h"
#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "render/interrupt.h"
#include "support/atomic_file.h"

#include <algorithm>
#include <string>
#include <vector>

namespace {

/// A part of the page: its name on the command line, its duration on an idle machine in seconds,
/// roughly, and the function that measures it.
struct Part {
  std::string name;
  double seconds;
  void (*run)(bench::Context& context);
};

/// In the order of the page.
const std::vector<Part> parts = {
    {"scenes", 75, bench::bench_scenes},  {"equal-time", 6, bench::bench_equal_time},
    {"threads", 4, bench::bench_threads}, {"triangles", 8, bench::bench_triangles},
    {"shapes", 20, bench::bench_shapes},  {"lights", 5, bench::bench_lights},
    {"depth", 3, bench::bench_depth},     {"needs", 3, bench::bench_needs},
    {"floors", 20, bench::bench_floors},  {"peers", 900, bench::bench_peers}};

int run(int argc, char** argv) {
  bench::Options options;
  std::string mesh;
  std::vector<std::string> names;
  for (const Part& part : parts)
    names.push_back(part.name);
  carlo::CommandLine app(
      "Error against time: integrators and samplers on scenes, scaling, other renderers.",
      "./carlo bench");
  app.flag("--full", options.full, "all scenes, larger films, more samples (an hour or two)");
  app.option("--only", options.only, "parts of the page, such as scenes,threads")
      .list(',')
      .one_of(names);
  app.option("--seed", options.seed, "another seed gives other noise").show_default();
  app.option("--page", options.page, "where the page goes; beside it, the numbers as JSON")
      .default_value("out/bench.html");
  app.option("--scene", options.peer_scenes, "for peers: these scenes alone, such as indirect,knot")
      .list(',');
  app.option("--peer", options.peer, "for peers: this renderer alone")
      .one_of({"mitsuba", "cycles", "luxcore"});
  // Set by the script ./carlo.
  app.option("--scenes", options.scenes).default_value("common/scenes").hidden();
  app.option("--references", options.references).default_value("tests/references/scenes").hidden();
  app.option("--scratch", options.scratch).default_value("build/bench").hidden();
  app.option("--peers", options.peers).hidden();
  app.option("--peer-scripts", options.peer_scripts)
      .default_value("solutions/renderer/bench/peers")
      .hidden();
  app.option("--mesh-costs", mesh).hidden();
  if (const auto code = app.parse(argc, argv)) return *code;
  if (!mesh.empty()) {
    bench::print_mesh_costs(mesh);
    return 0;
  }
  if (options.page.has_parent_path()) {
    std::filesystem::create_directories(options.page.parent_path());
  }
  (void)carlo::AtomicFile(options.page);
  const carlo::InterruptGuard guard;
  std::vector<Part> wanted;
  double seconds = 0;
  for (const Part& part : parts) {
    const auto& only = options.only;
    if (!only.empty() && std::find(only.begin(), only.end(), part.name) == only.end()) continue;
    if (part.name == "peers" && options.peers.empty()) continue;
    wanted.push_back(part);
    seconds += part.seconds;
  }
  bench::Context context(options, seconds);
  std::vector<std::string> missing;
  for (const Part& part : wanted)
    missing.push_back(part.name);
  for (const Part& part : wanted) {
    context.start(part.seconds);
    part.run(context);
    missing.erase(missing.begin());
    context.write(missing);
  }
  return context.sound() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] { return run(argc, argv); });
}
