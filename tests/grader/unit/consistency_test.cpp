#include "grader/judge/consistency.h"

#include <catch2/catch_test_macros.hpp>

#include <string>
#include <vector>

using namespace carlo;

TEST_CASE("disagreements of stub, handout and tests with lab.json are told", "[course]") {
  Exercise first{"Lab 1.1", "T", 2, {"f"}, {"nudge", "plan"}};
  Exercise second = first;
  second.tag = "Lab 1.2";
  const Lab lab{1, "demo", "Demo", {first, second}};
  const std::string both = "Lab 1.1 and Lab 1.2";
  const std::vector<grader::TestName> tests{{"Lab 1.1: a", {"lab01", "ex1"}},
                                            {"Lab 1.2: b", {"lab01", "ex2"}}};
  CHECK(grader::disagreements(lab, both, both, tests).empty());
  CHECK(grader::disagreements(lab, "Lab 1.1", both, tests).size() == 1);
  CHECK(grader::disagreements(lab, both, both + " Lab 1.3", tests).size() == 1);
  CHECK(grader::disagreements(lab, both, both, {tests[0]}).size() == 1);
  CHECK(grader::disagreements(lab, both, both, {tests[0], {"Lab 1.2: b", {"lab01"}}}).size() == 1);
  Lab bare = lab;
  bare.exercises[0].hints.pop_back();
  CHECK(grader::disagreements(bare, both, both, tests).size() == 1);
}
