#include "course/verbs/tree.h"

#include "cli/atomic_file.h"
#include "cli/error.h"

#include <algorithm>
#include <sstream>
#include <system_error>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

bool is_lab(const fs::path& folder) {
  const std::string name = folder.filename();
  return name.size() > 3 && is_number(name.substr(0, 2), 2) && name[2] == '_' &&
         fs::exists(folder / "lab.json");
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++found;
  return found;
}

/// Whether it is 1 or 1.2, with at most two digits each.
bool is_exercise_number(const std::string& typed) {
  const std::size_t point = typed.find('.');
  return is_number(typed.substr(0, point), 2) &&
         (point == std::string::npos || is_number(typed.substr(point + 1), 2));
}

}  // namespace

int LabFolder::number() const {
  return std::stoi(digits());
}

bool Tree::has_solutions() const {
  return fs::exists(root / "solutions/CMakeLists.txt");
}

void Tree::needs_solutions(const std::string& without) const {
  if (!has_solutions()) throw Error("this is a student's tree, without " + without);
}

std::vector<LabFolder> Tree::labs() const {
  std::vector<LabFolder> list;
  for (const auto& entry : fs::directory_iterator(root / "labs"))
    if (is_lab(entry.path())) list.push_back({entry.path().filename()});
  std::sort(list.begin(), list.end(),
            [](const LabFolder& a, const LabFolder& b) { return a.name < b.name; });
  return list;
}

LabFolder Tree::lab(const std::string& typed) const {
  const std::size_t folder = typed.find("labs/");
  std::string number = folder == std::string::npos ? typed : typed.substr(folder + 5);
  number = number.substr(0, number.find('_'));
  if (!is_number(number, 2)) throw Error("a lab is a number such as 1, got '" + typed + "'");
  Words there;
  for (const LabFolder& lab : labs()) {
    if (lab.number() == std::stoi(number)) return lab;
    there.push_back(std::to_string(lab.number()));
  }
  throw Error("there is no lab " + typed + "; there are: " + joined(there, ", "));
}

fs::path Tree::lab_json(const LabFolder& lab) const {
  return root / "labs" / lab.name / "lab.json";
}

std::string Tree::own_text(const LabFolder& lab) const {
  const fs::path folder = root / "labs" / lab.name;
  std::vector<fs::path> files{folder / (lab.name.substr(3) + ".cpp")};
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder / "steps", ec))
    if (entry.path().extension() == ".cpp") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::string text;
  for (const fs::path& file : files)
    if (fs::exists(file, ec)) text += file.string() + "\n" + read_file(file);
  return text;
}

ExerciseNumber Tree::exercise(const std::string& typed) const {
  const std::string number = typed.rfind("Lab ", 0) == 0 ? typed.substr(4) : typed;
  if (!is_exercise_number(number))
    throw Error("an exercise is a number such as 1.2, got '" + typed + "'");
  const std::size_t point = number.find('.');
  const LabFolder folder = lab(number.substr(0, point));
  const std::string of = std::to_string(folder.number()) + ".";
  const int last = count(read_file(lab_json(folder)), "\"tag\": \"Lab ");
  const std::string all = of + "1 to " + of + std::to_string(last);
  if (point == std::string::npos)
    throw Error("which exercise of lab " + std::to_string(folder.number()) + "? There are " + all);
  const int exercise = std::stoi(number.substr(point + 1));
  const std::string text = of + std::to_string(exercise);
  if (exercise < 1 || exercise > last)
    throw Error("there is no exercise " + text + "; lab " + std::to_string(folder.number()) +
                " has " + all);
  return {folder, text};
}

std::string Tree::help(const std::string& verb) const {
  std::istringstream lines(read_file(root / "common/course/verbs.txt"));
  std::string text;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("== ", 0) == 0) {
      inside = line.substr(3) == verb;
    } else if (inside) {
      text += line + "\n";
    }
  }
  return text;
}

void Tree::print_help(const std::string& verb) const {
  fmt::print("{}", help(verb));
}

void Tree::need(const Words& groups) const {
  Words command{root / "common/course/setup.sh"};
  const int code = run(command += groups);
  if (code != 0) throw Leave{code};
}

bool asks_for_help(const std::string& word) {
  return word == "--help" || word == "-h";
}

bool is_one_of(const std::string& word, const Words& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_number(const std::string& word, std::size_t most) {
  return !word.empty() && word.size() <= most &&
         word.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace carlo::verbs
