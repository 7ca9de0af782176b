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

/// A verb that this program has: one for each file that defines some, so that a student's tree,
/// which has fewer, compiles fewer (CMakeLists.txt).
class Verb {
 public:
  using Function = int (*)(Course& course, const Words& words);
  Verb(const char* name, Function run);
  /// Throws Error when there is none of that name.
  static Function find(const std::string& name);

 private:
  const char* name_;
  Function run_;
  const Verb* before_;
};

/// Builds a student's program and runs it; explains a crash. `verb` is what was typed behind
/// ./carlo. A render that Ctrl-C ended has written what was finished, and returns 130.
int run_students_code(Course& course, const LabFolder& lab, const std::string& verb,
                      const std::string& program, const Words& arguments);

/// The value behind words[i], which moves there. Throws Error that names the verb's help.
std::string value_behind(const Words& words, std::size_t& i, const std::string& verb);
/// Of an option that the verb does not have.
[[noreturn]] void unknown(const std::string& verb, const std::string& word);

}  // namespace carlo::verbs
