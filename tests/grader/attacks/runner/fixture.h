#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// Paths that an attack may name, as if it knew where the grader works.
struct Places {
  std::filesystem::path tree, build, submissions, out, canary;
};

/// One attack: what is handed in, and the marks that it deserves.
struct Fixture {
  std::string name;
  std::string code;                           ///< its sections of a .inc; none for an honest file
  std::filesystem::path script;               ///< that hands it in; none for a folder with the file
  std::map<std::string, double> points;       ///< by exercise; those not named have none
  std::map<std::string, std::string> status;  ///< the judge's words, where they are expected
  std::string state = "judged";               ///< what becomes of the lab
  double seconds = 120;                       ///< for compiling and judging
  std::vector<std::string> levels;            ///< of the sandbox, where it is not for all
  std::vector<std::string> absent;            ///< texts that no output may hold

  bool is_for(const std::string& level) const;
};

/// Loads the attacks of all *.inc and *.sh in `folder`, by name (README.md describes the form).
/// Throws Error naming the line that cannot be understood.
std::vector<Fixture> load_fixtures(const std::filesystem::path& folder);

/// Lab 1's exercise file with the attack in it: the stub, exercise 1.1 as the solution has it, and
/// the sections of the attack's code at their places ("//@ top" before all else, "//@ 1.2" at the
/// start of that exercise's functions, "//@ 1.3 Moments::add" of those alone whose line says so,
/// "//@ end" after all). @TREE@, @BUILD@, @CLASS@, @OUT@, @CANARY@ and @NAME@ become what they
/// stand for.
std::string assemble(const Fixture& fixture, const Places& places);

/// Writes the submission into places.submissions: a folder with the file; or whatever the fixture's
/// script makes of it.
void hand_in(const Fixture& fixture, const Places& places);

}  // namespace carlo::grader
