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

/// An exercise as typed: 1.2.
struct ExerciseNumber {
  LabFolder lab;
  std::string text;
};

/// The tree that ./carlo lies in.
struct Tree {
  std::filesystem::path root;

  /// True if it holds all solutions, and so is the whole suite. A student's tree has at most those
  /// of earlier labs.
  bool has_solutions() const;
  /// Throws Error, which says that a student's tree comes without `without`, unless it has the
  /// solutions.
  void needs_solutions(const std::string& without) const;

  /// Returns all labs of the course in order: folders NN_name of labs/ with a lab.json.
  std::vector<LabFolder> labs() const;
  /// Finds the lab for 7, 07, 07_hemisphere or labs/07_hemisphere/hemisphere.cpp. Throws Error that
  /// lists the available labs.
  LabFolder lab(const std::string& typed) const;
  std::filesystem::path lab_json(const LabFolder& lab) const;
  /// Returns the text of all files that a student writes in a lab.
  std::string own_text(const LabFolder& lab) const;
  /// The number of exercises.
  int exercises(const LabFolder& lab) const;
  /// Whether the body of every function that a student writes in a lab is still nothing but its
  /// not_implemented line.
  bool is_untouched(const LabFolder& lab) const;
  /// Finds the exercise for 1.2 or "Lab 1.2". Throws Error that lists the available exercises.
  ExerciseNumber exercise(const std::string& typed) const;

  /// Returns the help for a verb from common/course/verbs.txt.
  std::string help(const std::string& verb) const;
  void print_help(const std::string& verb) const;

  /// Installs the missing packages of these groups (common/course/setup.sh). Throws Leave.
  void need(const Words& groups) const;
};

}  // namespace carlo::verbs
