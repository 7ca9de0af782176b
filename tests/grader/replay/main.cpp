// carlo_replay: shows what the judge asked one exercise, and repeats one of its questions without
// sandbox and limits, so that students can see the values and follow the code.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/cli/wrap.h"
#include "course/guide/exercises.h"
#include "grader/judge/numbers.h"
#include "grader/judge/run.h"
#include "grader/replay/pick.h"
#include "grader/replay/rerun.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

namespace carlo::grader {
namespace {

struct Options {
  std::string lab, questions, worker, exercise, probe, debugger;
  bool all = false;
};

void add_options(CommandLine& app, Options& options) {
  app.option("exercise", options.exercise, "which exercise, such as 1.2").required();
  app.option("--lab", options.lab, "the lab's lab.json").required();
  app.option("--questions", options.questions, "what the judge wrote with --probes").required();
  app.option("--worker", options.worker, "the worker program to ask");
  app.option("--probe", options.probe, "ask this probe: its number in the list or its name");
  app.option("--debugger", options.debugger, "run it under this debugger");
  app.flag("--all", options.all, "print all rows");
}

const Exercise& exercise_of(const Lab& lab, const std::string& number) {
  const Exercise* exercise = lab.find("Lab " + number);
  if (exercise == nullptr) throw Error("lab {} has no exercise {}", lab.number, number);
  return *exercise;
}

/// Returns the command for one question; omits the seed if it is ./carlo test's default.
std::string again(const Options& options, std::uint64_t seed, std::size_t number) {
  return fmt::format("./carlo replay {}{} --probe {}", options.exercise,
                     seed == local_seed() ? "" : fmt::format(" --seed {}", seed), number);
}

/// Formats every digit, and integers as in reports.
std::string exact(double value) {
  return value == std::floor(value) ? number_in_report(value) : fmt::format("{}", value);
}

/// Returns the probe's arguments by name: the first `most` of its own numbers.
std::string arguments(const Params& params, std::size_t most) {
  std::string text;
  if (params.n != 0) text += fmt::format("n = {}, ", exact(static_cast<double>(params.n)));
  std::size_t shown = 0;
  for (const auto& [name, value] : params.numbers) {
    if (shown == most) break;
    text += fmt::format("{} = {}, ", name, exact(value));
    ++shown;
  }
  if (shown < params.numbers.size()) {
    text += fmt::format("{} more (--all), ", params.numbers.size() - shown);
  }
  return text + fmt::format("seed = {}", params.seed);
}

/// Prints the list, and the next command: for the first question that returned no values.
void show(const Options& options, const Exercise& exercise, const Questions& questions) {
  fmt::print("{}", wrapped(fmt::format("{}  {}  (seed {})\n{}", exercise.tag, exercise.title,
                                       questions.seed, listing(questions.asked))));
  const auto& asked = questions.asked;
  const auto bad = std::find_if(asked.begin(), asked.end(),
                                [](const Asked& one) { return one.status != Status::passed; });
  const std::size_t number = bad == asked.end() ? 1 : number_of(asked, *bad);
  fmt::print("{}", wrapped(fmt::format(
                       "To see the raw values of one question: {}  (with --gdb: in the debugger)\n",
                       again(options, questions.seed, number))));
}

int ask(const Options& options, const Exercise& exercise, const Questions& questions) {
  if (options.worker.empty()) throw Error("--worker is missing: which program is asked?");
  const Asked& asked = pick(questions.asked, options.probe);
  const std::size_t number = number_of(questions.asked, asked);
  fmt::print("{}", wrapped(fmt::format("{}: {}\nProbe {}, \"{}\"{}{}\narguments: {}\n",
                                       exercise.tag, asked.sentence, number, asked.probe,
                                       asked.question.empty() ? "" : ": ", asked.question,
                                       arguments(asked.params, options.all ? SIZE_MAX : 12))));
  const auto words =
      command(options.worker, asked, options.all || !options.debugger.empty() ? 0 : 10);
  if (!options.debugger.empty()) {
    std::string breaks;
    for (const std::string& function : exercise.functions)
      breaks += fmt::format("{}break {}", breaks.empty() ? "" : ", ", function);
    fmt::print("In the debugger type: {}; then run. After a crash, type where.\n", breaks);
    std::fflush(nullptr);
    debug(options.debugger, words);
  }
  std::fflush(nullptr);
  const Rerun result = rerun(words);
  if (!result.crashed) return result.values ? 0 : 1;
  if (!result.place.empty()) {
    throw Error("{} crashed in {}: {}", exercise.tag, result.place, result.how);
  }
  throw Error("{} crashed: {} (its line: CARLO_PRESET=debug {})", exercise.tag, result.how,
              again(options, questions.seed, number));
}

}  // namespace
}  // namespace carlo::grader

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    using namespace carlo::grader;
    carlo::CommandLine app("What the judge asked an exercise", "./carlo replay");
    Options options;
    add_options(app, options);
    if (const auto code = app.parse(argc, argv)) return *code;
    const carlo::Lab lab = carlo::load_lab(options.lab);
    const carlo::Exercise& exercise = exercise_of(lab, options.exercise);
    const Questions questions = questions_from_json(carlo::read_file(options.questions));
    if (!options.probe.empty()) return ask(options, exercise, questions);
    show(options, exercise, questions);
    return 0;
  });
}
