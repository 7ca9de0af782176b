// The readers' first inputs: what we write ourselves, and messages of compilers, linkers and nm.

#include "fuzz/target.h"
#include "grader/grade/record.h"
#include "grader/judge/asked.h"
#include "grader/protocol/frame.h"
#include "grader/protocol/params.h"

#include <limits>
#include <string>

namespace carlo::fuzz {

using namespace grader;

namespace {

const Params params{.seed = 7, .n = 100, .numbers = {{"k", 2.5}, {"tiny", 5e-324}}};

}  // namespace

std::vector<std::string> exr_seeds() {
  // In no image format: it once made OpenImageIO try every reader that it has.
  using namespace std::string_literals;
  return {
      "\x2f\x76\x31\x01\x17\x3f\x67\xb9\xa0\x90\x39\x1b\x1b"
      "\xfe\xdf\xf1\x2b\x08\x98\xcc\x1a\x34\x92\xf4\x85\x90"s};
}

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

std::vector<std::string> messages_seeds() {
  return {
      R"(labs/01_integration/integration.cpp: In function 'double lab01::midpoint(const Function&, double, double, int)':
labs/01_integration/integration.cpp:12:3: error: 'sum' was not declared in this scope
   12 |   sum += f(x);
      |   ^~~
labs/01_integration/integration.cpp:15:1: warning: no return statement in function returning non-void [-Wreturn-type]
In file included from common/sampling/stats.h:9,
                 from labs/01_integration/integration.cpp:3:
/usr/include/c++/12/bits/stl_algo.h:1950:50: error: no match for 'operator-' (operand types are 'std::_List_iterator<int>' and 'std::_List_iterator<int>')
labs/01_integration/integration.cpp:20:12:   required from here
cc1plus: all warnings being treated as errors
)",
      R"(/usr/bin/ld: integration.cpp.o: in function `main':
integration.cpp:(.text+0x5): undefined reference to `lab01::simpson(double)'
collect2: error: ld returned 1 exit status
ninja: build stopped: subcommand failed.
clang: error: linker command failed with exit code 1 (use -v to see invocation)
)"};
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
      R"("grid":{"width":1,"height":1,"block":1,"passes":8},"light_paths":false,)"
      R"("shard":{"index":1,"count":2},"parts":"1","blocks":"0-2 3-4","counts":{"paths":"4",)"
      R"("rays":"9","light_paths":"0","cut_paths":"0","bad_samples":"0"},)"
      R"("pixel_ties":"0 0 0 0 0 0 0, 0 0 0 0 0 0 0, 0 0 0 0 0 0 0, 0 0 0 0 0 0 0","microseconds":"5","threads":1})"
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

std::vector<std::string> symbols_seeds() {
  return {R"(integration.o:
_ZN5lab018midpointERKSt8functionIFddEEddi T 0 1a0
_ZNSt6vectorIdSaIdEE17_M_realloc_insertIJRKdEEEvN9__gnu_cxx17__normal_iteratorIPdS1_EEDpOT_ W 0 10
memcpy U
main T 0 10
_ZZ4testvE1x_0 b 8 4
__cxa_throw U
)"};
}

}  // namespace carlo::fuzz
