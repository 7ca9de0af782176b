#pragma once

#include "course/verbs/building.h"
#include "course/verbs/tree.h"

#include <string>

// The verbs of ./carlo. Each takes the words behind it, and returns the exit code; it throws Error
// (one line), Leave (nothing more to say) or HandOver (another program goes on).

namespace carlo::verbs {

/// What a verb works with.
struct Course {
  Tree tree;
  std::string preset;  ///< CARLO_PRESET, or release
  Building building;
};

int lab(Course& course, const Words& words);
int test(Course& course, const Words& words);
int status(Course& course, const Words& words);
int hint(Course& course, const Words& words);
int watch(Course& course, const Words& words);
int replay(Course& course, const Words& words);
int render(Course& course, const Words& words);
int merge(Course& course, const Words& words);
int grade(Course& course, const Words& words);
int bench(Course& course, const Words& words);
int slides(Course& course, const Words& words);
int fuzz(Course& course, const Words& words);

/// Builds a student's program and runs it; explains a crash. `verb` is what was typed behind
/// ./carlo. A render that Ctrl-C ended has written what was finished, and returns 130.
int run_students_code(Course& course, const LabFolder& lab, const std::string& verb,
                      const std::string& program, const Words& arguments);

/// The value behind words[i], which moves there. Throws Error that names the verb's help.
std::string value_behind(const Words& words, std::size_t& i, const std::string& verb);
/// Of an option that the verb does not have.
[[noreturn]] void unknown(const std::string& verb, const std::string& word);

}  // namespace carlo::verbs
