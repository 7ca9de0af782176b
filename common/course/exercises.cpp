#include "course/exercises.h"

#include "cli/atomic_file.h"
#include "cli/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Reads the fields of one JSON object; says where it is when one is missing or of a wrong type.
class Fields {
 public:
  Fields(const json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object_.is_object()) fail("expected an object");
  }

  std::string text(const char* key) const {
    const json& value = at(key);
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) {
      fail(fmt::format("\"{}\" must be a text that is not empty", key));
    }
    return value.get<std::string>();
  }

  int positive(const char* key) const {
    const json& value = at(key);
    if (!value.is_number_integer() || value.get<long>() < 1 || value.get<long>() > 1000) {
      fail(fmt::format("\"{}\" must be a whole number from 1 to 1000", key));
    }
    return value.get<int>();
  }

  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> list;
    for (const json& value : array(key)) {
      if (!value.is_string() || value.get_ref<const std::string&>().empty()) {
        fail(fmt::format("\"{}\" must list texts that are not empty", key));
      }
      list.push_back(value.get<std::string>());
    }
    return list;
  }

  /// As texts(); none when the field is not there.
  std::vector<std::string> optional_texts(const char* key) const {
    return object_.contains(key) ? texts(key) : std::vector<std::string>{};
  }

  const json& array(const char* key) const {
    const json& value = at(key);
    if (!value.is_array()) fail(fmt::format("\"{}\" must be a list", key));
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error("{}: {}", where_, what); }

 private:
  const json& at(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) fail(fmt::format("\"{}\" is missing", key));
    return *found;
  }

  const json& object_;
  std::string where_;
};

Exercise read_exercise(const Fields& fields) {
  Exercise exercise;
  exercise.tag = fields.text("tag");
  exercise.title = fields.text("title");
  exercise.points = fields.positive("points");
  exercise.lecture = fields.text("lecture");
  exercise.functions = fields.texts("functions");
  exercise.hints = fields.texts("hints");
  exercise.uses = fields.optional_texts("uses");
  return exercise;
}

json parse(const fs::path& file) {
  try {
    return json::parse(read_file(file));
  } catch (const json::parse_error& error) {
    throw Error("{}: not valid JSON at byte {}", file.string(), error.byte);
  }
}

}  // namespace

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
  const json document = parse(file);
  const Fields fields(document, file.string());
  Lab lab;
  lab.number = fields.positive("lab");
  lab.name = fields.text("name");
  lab.title = fields.text("title");
  for (const json& entry : fields.array("exercises")) {
    const std::string tag = fmt::format("Lab {}.{}", lab.number, lab.exercises.size() + 1);
    const Fields exercise(entry, fmt::format("{}: {}", file.string(), tag));
    Exercise read = read_exercise(exercise);
    for (const std::string& used : read.uses) {
      if (lab.find(used) == nullptr) {
        exercise.fail(fmt::format("\"uses\" names \"{}\", which is no earlier exercise", used));
      }
    }
    lab.exercises.push_back(std::move(read));
    const std::string& found = lab.exercises.back().tag;
    if (found != tag) exercise.fail(fmt::format("the tag is \"{}\", expected \"{}\"", found, tag));
  }
  if (lab.exercises.empty()) fields.fail("no exercises");
  return lab;
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
