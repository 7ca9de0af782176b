#pragma once

#include "grader/grade/exercise_files.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// Where one submission stands: a folder, an archive, or a part of an archive.
struct Source {
  std::string name;  ///< of its output folder: unique, harmless as a file name
  std::filesystem::path path;
  std::string inside = {};  ///< within an archive of many: its folder, or its own archive
  bool renamed = false;     ///< another submission has the name that this one would have

  /// "class.zip/alice": the name of `path`, and what is inside.
  std::string handed_in() const;
};

struct Submissions {
  std::vector<Source> sources;
  std::vector<std::string> left_out;  ///< files and links beside them, in a folder of a class
};

/// Finds the submissions in `paths`. A path that holds exercise files, or labs, at its top is one
/// submission (`one`: whatever it looks like); another folder or archive holds one in each of its
/// folders and archives, as Gradescope and Moodle export them. Of several that would have one name,
/// that one keeps it whose own it is, letter for letter (of "a_b" and "a b" the first), a folder
/// before an archive. Throws Error when there is none, or a folder may be one submission or
/// several.
Submissions find_submissions(const std::vector<std::filesystem::path>& paths,
                             const std::vector<CourseLab>& labs, bool one);

/// What of a submission belongs to one lab.
struct LabFiles {
  std::map<std::string, std::string>
      files;                          ///< by the names of CourseLab; missing ones are not there
  std::vector<std::string> problems;  ///< why a file cannot be taken; then the lab is not judged
};

struct Intake {
  std::map<int, LabFiles> labs;      ///< by number
  std::vector<std::string> ignored;  ///< what else was handed in, and what was refused
  std::string digest;                ///< of all that is judged
};

/// Reads a submission. Exercise files are known by the end of their path; two of the same name must
/// have the same content. Line ends and a byte order mark are made plain. Throws Error only when
/// the source is not there any more.
Intake take_in(const Source& source, const std::vector<CourseLab>& labs);

}  // namespace carlo::grader
