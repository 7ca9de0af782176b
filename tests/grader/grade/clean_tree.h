#pragma once

#include "grader/grade/recipe.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// Everything needed to compile and link one lab's workers, copied to a folder of its own.
struct LabTools {
  Recipe recipe;           ///< with the copies' folders and files
  std::string name_space;  ///< of the exercises: "lab01"
  /// The copied header folders and files to link.
  std::vector<std::filesystem::path> headers, inputs;
  /// The course's exercise files, by name.
  std::map<std::string, std::string> stubs;
  /// The suite's solutions of the same files, for what a second judgement replaces; none if the
  /// tree does not have them or no exercise builds on another.
  std::map<std::string, std::string> solutions;
  std::filesystem::path solution_objects;  ///< the folder where they are compiled once for all
};

/// A temporary folder with everything that all submissions need: the headers of common/ and of the
/// labs, probes and libraries. Removed with this object; what a killed grader left behind is
/// removed when the next one starts.
class CleanTree {
 public:
  /// Throws Error.
  CleanTree(const std::filesystem::path& tree, const std::filesystem::path& build,
            const std::vector<CourseLab>& labs);
  ~CleanTree();
  CleanTree(const CleanTree&) = delete;
  CleanTree& operator=(const CleanTree&) = delete;

  const LabTools& tools(int lab) const { return tools_.at(lab); }
  const std::filesystem::path& path() const { return path_; }
  /// A digest of everything copied.
  const std::string& digest() const { return digest_; }

 private:
  void copy_headers(const std::filesystem::path& tree, LabTools& tools);
  static void read_solutions(const std::filesystem::path& folder, const CourseLab& lab,
                             LabTools& tools);
  void copy_inputs(const CourseLab& lab, LabTools& tools);
  std::string digest_of_files() const;

  std::filesystem::path path_;
  int lock_ = -1;
  std::map<int, LabTools> tools_;
  std::string digest_;
};

}  // namespace carlo::grader
