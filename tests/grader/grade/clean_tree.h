#pragma once

#include "grader/grade/recipe.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// What is needed to compile and link one lab's workers, copied to a place where nothing else is.
struct LabTools {
  Recipe recipe;           ///< its folders and files are the copies
  std::string name_space;  ///< of the exercises: "lab01"
  /// The folders of headers and the files to link that are copies.
  std::vector<std::filesystem::path> headers, inputs;
  /// The exercise files as the course gives them, by name.
  std::map<std::string, std::string> stubs;
};

/// A folder of temporary files that holds what all submissions need: the headers of common/ and of
/// the labs, probes and libraries. It goes with this object; what a killed grader left behind goes
/// when the next one starts.
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
  /// A digest of all that was copied.
  const std::string& digest() const { return digest_; }

 private:
  void copy_headers(const std::filesystem::path& tree, LabTools& tools);
  void copy_inputs(const CourseLab& lab, LabTools& tools);
  std::string digest_of_files() const;

  std::filesystem::path path_;
  int lock_ = -1;
  std::map<int, LabTools> tools_;
  std::string digest_;
};

}  // namespace carlo::grader
