#pragma once

#include "course/guide/exercises.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo {

/// Returns the existing files of a lab that a student writes, below the folder `labs` of all labs:
/// NN_name/name.cpp or, for a lab in steps, NN_name/steps/*.cpp in order.
std::vector<std::filesystem::path> own_files(const std::filesystem::path& labs, const Lab& lab);

/// True if a path, relative to the tree, is such a file of some lab.
bool is_own_file(const std::filesystem::path& relative);

/// A snapshot of a student's files of one lab, split into exercises: an exercise's part runs from
/// its heading "// Lab N.M" to the next heading.
class OwnCode {
 public:
  /// A file that cannot be read, because an editor is just replacing it, counts as empty.
  OwnCode(const std::filesystem::path& labs, const Lab& lab);

  /// A digest of the whole text: 16 hexadecimal digits.
  std::string digest() const;

  /// A digest of what an exercise depends on: its part, the text before the first heading of its
  /// file, and the parts of the exercises that it uses; of the whole text if it has no heading.
  std::string digest(const Exercise& exercise) const;

  /// The number of the exercise's functions that still report "not implemented".
  int open_functions(const Exercise& exercise) const;

  /// The exercises whose own part differs from that in `before`, in order.
  std::vector<const Exercise*> changed_since(const OwnCode& before) const;

 private:
  struct Part {
    std::string shared;  ///< the text before the first heading
    std::string text;
  };
  void read(const std::string& text);

  const Lab* lab_;
  std::string all_;
  std::map<std::string, Part> parts_;  ///< by tag
};

}  // namespace carlo
