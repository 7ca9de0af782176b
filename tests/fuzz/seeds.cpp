// What we write ourselves, for the readers to begin with.

#include "fuzz/target.h"
#include "grader/grade/record.h"
#include "grader/judge/asked.h"
#include "grader/protocol/frame.h"
#include "grader/protocol/params.h"

#include <limits>

namespace carlo::fuzz {

using namespace grader;

namespace {

const Params params{.seed = 7, .n = 100, .numbers = {{"k", 2.5}, {"tiny", 5e-324}}};

}  // namespace

std::vector<std::string> frame_seeds() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return {encode({.rows = {2, {1, 2, inf, -0.0}}, .text = {}}),
          encode({.status = Frame::Status::error, .rows = {}, .text = "what went wrong"}),
          encode({.status = Frame::Status::not_implemented,
                  .rows = {},
                  .text = "it is not done",
                  .tag = "Lab 1.1",
                  .function = "average"})};
}

std::vector<std::string> params_seeds() {
  return {to_text(params), to_text({})};
}

std::vector<std::string> questions_seeds() {
  return {to_json(Questions{9, {{"Lab 1.2", "a mean", "probe", params, "why", 3, 2}}})};
}

std::vector<std::string> record_seeds() {
  LabGrade lab{.number = 1, .title = "Lab", .state = LabState::judged, .note = "a note"};
  lab.exercises = {{"Lab 1.1", "One", 2.5, 4, "failed", "why"}, {"Lab 1.2", "Two", {}, 4, "", ""}};
  return {to_json(Record{"alice", "key", {"other.txt"}, {lab}})};
}

}  // namespace carlo::fuzz
