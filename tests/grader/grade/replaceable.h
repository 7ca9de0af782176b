#pragma once

#include "grader/grade/clean_tree.h"
#include "grader/grade/compile.h"
#include "grader/judge/sandbox.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// Returns whether a linker name is that of an exercise's function in the lab's namespace, whatever
/// its parameters. `function` as in lab.json: "average", "Moments::add", "Table::Table".
bool is_symbol_of(const std::string& symbol, const std::string& name_space,
                  const std::string& function);

/// A submission's exercise files, compiled once more so that functions can be replaced when it is
/// linked: calls go by the function's name, so the compiler neither inlines nor specialises one
/// that other files could call (-fsemantic-interposition). What is local to a file stays as it is:
/// a student's own copy of a function is not replaced.
class ReplaceableCode {
 public:
  /// Compiles in a folder of its own below `folders.ours`. `files`: those that were linked.
  ReplaceableCode(const std::map<std::string, std::string>& files, const LabTools& tools,
                  const Sandbox& sandbox, const Folders& folders);

  /// Whether the files compile this way, too.
  bool compiled() const { return objects_.has_value(); }

  /// Links a worker in which these functions are the suite's. Of the suite's code it holds nothing
  /// else: neither another function of an exercise that anybody could call, nor code that these do
  /// not need. Throws Error.
  void link(const std::vector<std::string>& functions, const std::filesystem::path& worker);

 private:
  std::filesystem::path solution_object(const std::string& file, const std::string& text);
  bool is_one_of(const std::string& symbol, const std::vector<std::string>& functions) const;

  const LabTools& tools_;
  const Sandbox& sandbox_;
  Folders folders_;
  std::optional<Objects> objects_;
};

}  // namespace carlo::grader
