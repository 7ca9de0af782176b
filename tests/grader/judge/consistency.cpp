#include "grader/judge/consistency.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace carlo::grader {
namespace {

/// Returns all tags "Lab N.K" of this lab in a text.
std::set<std::string> tags_in(const Lab& lab, const std::string& text) {
  const std::string tag = fmt::format("Lab {}.", lab.number);
  std::set<std::string> found;
  for (std::size_t at = text.find(tag); at != std::string::npos; at = text.find(tag, at + 1)) {
    const std::size_t number = at + tag.size();
    const std::size_t end = std::min(text.find_first_not_of("0123456789", number), text.size());
    if (end > number) found.insert(text.substr(at, end - at));
  }
  return found;
}

void compare(const Lab& lab, const std::string& where, const std::set<std::string>& found,
             std::vector<std::string>& lines) {
  for (const Exercise& exercise : lab.exercises) {
    if (found.count(exercise.tag) == 0) {
      lines.push_back(fmt::format("{} is missing in {}", exercise.tag, where));
    }
  }
  for (const std::string& tag : found) {
    if (lab.find(tag) == nullptr) {
      lines.push_back(fmt::format("{} speaks of {}, which does not exist", where, tag));
    }
  }
}

void check_test(const Lab& lab, const TestName& test, std::vector<std::string>& lines) {
  const std::string tag = test.name.substr(0, test.name.find(": "));
  const auto has = [&](const std::string& wanted) {
    return std::find(test.tags.begin(), test.tags.end(), wanted) != test.tags.end();
  };
  const std::string lab_tag = fmt::format("lab{:02}", lab.number);
  const std::string exercise_tag = "ex" + tag.substr(tag.find('.') + 1);
  if (lab.find(tag) == nullptr) {
    lines.push_back(fmt::format("the test \"{}\" belongs to no exercise", test.name));
  } else if (!has(lab_tag) || !has(exercise_tag)) {
    lines.push_back(
        fmt::format("the test \"{}\" is not tagged [{}][{}]", test.name, lab_tag, exercise_tag));
  }
}

}  // namespace

std::vector<std::string> disagreements(const Lab& lab, const std::string& stub,
                                       const std::string& handout,
                                       const std::vector<TestName>& tests) {
  std::vector<std::string> lines;
  compare(lab, "the stub", tags_in(lab, stub), lines);
  compare(lab, "the handout", tags_in(lab, handout), lines);
  std::string names;
  for (const TestName& test : tests)
    names += test.name + "\n";
  compare(lab, "the tests", tags_in(lab, names), lines);
  for (const TestName& test : tests)
    check_test(lab, test, lines);
  for (const Exercise& exercise : lab.exercises) {
    if (exercise.hints.size() < 2) {
      lines.push_back(fmt::format("{} has fewer than two hints", exercise.tag));
    }
  }
  return lines;
}

}  // namespace carlo::grader
