// The verb replay: repeats what the judge asked an exercise.

#include "course/verbs/course.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

struct ReplayWishes {
  std::string exercise, probe;
  Words seed, options;
  bool debugger = false, help = false;
};

ReplayWishes replay_wishes(const Words& words) {
  ReplayWishes wishes;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (asks_for_help(word)) {
      wishes.help = true;
      return wishes;
    }
    if (word == "--gdb") {
      wishes.debugger = true;
    } else if (word == "--all") {
      wishes.options.push_back(word);
    } else if (word == "--seed") {
      wishes.seed = {word, value_behind(words, i, "replay")};
    } else if (word == "--probe") {
      wishes.probe = value_behind(words, i, "replay");
    } else if (word[0] == '-') {
      unknown("replay", word);
    } else if (!wishes.exercise.empty()) {
      fail({"replay takes one exercise, got ", wishes.exercise, " and ", word});
    } else {
      wishes.exercise = word;
    }
  }
  return wishes;
}

/// Runs the judge so that it writes down its questions.
void write_questions(const Tree& tree, Building& building, const ExerciseNumber& exercise,
                     const fs::path& file, const Words& seed) {
  const std::string judge = exercise.lab.program("_judge"),
                    worker = exercise.lab.program("_worker");
  building.build({judge, worker, "carlo_replay"}, {judge, worker});
  std::error_code ec;
  fs::create_directories(file.parent_path(), ec);
  fs::remove(file, ec);
  Words command = list_of({building.kept(judge), "--lab", tree.lab_json(exercise.lab), "--exercise",
                           exercise.text, "--worker", building.kept(worker), "--probes", file});
  // The exit code says whether the exercise passes, which does not matter here.
  std::string report;
  run_gathering(command += seed, {}, report);
  if (interrupted()) throw Leave{130};
  if (!fs::exists(file)) fail({"the judge did not finish (see above)"});
}

}  // namespace

static int replay(Course& course, const Words& words) {
  ReplayWishes wishes = replay_wishes(words);
  if (wishes.help) {
    course.tree.print_help("replay");
    return 0;
  }
  const ExerciseNumber exercise = course.tree.exercise(wishes.exercise);
  const bool chosen = std::getenv("CARLO_PRESET") != nullptr;
  if (wishes.debugger) {
    if (wishes.probe.empty()) fail({"--gdb needs --probe: which question?"});
    if (!is_installed("gdb")) fail({"the debugger is not installed; as root: apt-get install gdb"});
    wishes.options += {"--debugger", "gdb"};
  }
  const fs::path questions =
      course.tree.root / "out" / (joined({"replay_", exercise.text, ".json"}));
  Building release(course.tree, "release");
  write_questions(course.tree, release, exercise, questions, wishes.seed);
  const std::string worker = exercise.lab.program("_worker");
  fs::path asked = release.program(worker);
  if (!wishes.probe.empty()) {
    wishes.options += {"--probe", wishes.probe};
    Building wanted(course.tree, wishes.debugger && !chosen ? "debug" : course.preset);
    wanted.build({worker});
    asked = wanted.program(worker);
  }
  Words command =
      list_of({release.program("carlo_replay"), exercise.text, "--lab",
               course.tree.lab_json(exercise.lab), "--questions", questions, "--worker", asked});
  throw HandOver{command += wishes.options};
}

static const Verb replay_verb("replay", replay);

}  // namespace carlo::verbs
