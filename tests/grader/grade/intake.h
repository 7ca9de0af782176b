#pragma once

#include "grader/grade/exercise_files.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// The place of one submission: a folder, an archive, or a part of an archive.
struct Source {
  std::string name;  ///< name of its output folder: unique, harmless as a file name
  std::filesystem::path path;
  std::string inside = {};  ///< in an archive of many: its folder, or its own archive
  bool renamed = false;     ///< another submission has the name that this one would have

  /// Returns "class.zip/alice": the name of `path`, and `inside`.
  std::string handed_in() const;
};

struct Submissions {
  std::vector<Source> sources;
  std::vector<std::string> left_out;  ///< files and links beside them, in a class's folder
};

/// Finds the submissions in `paths`. A path with exercise files, or labs, at its top is one
/// submission (`one`: whatever it contains); any other folder or archive holds one in each of its
/// folders and archives, like exports from Gradescope and Moodle. If several would have the same
/// name, it goes to the one whose own name it is exactly (for "a_b" and "a b" the first), to a
/// folder before an archive. Throws Error if there is none, or if a folder may be one submission or
/// several.
Submissions find_submissions(const std::vector<std::filesystem::path>& paths,
                             const std::vector<CourseLab>& labs, bool one);

/// The part of a submission that belongs to one lab.
struct LabFiles {
  std::map<std::string, std::string>
      files;                          ///< by the names of CourseLab; missing files are absent
  std::vector<std::string> problems;  ///< why a file cannot be accepted; then the lab is not judged
};

struct Intake {
  std::map<int, LabFiles> labs;      ///< by number
  std::vector<std::string> ignored;  ///< what else was handed in, and what was refused
  std::string digest;                ///< of everything judged
};

/// Reads a submission. Exercise files are recognised by the end of their path; two of the same name
/// must have the same content. Line ends are normalised and a byte order mark is removed. Throws
/// Error only if the source no longer exists.
Intake take_in(const Source& source, const std::vector<CourseLab>& labs);

}  // namespace carlo::grader
