#pragma once

#include "course/verbs/building.h"
#include "course/verbs/tree.h"

#include <string>

// The verbs of ./carlo. Each takes the words behind it and returns the exit code; it throws Error
// (one line), Leave (nothing more to say) or HandOver (another program takes over).

namespace carlo::verbs {

/// The context of all verbs.
struct Course {
  Tree tree;
  std::string preset;  ///< CARLO_PRESET, by default release
  Building building;
};

/// A verb of this program. Each registers itself in the file that defines it, so that a student's
/// tree, which has fewer verbs, compiles fewer files (CMakeLists.txt).
class Verb {
 public:
  using Function = int (*)(Course& course, const Words& words);
  Verb(const char* name, Function run);
  /// Throws Error if there is no verb of that name.
  static Function find(const std::string& name);

 private:
  const char* name_;
  Function run_;
  const Verb* before_;
};

/// Builds a student's program and runs it; explains a crash. `verb` is what was typed behind
/// ./carlo. A render stopped by Ctrl-C has written its finished samples, and 130 is returned.
int run_students_code(Course& course, const LabFolder& lab, const std::string& verb,
                      const std::string& program, const Words& arguments);

/// Builds in the background what a student of this lab asks for next: the judge, the experiments,
/// hints and status.
void build_what_comes_next(Course& course, const LabFolder& lab);

/// Returns the value behind words[i] and moves i there. Throws Error that names the verb's help.
std::string value_behind(const Words& words, std::size_t& i, const std::string& verb);
/// Installs what package.json in the tree's folder `from` names into the tree's folder `to`, in the
/// versions of package-lock.json, unless it is there; `what` says what that is.
void install_packages(const Tree& tree, const std::string& from, const std::string& to,
                      const std::string& what);
/// Throws Error about an option that the verb does not have.
[[noreturn]] void unknown(const std::string& verb, const std::string& word);

}  // namespace carlo::verbs
