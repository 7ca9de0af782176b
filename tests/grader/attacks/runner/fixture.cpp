#include "fixture.h"

#include "course/cli/program.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Sections = std::map<std::string, std::string>;

constexpr const char* lab_folder = "01_integration";
constexpr const char* exercise_file = "integration.cpp";

Fixture load_fixture(const fs::path& folder) {
  Fixture fixture;
  fixture.name = folder.filename();
  fixture.folder = folder;
  try {
    const json document = json::parse(read_file(folder / "expected.json"));
    document.at("about").get_to(fixture.about);
    document.at("points").get_to(fixture.points);
    const auto optional = [&](const char* name, auto& value) {
      if (document.contains(name)) document.at(name).get_to(value);
    };
    optional("honest", fixture.honest);
    optional("status", fixture.status);
    optional("state", fixture.state);
    optional("seconds", fixture.seconds);
    optional("levels", fixture.levels);
    optional("absent", fixture.absent);
  } catch (const json::exception& error) {
    throw Error("{}: {}", (folder / "expected.json").string(), error.what());
  }
  return fixture;
}

/// A text cut where `title` finds a heading in a line; what stands before the first one is "".
template <class Title>
Sections cut(const std::string& text, const Title& title) {
  Sections sections;
  std::string current;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (const std::string next = title(line); !next.empty()) {
      current = next;
    } else {
      sections[current] += line + "\n";
    }
  }
  return sections;
}

/// "1.2" of "// Lab 1.2 -----"
std::string exercise_ruler(const std::string& line) {
  return line.starts_with("// Lab ") && line.ends_with("-----") ? line.substr(7, 3) : "";
}

/// "1.2" of "//@ 1.2"
std::string attack_ruler(const std::string& line) {
  return line.starts_with("//@ ") ? line.substr(4) : "";
}

/// The stub's functions of exercise `number` with the attack's text as their first lines: that for
/// the whole exercise, and that for functions by name. Stubs hold no other braces that end a line.
std::string put_into_functions(const std::string& stub, const std::string& number,
                               const Sections& attack) {
  std::string out;
  std::istringstream lines(stub);
  for (std::string line; std::getline(lines, line);) {
    out += line + "\n";
    if (!line.ends_with(" {")) continue;
    for (const auto& [title, text] : attack) {
      const bool named =
          title.starts_with(number + " ") && line.find(title.substr(4)) != std::string::npos;
      if (title == number || named) out += text;
    }
  }
  return out;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// The namespace's end, which the last section of an exercise file holds.
std::string without_end(const std::string& section) {
  const auto end = section.find("}  // namespace lab01");
  return end == std::string::npos ? section : section.substr(0, end);
}

void run_script(const fs::path& script, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), script.string());
  if (wait_for(start_program(words)) != 0) throw Error("{} failed", script.string());
}

}  // namespace

bool Fixture::is_for(const std::string& level) const {
  return levels.empty() || std::find(levels.begin(), levels.end(), level) != levels.end();
}

std::vector<Fixture> load_fixtures(const fs::path& folder) {
  std::vector<Fixture> fixtures;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / "expected.json")) fixtures.push_back(load_fixture(entry.path()));
  }
  std::sort(fixtures.begin(), fixtures.end(),
            [](const Fixture& a, const Fixture& b) { return a.name < b.name; });
  if (fixtures.empty()) throw Error("{}: no attack in it", folder.string());
  return fixtures;
}

std::string assemble(const Fixture& fixture, const Places& places) {
  const auto text_in = [&](const char* part) {
    return read_file(places.tree / part / lab_folder / exercise_file);
  };
  Sections stub = cut(text_in("labs"), exercise_ruler);
  Sections solution = cut(text_in("solutions"), exercise_ruler);
  Sections attack;
  if (fs::exists(fixture.folder / "attack.inc")) {
    attack = cut(read_file(fixture.folder / "attack.inc"), attack_ruler);
  }
  std::string text = attack["top"] + "#include \"course/not_implemented.h\"\n" + solution[""];
  for (const auto& [number, section] : stub) {
    if (number.empty()) continue;
    const auto& honest = fixture.honest;
    const bool solved = std::find(honest.begin(), honest.end(), number) != honest.end();
    text += solved ? without_end(solution.at(number))
                   : put_into_functions(without_end(section), number, attack);
  }
  text += "}  // namespace lab01\n" + attack["end"];
  replace_all(text, "@TREE@", places.tree.string());
  replace_all(text, "@BUILD@", places.build.string());
  replace_all(text, "@CLASS@", places.submissions.string());
  replace_all(text, "@OUT@", places.out.string());
  replace_all(text, "@CANARY@", places.canary.string());
  replace_all(text, "@NAME@", fixture.name);
  return text;
}

void hand_in(const Fixture& fixture, const Places& places) {
  const fs::path target = places.submissions / fixture.name;
  const fs::path script = fixture.folder / "make.sh";
  if (!fs::exists(script)) {
    fs::create_directories(target);
    write_file(target / exercise_file, assemble(fixture, places));
    return;
  }
  const fs::path draft = places.submissions.parent_path() / "drafts" / fixture.name;
  fs::create_directories(draft);
  write_file(draft / exercise_file, assemble(fixture, places));
  run_script(script, {draft.string(), target.string(), places.tree.string()});
}

}  // namespace carlo::grader
