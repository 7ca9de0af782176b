// carlo_course: status, hints and explained compiler messages, for students and for the script
// ./carlo.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/cli/wrap.h"
#include "course/guide/compiler_messages.h"
#include "course/guide/hints.h"
#include "course/guide/status.h"
#include "course/guide/verdicts.h"
#include "support/atomic_file.h"

#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace carlo;

namespace {

/// The options of all verbs.
struct Options {
  fs::path root = ".";
  std::string exercise;  ///< hint
  int number = 0, lab = 0;
  bool all = false, json = false, next = false;
  std::string file;          ///< explain: the build's log
  std::size_t messages = 3;  ///< explain

  fs::path labs() const { return root / "labs"; }
  fs::path state(const char* name) const { return root / ".carlo" / name; }
};

void hint(const Options& options, bool one) {
  const std::vector<Lab> labs = load_labs(options.labs());
  HintState seen(options.state("hints.json"));
  const Exercise& exercise = find_exercise(labs, options.exercise);
  std::string text = options.all ? hint_text(seen_hints(exercise, seen))
                     : one       ? hint_text(seen_hint(exercise, options.number, seen))
                                 : hint_text(next_hint(exercise, seen));
  // A student's tree has the slides' formulas but not the slides.
  if (text.find("(slides ") != std::string::npos && fs::exists(options.labs() / "formulas.md")) {
    text += "\nThe slides' formulas, by these names: labs/formulas.md\n";
  }
  fmt::print("{}", wrapped(text));
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
    CommandLine app("Hints, progress, and compiler messages explained", "./carlo");
    const auto verb = [&](const char* name, const char* about) {
      CommandLine added = app.verb(name, about);
      added.option("--root", options.root, "the folder of the tree").show_default();
      return added;
    };
    CommandLine hints = verb("hint", "show the next hint for an exercise");
    hints.option("exercise", options.exercise, "which exercise, such as 1.2").required();
    const Argument one = hints.option("number", options.number, "show this earlier hint again");
    hints.flag("--all", options.all, "show all hints that were seen").excludes(one);
    CommandLine how_far = verb("status", "what is done, what is next");
    how_far.option("lab", options.lab, "this lab alone");
    how_far.flag("--all", options.all, "list the exercises of all labs");
    how_far.flag("--json", options.json, "for programs");
    how_far.flag("--next", options.next, "only the number of the next exercise");
    CommandLine explainer = verb("explain", "what a build's log says, the student's file first");
    explainer.option("log", options.file, "the log").required();
    explainer.option("--messages", options.messages, "how many").show_default();
    if (const auto code = app.parse(argc, argv)) return *code;

    if (hints.chosen()) hint(options, one.given());
    if (how_far.chosen()) status(options);
    if (explainer.chosen()) explain(options);
    return 0;
  });
}
