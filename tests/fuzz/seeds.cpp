// Valid inputs from our own writers, as seeds.

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
  return {to_text(params), to_text({})};
}

std::vector<std::string> part_seeds() {
  // A header; then a tile of one pixel, whose planes have no bytes except their heads.
  std::string tile(4 + 24 * 9, '\0');
  tile[0] = static_cast<char>(24 * 9);
  return {
      R"({"scene":"a.xml","needs":"","settings":{"definitions":"","kernel":"k","max_depth":"0",)"
      R"("planned_spp":"8","sampler":"s","scene_digest":"0","seed":"1","version":"0"},)"
      R"("grid":{"width":1,"height":1,"block":1,"passes":8},"lamps":false,)"
      R"("shard":{"index":1,"count":2},"parts":"1","blocks":"0-2 3-4","counts":{"paths":"4",)"
      R"("rays":"9","lamp_paths":"0","cut_paths":"0","bad_samples":"0"},)"
      R"("lamp_ties":"0 0 0 0 0 0 0","microseconds":"5","threads":1})"
      "\n" +
      tile};
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
