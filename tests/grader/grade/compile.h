#pragma once

#include "grader/grade/clean_tree.h"
#include "grader/judge/sandbox.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo::grader {

/// The result of compiling a lab's exercise files.
struct Compiled {
  bool linked = false;               ///< the worker exists
  std::string messages;              ///< the compiler's, warnings too; for the student
  std::vector<std::string> refused;  ///< files that do not compile; the stub replaces them
  std::vector<std::string> misfits;  ///< files that compile, but cannot be linked; likewise
  std::string own_names;             ///< names that several files define; each uses its own
  double seconds = 0;
  std::size_t peak_bytes = 0;
};

/// The folders of one submission: `ours`, for what we keep, and `theirs`, for the folders of
/// programs in the sandbox.
struct Folders {
  std::filesystem::path ours, theirs;
};

/// Compiles exercise files in the sandbox, where they see only the headers of the clean tree, and
/// links them, in a second sandbox where none of their text is interpreted, into `worker`. In a lab
/// with several files, one that does not compile, or cannot be linked with those before it, counts
/// as not done.
///
/// A failure is the student's only if it is proven: the stub can be compiled (or linked) right
/// after it, the same step fails again after that, and its messages do not blame the machine.
/// Otherwise throws Error.
Compiled compile(const std::map<std::string, std::string>& files, const LabTools& tools,
                 const Sandbox& sandbox, const Folders& folders,
                 const std::filesystem::path& worker);

using Objects = std::map<std::string, std::filesystem::path>;  // by exercise file

/// Compiles the files as compile() does, with more flags, and links nothing. Returns nothing if the
/// files, and not the machine, are to blame.
std::optional<Objects> compile_objects(const std::map<std::string, std::string>& files,
                                       const LabTools& tools, const Sandbox& sandbox,
                                       const Folders& folders,
                                       const std::vector<std::string>& flags);

}  // namespace carlo::grader
