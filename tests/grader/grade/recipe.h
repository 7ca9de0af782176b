#pragma once

#include "grader/grade/exercise_files.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// How the build compiles one lab's exercise files and links its worker, according to ninja;
/// without ccache.
struct Recipe {
  std::string compiler;                         ///< a path
  std::vector<std::string> flags;               ///< compiler flags except -I, -c, -o
  std::vector<std::filesystem::path> includes;  ///< folders, in order

  /// A word of the link command: a flag, or a file by its path.
  struct Word {
    std::string text;
    bool file = false;
  };
  /// The words after the compiler, without the students' objects and the output; these objects
  /// belong at `objects_at`.
  std::vector<Word> link;
  std::size_t objects_at = 0;
};

/// Reads the recipe of a lab's worker from a build folder. Throws Error if the build does not have
/// it, or if its commands are not of the known form.
Recipe recipe_of(const std::filesystem::path& build, const CourseLab& lab);

/// Parses the output of `ninja -t commands`.
Recipe parse_recipe(const std::string& commands, const std::filesystem::path& build,
                    const CourseLab& lab);

/// Splits a command line into words as a shell would: blanks, quotes and backslashes.
std::vector<std::string> shell_words(const std::string& line);

}  // namespace carlo::grader
