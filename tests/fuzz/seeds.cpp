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
          encode({.status = Frame::Status::exhausted, .rows = {}, .text = "no thread"}),
          encode({.status = Frame::Status::not_implemented,
                  .rows = {},
                  .text = "it is not done",
                  .tag = "Lab 1.1",
                  .function = "average"})};
}

std::vector<std::string> params_seeds() {
  return {to_text(params), to_text(Params{})};
}

std::vector<std::string> part_seeds() {
  return {
      R"({"needs":"","lamps":false,"least_light_chance":1,"shard":{"index":1,"count":2},"parts":"1",)"
      R"("blocks":{"numbers":"0-2 3-4"},"microseconds":"5","threads":1})"};
}

std::vector<std::string> questions_seeds() {
  return {to_json(Questions{9, {{"Lab 1.2", "a mean", "probe", params, "why", 3, 2}}})};
}

std::vector<std::string> record_seeds() {
  Verdict verdict;
  verdict.what = "the mean";
  verdict.p = 1e-9;
  verdict.effect = Effect{.5, .25, "of all"};
  verdict.diagnoses = {{"off-by-one", "one is missing."}};
  verdict.figure = Figure{"title", "note", ListingFigure{{"a"}, {{"b"}}}};
  ExerciseResult one, two;
  one.tag = "Lab 1.1";
  one.tests = {{one.tag, "it holds", {verdict}, Status::failed, "", "words"}};
  two.tag = "Lab 1.2";
  two.status = Status::grader_error;
  LabGrade judged, unjudged;
  judged.result.lab = 1;
  judged.result.exercises = {one, two};
  judged.note = "a note";
  unjudged.unjudged = Status::does_not_compile;
  return {to_json(Record{"alice", "key", {"other.txt"}, {judged, unjudged}})};
}

}  // namespace carlo::fuzz
