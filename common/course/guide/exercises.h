#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// An exercise as lab.json lists it. The tag, "Lab 1.2", is its name everywhere: in the stub, the
/// handout, the hints and the tests.
struct Exercise {
  std::string tag;
  std::string title;
  int points = 0;
  std::vector<std::string> functions;  ///< what the student writes
  std::vector<std::string> hints;      ///< from a nudge to nearly the formula
  std::vector<std::string> uses = {};  ///< tags of earlier exercises that its code may call

  /// The tag as typed on a command line: "1.2".
  std::string number() const { return tag.substr(4); }
};

struct Lab {
  int number = 0;
  std::string name;   ///< "integration"
  std::string title;  ///< shown to the reader
  std::vector<Exercise> exercises;

  /// Returns the exercise with that tag, or null.
  const Exercise* find(const std::string& tag) const;
  /// The sum of all points.
  int points() const;
};

/// Reads a lab.json. Throws Error that names the file and the fault: not JSON, a missing or
/// mistyped field, tags that do not count up from 1, points below 1, empty texts.
Lab load_lab(const std::filesystem::path& file);

/// Loads all labs below `labs` (folders NN_name with a lab.json), in order. Throws Error, also if
/// there is none.
std::vector<Lab> load_labs(const std::filesystem::path& labs);

/// Returns the lab with that number. Throws Error that lists the available labs.
const Lab& find_lab(const std::vector<Lab>& labs, int number);

}  // namespace carlo
