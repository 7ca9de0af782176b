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
constexpr const char* honest_exercise = "1.1";

void expect(Fixture& fixture, const std::string& what, const json& value) {
  if (what == "points") {
    value.get_to(fixture.points);
  } else if (what == "status") {
    value.get_to(fixture.status);
  } else if (what == "state") {
    value.get_to(fixture.state);
  } else if (what == "seconds") {
    value.get_to(fixture.seconds);
  } else if (what == "levels") {
    value.get_to(fixture.levels);
  } else if (what == "absent") {
    value.get_to(fixture.absent);
  } else {
    throw Error("nothing is expected by the name \"{}\"", what);
  }
}

/// Attacks by name, from files in which each begins with a title.
class Corpus {
 public:
  void read(const fs::path& file) {
    const bool is_script = file.extension() == ".sh";
    mark_ = is_script ? "#" : "//";
    current_ = nullptr;
    std::istringstream lines(read_file(file));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      try {
        take(line);
      } catch (const std::exception& error) {
        throw Error("{}:{}: {}", file.string(), number, error.what());
      }
      if (is_script && current_ != nullptr) current_->script = file;
    }
  }

  std::vector<Fixture> result() const {
    std::vector<Fixture> list;
    for (const auto& [name, fixture] : fixtures_) {
      list.push_back(fixture);
      if (fixture.code.ends_with("\n\n")) list.back().code.pop_back();  // before the next title
    }
    return list;
  }

 private:
  void take(const std::string& line) {
    if (line.starts_with(mark_ + "= ")) {
      const std::string name = line.substr(mark_.size() + 2);
      current_ = &fixtures_[name];
      if (!current_->code.empty() && mark_ == "//") throw Error("{} is there twice", name);
      current_->name = name;
    } else if (current_ == nullptr) {
      return;
    } else if (line.starts_with(mark_ + ": ")) {
      const auto begin = mark_.size() + 2, end = line.find(' ', begin);
      expect(*current_, line.substr(begin, end - begin),
             json::parse(end == std::string::npos ? "" : line.substr(end)));
    } else if (mark_ == "//" && (line.starts_with("//@ ") || !current_->code.empty())) {
      current_->code += line + "\n";
    }
  }

  std::string mark_;  ///< What a comment begins with.
  std::map<std::string, Fixture> fixtures_;
  Fixture* current_ = nullptr;
};

/// Cuts a text at the lines in which `title` finds a heading; the part before the first one is "".
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
  Corpus corpus;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path kind = entry.path().extension();
    if (kind == ".inc" || kind == ".sh") corpus.read(entry.path());
  }
  std::vector<Fixture> fixtures = corpus.result();
  if (fixtures.empty()) throw Error("{}: no attack in it", folder.string());
  return fixtures;
}

std::string assemble(const Fixture& fixture, const Places& places) {
  const auto text_in = [&](const char* part) {
    return read_file(places.tree / part / lab_folder / exercise_file);
  };
  Sections stub = cut(text_in("labs"), exercise_ruler);
  Sections solution = cut(text_in("solutions"), exercise_ruler);
  Sections attack = cut(fixture.code, attack_ruler);
  std::string text = attack["top"] + "#include \"course/not_implemented.h\"\n" + solution[""];
  for (const auto& [number, section] : stub) {
    if (number.empty()) continue;
    text += number == honest_exercise ? without_end(solution.at(number))
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
  if (fixture.script.empty()) {
    fs::create_directories(target);
    write_file(target / exercise_file, assemble(fixture, places));
    return;
  }
  const fs::path draft = places.submissions.parent_path() / "drafts" / fixture.name;
  fs::create_directories(draft);
  write_file(draft / exercise_file, assemble(fixture, places));
  run_script(fixture.script, {fixture.name, draft.string(), target.string(), places.tree.string()});
}

}  // namespace carlo::grader
