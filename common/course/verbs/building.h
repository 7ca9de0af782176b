#pragma once

#include "course/verbs/run.h"
#include "course/verbs/tree.h"

#include <filesystem>
#include <optional>
#include <string>

namespace carlo::verbs {

/// A build folder, build/PRESET: brings it up to date, under a lock, shows the progress in one
/// line, and explains the compiler's messages if the build fails.
class Building {
 public:
  Building(const Tree& tree, const std::string& preset);

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path program(const std::string& name) const { return folder_ / "bin" / name; }
  /// The path of this process's copy of a program that it built with `keep`; later builds, perhaps
  /// by other processes, do not change it.
  std::filesystem::path kept(const std::string& name) { return own().path() / name; }
  const OwnFolder& own();

  /// Builds targets and copies the programs in `keep`. Throws Leave if stopped, Error if the build
  /// fails.
  void build(const Words& targets, const Words& keep = {});
  /// For verbs that only read: does not wait for another process's build if the program is up to
  /// date.
  void build_unless_there(const std::string& target);
  /// Goes on building in the background, while the user reads, what is asked for next; any other
  /// build ends it. Only where somebody sits at a terminal: a script would find the folder busy.
  void build_behind(const Words& targets);
  /// Compiles the vector kernel for all machines, from now on in every build.
  void every_instruction_set();
  /// Runs CMake, which looks again for newly installed libraries.
  void configure_anew(const Words& options = {});

 private:
  void configure();
  Words in_turn() const;
  /// The number of steps to build the targets.
  std::size_t steps(const Words& targets) const;
  void must_be_writable() const;
  /// Throws, with the compiler's messages: short, and those about a student's file first.
  [[noreturn]] void failed(int code, const std::string& said);
  void explain(const std::string& said);

  const Tree* tree_;
  std::string preset_;
  std::filesystem::path folder_;
  std::optional<OwnFolder> own_;
};

}  // namespace carlo::verbs
