// `./carlo bench`: one run over everything, on one page.

#include "cli/arguments.h"
#include "cli/atomic_file.h"
#include "cli/main_guard.h"
#include "context.h"
#include "render/interrupt.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace {

using Part = void (*)(bench::Context&);

/// In the page's order.
const std::vector<std::pair<std::string, Part>> parts = {
    {"scenes", bench::bench_scenes},       {"equal-time", bench::bench_equal_time},
    {"labs", bench::bench_labs},           {"threads", bench::bench_threads},
    {"triangles", bench::bench_triangles}, {"lights", bench::bench_lights},
    {"depth", bench::bench_depth},         {"needs", bench::bench_needs}};

int run(int argc, char** argv) {
  bench::Options options;
  std::string mesh;
  std::vector<std::string> wanted, names;
  for (const auto& [name, part] : parts)
    names.push_back(name);
  CLI::App app("Error against time of everything: integrators, samplers, estimators, generators.",
               "./carlo bench");
  app.add_flag("--full", options.full, "all scenes, larger films, more samples (about an hour)");
  app.add_option("--only", wanted, "parts of the page, such as scenes,threads")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--seed", options.seed, "another seed gives other noise")->capture_default_str();
  app.add_option("--page", options.page, "where the page goes; beside it, the numbers as JSON")
      ->default_val("out/bench.html");
  // From the script ./carlo.
  app.add_option("--scenes", options.scenes)->default_val("common/scenes")->group("");
  app.add_option("--references", options.references)
      ->default_val("tests/references/scenes")
      ->group("");
  app.add_option("--scratch", options.scratch)->default_val("build/bench")->group("");
  app.add_option("--integrators", options.integrators)->group("");
  app.add_option("--generators", options.generators)->group("");
  app.add_option("--mesh-costs", mesh)->group("");
  if (const auto code = carlo::parse_arguments(app, argc, argv)) return *code;
  if (!mesh.empty()) {
    bench::print_mesh_costs(mesh);
    return 0;
  }
  if (options.page.has_parent_path()) {
    std::filesystem::create_directories(options.page.parent_path());
  }
  (void)carlo::AtomicFile(options.page);
  const carlo::InterruptGuard guard;
  bench::Context context(options);
  for (const auto& [name, part] : parts) {
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end())
      part(context);
  }
  context.write();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] { return run(argc, argv); });
}
