#pragma once

#include "course/verbs/run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::verbs {

/// A lab by the name of its folder, such as 07_hemisphere.
struct LabFolder {
  std::string name;

  std::string digits() const { return name.substr(0, 2); }
  int number() const;
  std::string program(const char* what = "") const { return joined({"lab", digits(), what}); }
};

/// An exercise as it is typed: 1.2.
struct ExerciseNumber {
  LabFolder lab;
  std::string text;
};

/// The tree in which ./carlo stands.
struct Tree {
  std::filesystem::path root;

  /// Holds all solutions, so the whole suite. A student's tree has at most those of earlier labs.
  bool has_solutions() const;
  /// Throws Error, which says that this is a student's tree and `without` what, unless it has them.
  void needs_solutions(const std::string& without) const;

  /// All labs of the course in order: folders NN_name of labs/ with a lab.json.
  std::vector<LabFolder> labs() const;
  /// The lab that is meant by 7, 07, 07_hemisphere or labs/07_hemisphere/hemisphere.cpp. Throws
  /// Error that says which there are.
  LabFolder lab(const std::string& typed) const;
  std::filesystem::path lab_json(const LabFolder& lab) const;
  /// The text of all that a student writes in a lab.
  std::string own_text(const LabFolder& lab) const;
  /// The exercise that is meant by 1.2 or "Lab 1.2". Throws Error that says which there are.
  ExerciseNumber exercise(const std::string& typed) const;

  /// The text about a verb in common/course/verbs.txt.
  std::string help(const std::string& verb) const;
  void print_help(const std::string& verb) const;

  /// Installs what these groups of packages lack (common/course/setup.sh). Throws Leave.
  void need(const Words& groups) const;
};

}  // namespace carlo::verbs
