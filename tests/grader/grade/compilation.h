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

/// Returns the compiler, its flags and the course's headers, without any file.
std::vector<std::string> compile_command(const LabTools& tools);

/// One lab's compilation in the sandbox: everything that stays the same from file to file, and the
/// time left for all of them.
class Compilation {
 public:
  /// `folder`: where each running step has its own folder, writable for the sandbox.
  /// `flags`: more of the compiler's, for compiling and for linking.
  Compilation(const LabTools& tools, const Sandbox& sandbox, const std::filesystem::path& folder,
              std::vector<std::string> flags = {});

  /// Compiles one file to `object` and checks that it keeps to itself. Returns false if it does not
  /// compile, or would replace our code.
  bool make(const std::string& name, const std::string& text, const std::filesystem::path& object,
            std::string& messages);

  /// Returns whether the last failure may be the machine's.
  bool in_doubt() const { return in_doubt_; }

  /// Returns the symbols of an object; none if nm cannot read it.
  Symbols symbols_of(const std::filesystem::path& object);

  /// Changes symbols of an object by an option of objcopy that reads `lines` from a file, such as
  /// --redefine-syms. Throws Error.
  void change_symbols(const std::filesystem::path& object, const std::string& option,
                      const std::string& lines);

  /// Links objects into `worker`. The flags keep the linker from running plugins on the contents of
  /// students' objects.
  bool link(const std::vector<std::filesystem::path>& objects, const std::filesystem::path& worker,
            std::string& messages);

  std::size_t peak_bytes() const { return peak_; }

 private:
  /// Compiles one file to `object`. Returns false if it does not compile.
  bool compile(const std::string& name, const std::string& text,
               const std::filesystem::path& object, std::string& messages);
  /// Returns false, and says why, if an object would replace our code or calls into it.
  bool keeps_apart(const std::string& name, const std::filesystem::path& object,
                   std::string& messages);
  /// Runs nm on an object or archive. Without plugin: a link-time optimiser's plugin believes what
  /// an object says about itself in a section of its own, and looks no further.
  Outcome symbols_in(const std::filesystem::path& file);
  /// Runs the compiler on a file in the sandbox's folder; `ahead` names a header that it reads
  /// first, or none.
  Outcome compile_in(const std::filesystem::path& work, const std::filesystem::path& source,
                     const std::string& ahead);
  /// Runs a compiler or linker within the lab's time.
  Outcome run(const std::vector<std::string>& argv, const View& view);

  const LabTools& tools_;
  const Sandbox& sandbox_;
  std::filesystem::path folder_;
  std::vector<std::string> flags_;
  Symbols ours_;  ///< of everything linked except the exercises
  std::chrono::milliseconds left_;
  std::size_t peak_ = 0;
  bool in_doubt_ = false;
};

}  // namespace carlo::grader
