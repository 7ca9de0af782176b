#pragma once

#include "grader/grade/clean_tree.h"
#include "grader/grade/foreign_symbols.h"
#include "grader/judge/sandbox.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// The compiler and its flags, the course's headers, and nothing of a file.
std::vector<std::string> compile_command(const LabTools& tools);

/// One lab's compilation in the sandbox: everything that stays the same from file to file, and the
/// time that is left for all of them.
class Compilation {
 public:
  /// `folder`: where each step has a folder of its own, the sandbox's to write into, while it runs.
  Compilation(const LabTools& tools, const Sandbox& sandbox, const std::filesystem::path& folder);

  /// Compiles one file to `object`, which keeps to itself. False when it does not compile, or
  /// would put itself in the place of our code.
  bool make(const std::string& name, const std::string& text, const std::filesystem::path& object,
            std::string& messages);

  /// Whether what failed last may have failed because of the machine.
  bool in_doubt() const { return in_doubt_; }

  /// The symbols of an object; none where nm cannot read it.
  Symbols symbols_of(const std::filesystem::path& object);

  /// Gives names of an object new ones. Where that fails it stays as it is, and the linker has the
  /// last word.
  void rename(const std::filesystem::path& object, const std::string& redefinitions);

  /// Links objects into `worker`. The flags keep the linker from running plugins on what students'
  /// objects hold.
  bool link(const std::vector<std::filesystem::path>& objects, const std::filesystem::path& worker,
            std::string& messages);

  std::size_t peak_bytes() const { return peak_; }

 private:
  /// Compiles one file to `object`. False when it does not compile.
  bool compile(const std::string& name, const std::string& text,
               const std::filesystem::path& object, std::string& messages);
  /// False, and says why, when an object would put itself in the place of our code or calls into
  /// it.
  bool keeps_apart(const std::string& name, const std::filesystem::path& object,
                   std::string& messages);
  /// nm's list of an object or archive. Without plugin: that of a link-time optimiser believes what
  /// an object says of itself in a section of its own, and looks no further.
  Outcome symbols_in(const std::filesystem::path& file);
  /// The compiler on a file of the sandbox's folder; `ahead` names a header that it reads before
  /// it, or none.
  Outcome compile_in(const std::filesystem::path& work, const std::filesystem::path& source,
                     const std::string& ahead);
  /// A compiler or linker, as long as the lab's time lasts.
  Outcome run(const std::vector<std::string>& argv, const View& view);

  const LabTools& tools_;
  const Sandbox& sandbox_;
  std::filesystem::path folder_;
  Symbols ours_;  ///< of all that is linked but the exercises
  std::chrono::milliseconds left_;
  std::size_t peak_ = 0;
  bool in_doubt_ = false;
};

}  // namespace carlo::grader
