#pragma once

#include "course/guide/exercises.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo {

/// The files of a lab that a student writes, below the folder `labs` of all labs:
/// NN_name/name.cpp or, for a lab in steps, NN_name/steps/*.cpp in order. Those that are there.
std::vector<std::filesystem::path> own_files(const std::filesystem::path& labs, const Lab& lab);

/// Whether a path, relative to the tree, is such a file of any lab.
bool is_own_file(const std::filesystem::path& relative);

/// What a student's files of one lab said when they were read, and which part belongs to which
/// exercise: what stands from the heading "// Lab N.M" to the next one.
class OwnCode {
 public:
  /// A file that cannot be read, because an editor is just replacing it, counts as empty.
  OwnCode(const std::filesystem::path& labs, const Lab& lab);

  /// 16 hexadecimal digits that tell all the text apart from another.
  std::string digest() const;

  /// The same of what one exercise is made of: its part, what stands before the first heading of
  /// that file, and the parts of the exercises that it uses. Of all the text where it has no
  /// heading.
  std::string digest(const Exercise& exercise) const;

  /// How many of the exercise's functions still say that they are not implemented.
  int open_functions(const Exercise& exercise) const;

  /// The exercises whose own part is not the same in `before`, in order.
  std::vector<const Exercise*> changed_since(const OwnCode& before) const;

 private:
  struct Part {
    std::string shared;  ///< what stands before the first heading
    std::string text;
  };
  void read(const std::string& text);

  const Lab* lab_;
  std::string all_;
  std::map<std::string, Part> parts_;  ///< by tag
};

}  // namespace carlo
