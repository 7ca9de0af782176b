#include "course/verbs/tree.h"

#include "support/atomic_file.h"
#include "support/error.h"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string_view>
#include <system_error>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

/// Returns the names in a folder, in order; none if the folder does not exist.
Words names_in(const fs::path& folder) {
  Words names;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder, ec))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++found;
  return found;
}

/// The number of functions to write, of all exercises of a lab.json.
int functions_in(const std::string& lab_json) {
  constexpr std::string_view member = "\"functions\": [";
  int quotes = 0;
  for (std::size_t at = 0; (at = lab_json.find(member, at)) != std::string::npos;) {
    at += member.size();
    const std::string list = lab_json.substr(at, lab_json.find(']', at) - at);
    quotes += count(list, "\"");
  }
  return quotes / 2;
}

/// True if `typed` is a lab or an exercise, such as 1 or 1.2, with at most two digits each.
bool is_exercise_number(const std::string& typed) {
  const std::size_t point = typed.find('.');
  return is_number(typed.substr(0, point), 2) &&
         (point == std::string::npos || is_number(typed.substr(point + 1), 2));
}

}  // namespace

int LabFolder::number() const {
  return as_number(digits());
}

bool Tree::has_solutions() const {
  return fs::exists(root / "solutions/CMakeLists.txt");
}

void Tree::needs_solutions(const std::string& without) const {
  if (!has_solutions()) fail({"this is a student's tree, without ", without});
}

std::vector<LabFolder> Tree::labs() const {
  std::vector<LabFolder> list;
  for (const std::string& name : names_in(root / "labs")) {
    const bool named = is_number(name.substr(0, 2), 2) && name.size() > 3 && name[2] == '_';
    if (named && fs::exists(lab_json({name}))) list.push_back({name});
  }
  return list;
}

LabFolder Tree::lab(const std::string& typed) const {
  const std::size_t folder = typed.find("labs/");
  std::string number = folder == std::string::npos ? typed : typed.substr(folder + 5);
  number = number.substr(0, number.find('_'));
  if (!is_number(number, 2)) fail({"a lab is a number such as 1, got '", typed, "'"});
  Words there;
  for (const LabFolder& lab : labs()) {
    if (lab.number() == as_number(number)) return lab;
    there.push_back(std::to_string(lab.number()));
  }
  fail({"there is no lab ", typed, "; there are: ", joined(there, ", ")});
}

fs::path Tree::lab_json(const LabFolder& lab) const {
  return root / "labs" / lab.name / "lab.json";
}

std::string Tree::own_text(const LabFolder& lab) const {
  const fs::path folder = root / "labs" / lab.name;
  Words files{joined({lab.name.substr(3), ".cpp"})};
  for (const std::string& name : names_in(folder / "steps"))
    if (name[0] != '.' && fs::path(name).extension() == ".cpp")
      files.push_back(joined({"steps/", name}));
  std::string text;
  for (const std::string& file : files)
    if (fs::is_regular_file(folder / file)) text += joined({file, "\n", read_file(folder / file)});
  return text;
}

int Tree::exercises(const LabFolder& lab) const {
  return count(read_file(lab_json(lab)), "\"tag\": \"Lab ");
}

bool Tree::is_untouched(const LabFolder& lab) const {
  std::istringstream own(own_text(lab));
  std::string before;
  int untouched = 0;
  for (std::string line; std::getline(own, line);) {
    line.erase(std::min(line.find("//"), line.size()));
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty()) continue;
    if (line.find("not_implemented(\"Lab ") != std::string::npos && before.ends_with('{'))
      ++untouched;
    before = line;
  }
  return untouched == functions_in(read_file(lab_json(lab)));
}

ExerciseNumber Tree::exercise(const std::string& typed) const {
  const std::string number = typed.starts_with("Lab ") ? typed.substr(4) : typed;
  if (!is_exercise_number(number)) fail({"an exercise is a number such as 1.2, got '", typed, "'"});
  const std::size_t point = number.find('.');
  const LabFolder folder = lab(number.substr(0, point));
  const std::string of = std::to_string(folder.number()) + ".";
  const int last = exercises(folder);
  const std::string all = joined({of, "1 to ", of, std::to_string(last)});
  if (point == std::string::npos)
    fail({"which exercise of lab ", std::to_string(folder.number()), "? There are ", all});
  const int exercise = as_number(number.substr(point + 1));
  const std::string text = of + std::to_string(exercise);
  if (exercise < 1 || exercise > last)
    fail({"there is no exercise ", text, "; lab ", std::to_string(folder.number()), " has ", all});
  return {folder, text};
}

std::string Tree::help(const std::string& verb) const {
  std::istringstream lines(read_file(root / "common/course/verbs.txt"));
  std::string text;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("== ")) {
      inside = line.substr(3) == verb;
    } else if (inside) {
      (text += line) += '\n';
    }
  }
  return text;
}

void Tree::print_help(const std::string& verb) const {
  std::fputs(help(verb).c_str(), stdout);
}

void Tree::need(const Words& groups) const {
  Words command = list_of({root / "common/course/setup.sh"});
  const int code = run(command += groups);
  if (code != 0) throw Leave{code};
}

}  // namespace carlo::verbs
