// The verbs about renders and classes: render, merge, grade, fuzz.

#include "cli/error.h"
#include "course/verbs/course.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

bool starts_with(const std::string& word, const std::string& start) {
  return word.rfind(start, 0) == 0;
}

/// The labs that --labs names, or all.
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
  course.tree.needs_solutions("solutions, which calibration judges");
  Words targets{"carlo_calibrate"};
  for (const LabFolder& lab : named_labs(course.tree, words))
    targets += {lab.program("_judge"), lab.program("_worker_solution"), lab.program("_mistakes")};
  course.building.build(targets);
  Words command{course.building.program("carlo_calibrate"),
                "--tree-labs",
                course.tree.root / "labs",
                "--tree-tests",
                course.tree.root / "tests",
                "--programs",
                course.building.folder() / "bin"};
  throw HandOver{command += words};
}

}  // namespace

int render(Course& course, const Words& words) {
  const Tree& tree = course.tree;
  const bool mine = !tree.has_solutions() || is_one_of("--mine", words);
  Words arguments{"--default-scene", tree.root / "common/scenes/cornell_phong.xml"};
  std::copy_if(words.begin(), words.end(), std::back_inserter(arguments),
               [](const std::string& word) { return word != "--mine"; });
  // By the student's lab 08.
  if (mine) {
    if (!fs::exists(tree.root / "labs/08_path_tracer"))
      throw Error("this tree has no renderer: it is what lab 08 builds");
    return run_students_code(course, tree.lab("8"), "render --mine", "lab08_render", arguments);
  }
  // What renders elsewhere as well needs other instruction sets than this machine's widest.
  if (std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return starts_with(word, "--slurm") || starts_with(word, "--shard");
      }))
    course.building.every_instruction_set();
  course.building.build({"carlo_render"});
  Words command{course.building.program("carlo_render")};
  throw HandOver{command += arguments};
}

int merge(Course& course, const Words& words) {
  course.building.build({"carlo_merge"});
  Words command{course.building.program("carlo_merge")};
  throw HandOver{command += words};
}

int grade(Course& course, const Words& words) {
  if (!words.empty() && words[0] == "--calibrate")
    return calibrate(course, Words(words.begin() + 1, words.end()));
  Words targets{"carlo_grade"};
  if (std::none_of(words.begin(), words.end(), [](const std::string& word) {
        return asks_for_help(word) || word == "--check-machine";
      })) {
    for (const LabFolder& lab : course.tree.labs())
      targets += {lab.program("_judge"), lab.program("_worker")};
  }
  course.building.build(targets);
  Words command{course.building.program("carlo_grade"), "--tree", course.tree.root, "--build",
                course.building.folder()};
  throw HandOver{command += words};
}

int fuzz(Course& course, const Words& words) {
  const fs::path& root = course.tree.root;
  course.tree.need({"build", "develop"});
  Building fuzzed(course.tree, "fuzz");
  fuzzed.build({"carlo_fuzz", "carlo_render"});
  Words command{root / "tests/fuzz/run.sh", "--build", fuzzed.folder(), "--keep",
                root / "out/fuzz"};
  throw HandOver{command += words};
}

}  // namespace carlo::verbs
