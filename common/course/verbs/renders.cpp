// The verbs render and merge.

#include "course/verbs/course.h"

#include <filesystem>

namespace carlo::verbs {
namespace fs = std::filesystem;

static int render(Course& course, const Words& words) {
  const Tree& tree = course.tree;
  const bool mine = !tree.has_solutions() || is_one_of("--mine", words);
  Words arguments = list_of({"--default-scene", tree.root / "common/scenes/cornell_phong.xml"});
  bool elsewhere = false;
  for (const std::string& word : words) {
    if (word != "--mine") arguments.push_back(word);
    elsewhere = elsewhere || word.starts_with("--slurm") || word.starts_with("--shard");
  }
  // With the student's lab 8.
  if (mine) {
    if (!fs::exists(tree.root / "labs/08_path_tracer"))
      fail({"this tree has no renderer: it is what lab 8 builds"});
    return run_students_code(course, tree.lab("8"), "render --mine", "lab08_render", arguments);
  }
  // Other machines may need instruction sets other than the widest of this one.
  if (elsewhere) course.building.every_instruction_set();
  course.building.build({"carlo_render"});
  Words command = list_of({course.building.program("carlo_render")});
  throw HandOver{command += arguments};
}

static int merge(Course& course, const Words& words) {
  course.building.build({"carlo_merge"});
  Words command = list_of({course.building.program("carlo_merge")});
  throw HandOver{command += words};
}

static const Verb render_verb("render", render), merge_verb("merge", merge);

}  // namespace carlo::verbs
