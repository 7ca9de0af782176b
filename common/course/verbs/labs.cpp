// The verbs with which a student works on a lab: lab, status, hint, watch.

#include "cli/error.h"
#include "course/verbs/course.h"

#include <fmt/core.h>

#include <csignal>
#include <cstdlib>

namespace carlo::verbs {
namespace {

std::string lab_name(const LabFolder& lab) {
  return "lab " + std::to_string(lab.number());
}

/// What made a program end so; nothing when it is no crash.
std::string crash_of(int code) {
  // Whoever reads the tables may stop early (| head): 141.
  if (code <= 128 || code == 128 + SIGINT || code == 128 + SIGPIPE) return "";
  switch (code - 128) {
    case SIGSEGV:
    case SIGBUS:
      return "a bad access to memory, or a recursion without end";
    case SIGFPE:
      return "a division of a whole number by zero";
    case SIGABRT:
      return "abort; what led to it stands above";
    default:
      return code - 128 > 64 ? fmt::format("exit code {}", code)
                             : fmt::format("signal {}", code - 128);
  }
}

/// The lab of what is next for the student.
LabFolder next_lab(Course& course) {
  course.building.build({"carlo_course"});
  const std::string next = output_of(
      {course.building.program("carlo_course"), "status", "--root", course.tree.root, "--next"});
  return course.tree.lab(next.substr(0, next.find('.')));
}

}  // namespace

std::string value_behind(const Words& words, std::size_t& i, const std::string& verb) {
  if (i + 1 == words.size())
    throw Error(words[i] + " needs a value (see ./carlo " + verb + " --help)");
  return words[++i];
}

void unknown(const std::string& verb, const std::string& word) {
  throw Error(verb + " does not know '" + word + "' (see ./carlo " + verb + " --help)");
}

int run_students_code(Course& course, const LabFolder& lab, const std::string& verb,
                      const std::string& program, const Words& arguments) {
  course.building.build({program}, {program});
  // The tree in which predictions are kept; of the solutions nobody predicts anything.
  const std::string end = "_solution";
  if (program.size() < end.size() || program.substr(program.size() - end.size()) != end)
    ::setenv("CARLO_COURSE", course.tree.root.c_str(), 1);
  Words command{course.building.kept(program)};
  const int code = run(command += arguments);
  const std::string crash = crash_of(code);
  if (crash.empty()) return code;
  throw Error(
      fmt::format("the lab's program crashed: {}\n"
                  "  In which exercise: ./carlo test {}\n"
                  "  In which line (it builds for minutes, once): CARLO_PRESET=debug "
                  "./carlo {}",
                  crash, lab.number(), verb));
}

int lab(Course& course, const Words& words) {
  if (words.empty()) {
    course.tree.print_help("lab");
    return 1;
  }
  if (words[0][0] == '-')
    throw Error("first comes the lab's number, then its options: ./carlo lab N " +
                joined(words, " "));
  const LabFolder folder = course.tree.lab(words[0]);
  std::string program = folder.program();
  Words arguments;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] != "--solutions") {
      arguments.push_back(words[i]);
      continue;
    }
    if (!std::filesystem::exists(course.tree.root / "solutions" / folder.name))
      throw Error("this tree has no solution of " + lab_name(folder));
    program = folder.program("_solution");
  }
  return run_students_code(course, folder, lab_name(folder), program, arguments);
}

int status(Course& course, const Words& words) {
  course.building.build_unless_there("carlo_course");
  Words command{course.building.program("carlo_course"), "status", "--root", course.tree.root};
  throw HandOver{command += words};
}

int hint(Course& course, const Words& words) {
  if (words.empty()) {
    course.tree.print_help("hint");
    return 1;
  }
  const bool all_first = words[0] == "--all";
  const std::size_t at = all_first ? 1 : 0;
  const ExerciseNumber exercise = course.tree.exercise(at < words.size() ? words[at] : "");
  if (at + 1 < words.size()) {
    const std::string& which = words[at + 1];
    if (which[0] != '-' && !is_number(which, which.size()))
      throw Error("hint takes one exercise, and perhaps which of its hints, as 2; got " +
                  exercise.text + " and " + which);
  }
  course.building.build_unless_there("carlo_course");
  Words command{course.building.program("carlo_course"), "hint", "--root", course.tree.root,
                exercise.text};
  if (all_first) command += {"--all"};
  const auto rest = words.begin() + static_cast<std::ptrdiff_t>(std::min(at + 1, words.size()));
  throw HandOver{command += Words(rest, words.end())};
}

int watch(Course& course, const Words& words) {
  std::string lab;
  Words options;
  for (const std::string& word : words) {
    if (asks_for_help(word)) {
      course.tree.print_help("watch");
      return 0;
    }
    if (word == "--poll") {
      options.push_back(word);
    } else if (word[0] == '-') {
      unknown("watch", word);
    } else if (!lab.empty()) {
      throw Error("watch takes one lab, got " + lab + " and " + word);
    } else {
      lab = word;
    }
  }
  const LabFolder folder = lab.empty() ? next_lab(course) : course.tree.lab(lab);
  // All but the student's own file, which need not compile yet.
  course.building.build(
      {"carlo_watch", "carlo_course", folder.program("_judge"), folder.program("_probes")});
  Words command{course.building.program("carlo_watch"), "--root", course.tree.root, "--build",
                course.building.folder()};
  throw HandOver{(command += options) += {std::to_string(folder.number())}};
}

}  // namespace carlo::verbs
