#include "context.h"
#include "course/cli/program.h"
#include "program.h"
#include "render_cost.h"
#include "support/error.h"

#include <fmt/core.h>

#include <array>
#include <utility>

// What the whole renderer costs beside one that was built for the scene alone.

namespace bench {
namespace {

namespace fs = std::filesystem;

struct Program {
  std::string name;
  fs::path path;
  std::vector<std::string> arguments;  ///< the seed follows
  std::vector<double> seconds_a_path = {};
  std::string kernel = {};
  std::uint64_t image = 0;

  void run(std::uint64_t seed) {
    std::vector<std::string> all = arguments;
    all.insert(all.begin(), path.string());
    all.push_back(std::to_string(seed));
    const auto cost = nlohmann::json::parse(carlo::output_of(all));
    seconds_a_path.push_back(cost.at("seconds_a_path"));
    kernel = cost.at("kernel");
    image = cost.at("image");
  }
};

}  // namespace

void bench_lean_build(Context& context) {
  context.begin("A build with everything, and one with only what the scene needs");
  context.page().prose(
      "The whole renderer chooses its kernel when it has read the scene. The lean one is a program "
      "of the same sources into which only this scene's combination was compiled, the vector "
      "kernel for diffuse parallelograms, and no choice. The two take turns and render the same "
      "bits.");
  const fs::path scene = context.options().scenes / "cornell_lambert.xml";
  Program whole{"whole renderer", this_program(), {"--render-cost", scene.string(), "--seed"}};
  Program lean{"only what the scene needs",
               this_program().parent_path() / "carlo_bench_lambert",
               {scene.string()}};
  const int runs = context.options().full ? 21 : 11;
  for (int run = 0; run < runs; ++run) {
    const std::uint64_t seed = context.options().seed + static_cast<std::uint64_t>(run);
    // Each goes first as often as the other.
    std::array<Program*, 2> order = {&whole, &lean};
    if (run % 2 == 1) std::swap(order[0], order[1]);
    for (Program* program : order)
      program->run(seed);
    if (whole.image != lean.image) throw carlo::Error("two builds of the renderer do not agree");
    context.progress(static_cast<double>(run + 1) / runs);
  }
  carlo::Table table({"program", "kernel", "processor time a path [range]", "x lean"},
                     {"program", "kernel", "seconds_a_path", "ratio"});
  for (const Program* program : {&lean, &whole}) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < lean.seconds_a_path.size(); ++i)
      ratios.push_back(program->seconds_a_path[i] / lean.seconds_a_path[i]);
    table.add_row({program->name, program->kernel,
                   seconds_spread_cell(spread(program->seconds_a_path)),
                   spread_cell(spread(ratios))});
  }
  context.table("lean_build", table,
                fmt::format("cornell_lambert, {} x {}, {} samples, one thread; medians of {} runs, "
                            "ratios within each",
                            cost_size, cost_size, cost_samples, runs));
}

}  // namespace bench
