#include "course/guide/exercises.h"

#include "course/json/json_fields.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <algorithm>
#include <numeric>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// Reads a text that must not be empty.
void text(JsonFields& json, const char* key, std::string& value) {
  json(key, value);
  if (value.empty()) json.fail(fmt::format("\"{}\" must be a text that is not empty", key));
}

void texts(JsonFields& json, const char* key, std::vector<std::string>& list) {
  json(key, list);
  if (std::any_of(list.begin(), list.end(), [](const std::string& one) { return one.empty(); })) {
    json.fail(fmt::format("\"{}\" must list texts that are not empty", key));
  }
}

void positive(JsonFields& json, const char* key, int& value) {
  json(key, value);
  if (value < 1 || value > 1000) {
    json.fail(fmt::format("\"{}\" must be a whole number from 1 to 1000", key));
  }
}

/// Checks an exercise's tag, and that the exercises it uses come before it.
void check(const JsonFields& json, const Lab& lab, std::size_t i) {
  const Exercise& exercise = lab.exercises[i];
  const std::string tag = fmt::format("Lab {}.{}", lab.number, i + 1);
  if (exercise.tag != tag) {
    json.fail(fmt::format("the tag is \"{}\", expected \"{}\"", exercise.tag, tag));
  }
  const auto end = lab.exercises.begin() + static_cast<std::ptrdiff_t>(i);
  for (const std::string& used : exercise.uses) {
    if (std::none_of(lab.exercises.begin(), end,
                     [&](const Exercise& earlier) { return earlier.tag == used; })) {
      json.fail(fmt::format("{}: \"uses\" names \"{}\", which is no earlier exercise", tag, used));
    }
  }
}

}  // namespace

static void fields(JsonFields& json, Exercise& exercise) {
  text(json, "tag", exercise.tag);
  text(json, "title", exercise.title);
  positive(json, "points", exercise.points);
  texts(json, "functions", exercise.functions);
  texts(json, "hints", exercise.hints);
  if (json.has("uses")) texts(json, "uses", exercise.uses);
}

static void fields(JsonFields& json, Lab& lab) {
  positive(json, "lab", lab.number);
  text(json, "name", lab.name);
  text(json, "title", lab.title);
  json("exercises", lab.exercises);
  for (std::size_t i = 0; i < lab.exercises.size(); ++i)
    check(json, lab, i);
  if (lab.exercises.empty()) json.fail("no exercises");
}

const Exercise* Lab::find(const std::string& tag) const {
  const auto found = std::find_if(exercises.begin(), exercises.end(),
                                  [&](const Exercise& exercise) { return exercise.tag == tag; });
  return found == exercises.end() ? nullptr : &*found;
}

int Lab::points() const {
  return std::accumulate(exercises.begin(), exercises.end(), 0,
                         [](int sum, const Exercise& exercise) { return sum + exercise.points; });
}

Lab load_lab(const fs::path& file) {
  return from_json_text<Lab>(read_file(file), file.string());
}

std::vector<Lab> load_labs(const fs::path& labs) {
  if (!fs::is_directory(labs)) throw Error("{}: not a folder of labs", labs.string());
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(labs)) {
    const fs::path file = entry.path() / "lab.json";
    if (fs::exists(file)) files.push_back(file);
  }
  if (files.empty()) throw Error("{}: no lab.json in any folder", labs.string());
  std::sort(files.begin(), files.end());
  std::vector<Lab> list;
  std::transform(files.begin(), files.end(), std::back_inserter(list), load_lab);
  return list;
}

const Lab& find_lab(const std::vector<Lab>& labs, int number) {
  std::string all;
  for (const Lab& lab : labs) {
    if (lab.number == number) return lab;
    all += fmt::format("{}{}", all.empty() ? "" : ", ", lab.number);
  }
  throw Error("there is no lab {}; there are: {}", number, all);
}

}  // namespace carlo
