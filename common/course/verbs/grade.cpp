// The verb grade, which grades submissions, or with --calibrate checks the grader itself.

#include "course/verbs/course.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

/// Returns the labs that --labs names, or all.
std::vector<LabFolder> named_labs(const Tree& tree, const Words& words) {
  std::vector<LabFolder> list;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (words[i] != "--labs") continue;
    std::string rest = words[i + 1] + ",";
    for (std::size_t end = 0; (end = rest.find(',')) != std::string::npos; rest.erase(0, end + 1))
      if (end > 0) list.push_back(tree.lab(rest.substr(0, end)));
  }
  return list.empty() ? tree.labs() : list;
}

/// Judges the solutions and the mistakes with many seeds.
int calibrate(Course& course, const Words& words) {
  if (!words.empty() && asks_for_help(words[0])) {
    course.tree.print_help("calibrate");
    return 0;
  }
  course.tree.needs_solutions("the solutions, which --calibrate judges");
  Words targets{"carlo_calibrate"};
  for (const LabFolder& lab : named_labs(course.tree, words))
    targets += {lab.program("_judge"), lab.program("_worker_solution"), lab.program("_mistakes")};
  course.building.build(targets);
  Words command =
      list_of({course.building.program("carlo_calibrate"), "--tree-labs", course.tree.root / "labs",
               "--programs", course.building.folder() / "bin"});
  throw HandOver{command += words};
}

}  // namespace

static int grade(Course& course, const Words& words) {
  if (!words.empty() && words[0] == "--calibrate") return calibrate(course, behind(words, 1));
  Words targets{"carlo_grade"};
  bool grades = true;
  for (const std::string& word : words)
    grades = grades && !asks_for_help(word) && word != "--check-machine";
  // Whatever is missing is missed before hours of grading.
  if (grades && is_one_of("--similarity", words)) {
    course.tree.need({"node"});
    install_packages(course.tree, "tests/grader/similarity", "build/similarity", "Dolos");
  }
  if (grades) {
    for (const LabFolder& lab : course.tree.labs())
      targets += {lab.program("_judge"), lab.program("_worker")};
  }
  course.building.build(targets);
  Words command = list_of({course.building.program("carlo_grade"), "--tree", course.tree.root,
                           "--build", course.building.folder()});
  throw HandOver{command += words};
}

static const Verb grade_verb("grade", grade);

}  // namespace carlo::verbs
