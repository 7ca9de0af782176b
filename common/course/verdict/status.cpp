#include "course/verdict/status.h"

#include "support/error.h"

#include <algorithm>
#include <array>
#include <utility>

namespace carlo {
namespace {

constexpr std::array statuses{std::pair{Status::passed, "passed"},
                              std::pair{Status::failed, "failed"},
                              std::pair{Status::crashed, "crashed"},
                              std::pair{Status::timeout, "timeout"},
                              std::pair{Status::not_implemented, "not_implemented"},
                              std::pair{Status::not_submitted, "not_submitted"},
                              std::pair{Status::refused, "refused"},
                              std::pair{Status::does_not_compile, "does_not_compile"},
                              std::pair{Status::grader_error, "grader_error"}};

constexpr std::array aspects{std::pair{Aspect::correctness, "correctness"},
                             std::pair{Aspect::variance, "variance"},
                             std::pair{Aspect::efficiency, "efficiency"}};

template <class Names, class Value>
std::string name_in(const Names& names, Value value) {
  for (const auto& [one, name] : names) {
    if (one == value) return name;
  }
  throw Error("a value of an enumeration that has no name: {}", static_cast<int>(value));
}

template <class Names>
auto value_in(const Names& names, const std::string& wanted, const char* what) {
  for (const auto& [value, name] : names) {
    if (wanted == name) return value;
  }
  throw Error("unknown {} \"{}\"", what, wanted.substr(0, 40));
}

}  // namespace

std::string to_string(Status status) {
  return name_in(statuses, status);
}

Status status_named(const std::string& name) {
  return value_in(statuses, name, "status");
}

std::string to_string(Aspect aspect) {
  return name_in(aspects, aspect);
}

Aspect aspect_named(const std::string& name) {
  return value_in(aspects, name, "aspect");
}

Aspect aspect_of(const std::vector<std::string>& tags) {
  const auto named = [&](Aspect aspect) {
    return std::find(tags.begin(), tags.end(), to_string(aspect)) != tags.end();
  };
  const bool variance = named(Aspect::variance), efficiency = named(Aspect::efficiency);
  if (variance && efficiency) throw Error("a test judges variance or efficiency, not both");
  return variance ? Aspect::variance : efficiency ? Aspect::efficiency : Aspect::correctness;
}

}  // namespace carlo
