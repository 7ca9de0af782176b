#pragma once

#include "course/verbs/run.h"
#include "course/verbs/tree.h"

#include <filesystem>
#include <optional>
#include <string>

namespace carlo::verbs {

/// A folder of builds, build/PRESET, and how it is brought up to date: alone in it, with a line
/// that says how far it is, and with the compiler's words explained when it fails.
class Building {
 public:
  Building(const Tree& tree, const std::string& preset);

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path program(const std::string& name) const { return folder_ / "bin" / name; }
  /// This process's copy of a program that it built with `keep`: the next build, perhaps another's,
  /// does not change it.
  std::filesystem::path kept(const std::string& name) { return own().path() / name; }
  const OwnFolder& own();

  /// Builds targets, and keeps copies of these programs. Throws Leave when it was stopped, Error
  /// when it fails.
  void build(const Words& targets, const Words& keep = {});
  /// For what only reads: does not wait for another's build where the program is up to date.
  void build_unless_there(const std::string& target);
  /// Has the vector kernel compiled for all machines; once asked for, the build stays so.
  void every_instruction_set();
  /// Runs CMake: it looks again for libraries that were installed since.
  void configure_anew(const Words& options = {});

 private:
  void configure();
  Words in_turn() const;
  /// How many steps the targets' build has.
  std::size_t steps(const Words& targets) const;
  void must_be_writable() const;
  /// Throws: says what the compiler said, a student's file first and short.
  [[noreturn]] void failed(int code, const std::string& said);
  void explain(const std::string& said);

  const Tree* tree_;
  std::string preset_;
  std::filesystem::path folder_;
  std::optional<OwnFolder> own_;
};

}  // namespace carlo::verbs
