#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// One exercise as lab.json lists it. The tag, "Lab 1.2", is its name everywhere: in the stub, the
/// handout, the hints and the tests.
struct Exercise {
  std::string tag;
  std::string title;
  int points = 0;
  std::string lecture;                 ///< the lecture's section
  std::vector<std::string> functions;  ///< what the student writes
  std::vector<std::string> hints;      ///< from a nudge to nearly the formula
  std::vector<std::string> uses = {};  ///< tags of earlier exercises that its code may call

  /// "1.2": the tag as it is typed on a command line.
  std::string number() const { return tag.substr(4); }
};

struct Lab {
  int number = 0;
  std::string name;   ///< "integration"
  std::string title;  ///< for people
  std::vector<Exercise> exercises;

  /// The exercise of that tag, or null.
  const Exercise* find(const std::string& tag) const;
  /// All points to be had.
  int points() const;
};

/// Reads a lab.json. Throws Error naming the file and what is wrong with it: not JSON, a missing
/// or mistyped field, tags that do not count up from 1, points below 1, empty texts.
Lab load_lab(const std::filesystem::path& file);

/// All labs below `labs` (folders NN_name with a lab.json), in order. Throws Error, also when there
/// is none.
std::vector<Lab> load_labs(const std::filesystem::path& labs);

/// The lab of that number. Throws Error that names those that there are.
const Lab& find_lab(const std::vector<Lab>& labs, int number);

}  // namespace carlo
