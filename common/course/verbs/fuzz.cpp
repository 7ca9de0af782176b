// The verb fuzz: random bytes for all code that reads input from outside.

#include "course/verbs/course.h"

#include <filesystem>

namespace carlo::verbs {
namespace fs = std::filesystem;

static int fuzz(Course& course, const Words& words) {
  const fs::path& root = course.tree.root;
  course.tree.need({"build", "develop"});
  Building fuzzed(course.tree, "fuzz");
  fuzzed.build({"carlo_fuzz", "carlo_render"});
  Words command = list_of(
      {root / "tests/fuzz/run.sh", "--build", fuzzed.folder(), "--keep", root / "out/fuzz"});
  throw HandOver{command += words};
}

static const Verb fuzz_verb("fuzz", fuzz);

}  // namespace carlo::verbs
