#include "cli/arguments.h"
#include "cli/atomic_file.h"
#include "cli/main_guard.h"
#include "cli/terminal.h"
#include "experiments.h"
#include "notebook.h"
#include "report/machine.h"
#include "report/page.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <string>

namespace {

struct Arguments {
  lab01::Options options;
  std::string page = "out/lab01.html";
  std::string json;
  bool no_page = false;
};

void run_experiments(lab01::Notebook& notebook) {
  constexpr std::array experiments = {
      lab01::average_experiment,         lab01::rules_experiment,    lab01::dimensions_experiment,
      lab01::hard_integrands_experiment, lab01::variance_experiment, lab01::domain_experiment};
  int index = 0;
  for (const auto experiment : experiments) {
    notebook.set_experiment(index++, static_cast<int>(experiments.size()));
    experiment(notebook);
  }
  notebook.finish();
}

void what_you_should_see(lab01::Notebook& notebook) {
  notebook.begin("What you should see");
  for (const char* sentence :
       {"Monte Carlo's error falls with slope -1/2: four times the points, half the error, in "
        "any dimension and for anything of finite variance.",
        "In one dimension the rules leave it far behind: -2 for midpoint and trapezoid, -4 for "
        "Simpson, down to the rounding errors. Nested in d dimensions the -2 becomes -2/d: "
        "steeper than -1/2 below d = 4, flatter above.",
        "Where the variance is infinite, Monte Carlo converges more slowly and its error bars "
        "are not to be trusted; a rare spike fools them until it has been met often.",
        "A variance by Welford's update does not care how large the mean is.",
        "Error bars of Lab 1.7 hold the exact volume about 95 times in 100; for rare hits (the "
        "ball in ten dimensions) somewhat less often."}) {
    notebook.say(sentence);
  }
}

nlohmann::json results(const lab01::Notebook& notebook, const Arguments& arguments,
                       double seconds) {
  return {{"lab", 1},
          {"n", arguments.options.n},
          {"seed", std::to_string(arguments.options.seed)},
          {"quick", arguments.options.quick},
          {"machine", carlo::machine_text()},
          {"compiler", carlo::compiler_text()},
          {"seconds", seconds},
          {"left_out", notebook.left_out()},
          {"tables", notebook.results()}};
}

void run(const Arguments& arguments, const std::string& command) {
  // A file that cannot be written is better known before the experiments than after them.
  if (!arguments.json.empty()) (void)carlo::AtomicFile(arguments.json);
  carlo::Page page("Lab 01: integration",
                   "Averages, rules and dice: what an integral costs, in points and in seconds.");
  lab01::Notebook notebook(arguments.options, page);
  const auto start = std::chrono::steady_clock::now();
  run_experiments(notebook);
  what_you_should_see(notebook);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;

  page.fact("Command", command);
  page.fact("Seed", std::to_string(arguments.options.seed));
  page.fact("Machine", carlo::machine_text());
  page.fact("Compiler", carlo::compiler_text());
  for (const std::string& reason : notebook.left_out()) {
    fmt::print("{}\n", carlo::coloured(carlo::Colour::yellow, reason));
  }
  if (!arguments.json.empty()) {
    carlo::write_file(arguments.json, results(notebook, arguments, spent.count()).dump(2) + "\n");
  }
  fmt::print("{:.1f} s in all.\n", spent.count());
  if (!arguments.no_page) {
    page.write(arguments.page);
    fmt::print("The page with the plots: {}\n",
               std::filesystem::absolute(arguments.page).lexically_normal().string());
  }
}

/// The command as one could type it again: without the folder the program stands in.
std::string command_line(int argc, char** argv) {
  std::string command = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i)
    command += fmt::format(" {}", argv[i]);
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    Arguments arguments;
    CLI::App app("Lab 01: integration. Runs the lab's experiments on the exercises done so far.",
                 "./carlo lab 1");
    auto* n = app.add_option("--n", arguments.options.n, "largest number of points, >= 1024");
    n->check(CLI::Range(std::int64_t{1024}, std::int64_t{1} << 30))->capture_default_str();
    app.add_option("--seed", arguments.options.seed, "seed of all random numbers")
        ->capture_default_str();
    app.add_flag("--quick", arguments.options.quick, "fewer points and repetitions");
    app.add_option("--json", arguments.json, "write all tables to this file");
    app.add_option("--page", arguments.page, "where the page goes")->capture_default_str();
    app.add_flag("--no-page", arguments.no_page, "write no page");
    if (const auto code = carlo::parse_arguments(app, argc, argv)) return *code;
    if (arguments.options.quick && n->count() == 0) arguments.options.n = 1 << 14;
    run(arguments, command_line(argc, argv));
    return 0;
  });
}
