#include "grader/grade/exercise_files.h"

#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// As in add_lab() of common/course/cmake: steps/*.cpp, or else NAME.cpp.
std::vector<std::string> files_of(const fs::path& folder, const std::string& name) {
  std::vector<std::string> files;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder / "steps", ec)) {
    if (entry.path().extension() == ".cpp") {
      files.push_back("steps/" + entry.path().filename().string());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty() && fs::exists(folder / (name + ".cpp"))) files.push_back(name + ".cpp");
  return files;
}

}  // namespace

std::vector<CourseLab> course_labs(const fs::path& labs, const std::vector<int>& only) {
  const auto wanted = [&](int number) {
    return only.empty() || std::find(only.begin(), only.end(), number) != only.end();
  };
  std::vector<CourseLab> list;
  for (const Lab& lab : load_labs(labs)) {
    if (!wanted(lab.number)) continue;
    CourseLab entry{lab, fmt::format("{:02}_{}", lab.number, lab.name), {}};
    entry.files = files_of(labs / entry.folder, lab.name);
    if (entry.files.empty()) throw Error("labs/{}: there is no file for students", entry.folder);
    list.push_back(entry);
  }
  for (const int number : only) {
    const bool found = std::any_of(list.begin(), list.end(), [&](const CourseLab& entry) {
      return entry.lab.number == number;
    });
    if (!found) throw Error("there is no lab {} to grade", number);
  }
  return list;
}

std::string last_part(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

}  // namespace carlo::grader
