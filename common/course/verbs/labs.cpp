// The verbs for working on a lab: lab, status, hint, watch.

#include "course/verbs/course.h"

#include <csignal>
#include <cstdlib>

namespace carlo::verbs {
namespace {

std::string lab_name(const LabFolder& lab) {
  return joined({"lab ", std::to_string(lab.number())});
}

/// Explains a crash by the exit code; "" if it was no crash.
std::string crash_of(int code) {
  // The reader of the output may close the pipe early (| head): 141.
  if (code <= 128 || code == 128 + SIGINT || code == 128 + SIGPIPE) return "";
  switch (code - 128) {
    case SIGSEGV:
    case SIGBUS:
      return "invalid memory access or infinite recursion";
    case SIGFPE:
      return "integer division by zero";
    case SIGABRT:
      return "abort; see the output above";
    default:
      return code - 128 > 64 ? joined({"exit code ", std::to_string(code)})
                             : joined({"signal ", std::to_string(code - 128)});
  }
}

/// Returns the lab of the student's next exercise.
LabFolder next_lab(Course& course) {
  course.building.build({"carlo_course"});
  const std::string next = output_of(
      {course.building.program("carlo_course"), "status", "--root", course.tree.root, "--next"});
  return course.tree.lab(next.substr(0, next.find('.')));
}

}  // namespace

std::string value_behind(const Words& words, std::size_t& i, const std::string& verb) {
  if (i + 1 == words.size()) fail({words[i], " needs a value (see ./carlo ", verb, " --help)"});
  return words[++i];
}

void unknown(const std::string& verb, const std::string& word) {
  fail({verb, " does not know '", word, "' (see ./carlo ", verb, " --help)"});
}

int run_students_code(Course& course, const LabFolder& lab, const std::string& verb,
                      const std::string& program, const Words& arguments) {
  course.building.build({program}, {program});
  // Tells the program where predictions are kept. Solutions ask for none.
  if (program.find("_solution") == std::string::npos)
    ::setenv("CARLO_COURSE", course.tree.root.c_str(), 1);
  Words command = list_of({course.building.kept(program)});
  const int code = run(command += arguments);
  const std::string crash = crash_of(code);
  if (crash.empty()) return code;
  fail({"the lab's program crashed: ", crash, "\n  To find the exercise: ./carlo test ",
        std::to_string(lab.number()),
        "\n  To find the line (the first build takes minutes): CARLO_PRESET=debug ./carlo ", verb});
}

void build_what_comes_next(Course& course, const LabFolder& lab) {
  course.building.build_behind({lab.program("_judge"), lab.program("_worker"), "carlo_course",
                                lab.program(), "carlo_watch"});
}

static int lab(Course& course, const Words& words) {
  if (words.empty()) {
    course.tree.print_help("lab");
    return 1;
  }
  if (words[0][0] == '-')
    fail({"the lab's number comes first, then its options: ./carlo lab N ", joined(words, " ")});
  const LabFolder folder = course.tree.lab(words[0]);
  std::string program = folder.program();
  Words arguments;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] != "--solutions") {
      arguments.push_back(words[i]);
      continue;
    }
    if (!std::filesystem::exists(course.tree.root / "solutions" / folder.name))
      fail({"this tree has no solution of ", lab_name(folder)});
    program = folder.program("_solution");
  }
  const int code = run_students_code(course, folder, lab_name(folder), program, arguments);
  build_what_comes_next(course, folder);
  return code;
}

static int status(Course& course, const Words& words) {
  course.building.build_unless_there("carlo_course");
  Words command =
      list_of({course.building.program("carlo_course"), "status", "--root", course.tree.root});
  throw HandOver{command += words};
}

static int hint(Course& course, const Words& words) {
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
      fail({"hint takes one exercise and, optionally, the number of a hint; got ", exercise.text,
            " and ", which});
  }
  course.building.build_unless_there("carlo_course");
  Words command = list_of(
      {course.building.program("carlo_course"), "hint", "--root", course.tree.root, exercise.text});
  if (all_first) command += {"--all"};
  build_what_comes_next(course, exercise.lab);
  throw HandOver{command += behind(words, at + 1)};
}

static int watch(Course& course, const Words& words) {
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
      fail({"watch takes one lab, got ", lab, " and ", word});
    } else {
      lab = word;
    }
  }
  const LabFolder folder = lab.empty() ? next_lab(course) : course.tree.lab(lab);
  // Builds all but the student's own file, which may not compile yet.
  course.building.build(
      {"carlo_watch", "carlo_course", folder.program("_judge"), folder.program("_probes")});
  Words command = list_of({course.building.program("carlo_watch"), "--root", course.tree.root,
                           "--build", course.building.folder()});
  throw HandOver{(command += options) += {std::to_string(folder.number())}};
}

static const Verb lab_verb("lab", lab), status_verb("status", status), hint_verb("hint", hint),
    watch_verb("watch", watch);

}  // namespace carlo::verbs
