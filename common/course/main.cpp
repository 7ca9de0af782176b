// carlo_course: what a student asks of the course itself, and what the script ./carlo needs for it.

#include "cli/arguments.h"
#include "cli/atomic_file.h"
#include "cli/error.h"
#include "cli/main_guard.h"
#include "cli/wrap.h"
#include "course/compiler_messages.h"
#include "course/hints.h"
#include "course/status.h"
#include "course/verdicts.h"
#include "course/watch/watch.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace carlo;

namespace {

/// What every verb may be told.
struct Options {
  fs::path root = ".";
  std::string exercise;  ///< hint
  int step = 0, lab = 0;
  bool all = false, json = false, next = false;
  std::string file;          ///< keep: the judge's verdicts; explain: the build's log
  std::size_t messages = 3;  ///< explain
  WatchOptions watch;

  fs::path labs() const { return root / "labs"; }
  fs::path state(const char* name) const { return root / ".carlo" / name; }
};

void hint(const Options& options, bool one) {
  const std::vector<Lab> labs = load_labs(options.labs());
  HintState seen(options.state("hints.json"));
  const Exercise& exercise = find_exercise(labs, options.exercise);
  fmt::print("{}", wrapped(options.all ? seen_hints(exercise, seen)
                           : one       ? seen_hint(exercise, options.step, seen)
                                       : next_hint(exercise, seen)));
}

void status(const Options& options) {
  const std::vector<Lab> labs = load_labs(options.labs());
  if (options.lab != 0) (void)find_lab(labs, options.lab);
  const VerdictBook book(options.state("verdicts.json"));
  const HintState hints(options.state("hints.json"));
  std::vector<LabStatus> list;
  for (const Lab& lab : labs) {
    if (options.lab != 0 && lab.number != options.lab) continue;
    list.push_back(status_of(lab, options.labs(), book, hints));
  }
  if (options.next) {
    const Exercise* next = next_exercise(list);
    fmt::print("{}\n", next == nullptr ? labs.back().exercises.back().number() : next->number());
    return;
  }
  const bool all = options.all || options.lab != 0;
  fmt::print("{}", options.json ? status_json(list) : wrapped(status_text(list, all)));
}

void keep(const Options& options) {
  const std::vector<Lab> labs = load_labs(options.labs());
  const Lab& lab = find_lab(labs, options.lab);
  VerdictBook book(options.state("verdicts.json"));
  book.take(read_file(options.file), lab, OwnCode(options.labs(), lab));
  book.save();
}

void explain(const Options& options) {
  const std::string log = read_file(options.file);
  const std::vector<CompilerMessage> messages = compiler_messages(log, options.root);
  fmt::print("{}",
             messages.empty() ? plain_log(log, 40) : compiler_text(messages, options.messages));
}

}  // namespace

int main(int argc, char** argv) {
  return run_main([&] {
    Options options;
    CLI::App app("The course: hints, how far you are, what the compiler means", "./carlo");
    app.require_subcommand(1);
    const auto verb = [&](const char* name, const char* about) {
      CLI::App* added = app.add_subcommand(name, about);
      added->add_option("--root", options.root, "the folder of the tree")->capture_default_str();
      return added;
    };
    CLI::App* hints = verb("hint", "the next hint for an exercise");
    hints->add_option("exercise", options.exercise, "which exercise, such as 1.2")->required();
    CLI::Option* one = hints->add_option("step", options.step, "show this earlier hint again");
    hints->add_flag("--all", options.all, "show all hints that were seen")->excludes(one);
    CLI::App* how_far = verb("status", "what is done, what is next");
    how_far->add_option("lab", options.lab, "this lab alone");
    how_far->add_flag("--all", options.all, "list the exercises of all labs");
    how_far->add_flag("--json", options.json, "for programs");
    how_far->add_flag("--next", options.next, "only the number of the next exercise");
    CLI::App* keeper = verb("keep", "note what the judge said, for status");
    keeper->add_option("lab", options.lab, "which lab")->required();
    keeper->add_option("verdicts", options.file, "the file of its --json")->required();
    CLI::App* explainer = verb("explain", "what a build's log says, the student's file first");
    explainer->add_option("log", options.file, "the log")->required();
    explainer->add_option("--messages", options.messages, "how many")->capture_default_str();
    CLI::App* watcher = verb("watch", "judge an exercise whenever its file is saved");
    watcher->add_option("lab", options.watch.lab, "which lab")->required();
    watcher->add_option("--build", options.watch.build, "where ninja builds")->required();
    watcher->add_flag("--poll", options.watch.look,
                      "look at the files, where the system does not tell of changes");
    if (const auto code = parse_arguments(app, argc, argv)) return *code;

    if (hints->parsed()) hint(options, one->count() > 0);
    if (how_far->parsed()) status(options);
    if (keeper->parsed()) keep(options);
    if (explainer->parsed()) explain(options);
    if (watcher->parsed()) {
      options.watch.root = options.root;
      return watch(options.watch);
    }
    return 0;
  });
}
