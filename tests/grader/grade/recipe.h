#pragma once

#include "grader/grade/exercise_files.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// How the build compiles one lab's exercise files and links its worker, as ninja tells it; without
/// ccache.
struct Recipe {
  std::string compiler;                         ///< a path
  std::vector<std::string> flags;               ///< for compiling, without -I, -c, -o
  std::vector<std::filesystem::path> includes;  ///< folders, in order

  /// A word of the link command: a flag, or a file by its path.
  struct Word {
    std::string text;
    bool file = false;
  };
  /// What follows the compiler, without the students' objects and the output; `objects_at` is where
  /// these objects belong.
  std::vector<Word> link;
  std::size_t objects_at = 0;
};

/// Reads the recipe of a lab's worker from a build folder. Throws Error when the build does not
/// know it, or when its commands are not of the form that we know.
Recipe recipe_of(const std::filesystem::path& build, const CourseLab& lab);

/// The same from what `ninja -t commands` printed.
Recipe parse_recipe(const std::string& commands, const std::filesystem::path& build,
                    const CourseLab& lab);

/// A command line's words, as a shell would see them: blanks, quotes and backslashes.
std::vector<std::string> shell_words(const std::string& line);

}  // namespace carlo::grader
