#include "grader/replay/pick.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <limits>

using namespace carlo;
using namespace carlo::grader;

namespace {

std::vector<Asked> some() {
  return {
      {"Lab 1.2", "it is unbiased", "means", {1, 10, {{"a", 0.1}}}, "n = 10", 5, 1, Status::passed},
      {"Lab 1.2",
       "it is unbiased",
       "means",
       {2, 20, {}},
       "n = 20",
       5,
       1,
       Status::crashed,
       "it crashed"},
      {"Lab 1.2", "it is exact", "values", {3, 0, {}}, "", 1, 2, Status::passed}};
}

}  // namespace

TEST_CASE("a question survives JSON", "[replay]") {
  Questions questions{std::numeric_limits<std::uint64_t>::max() - 1, some()};
  questions.asked[0].params.seed = std::numeric_limits<std::uint64_t>::max() - 2;
  questions.asked[1].problem = "quotes \" and \xFF bytes";
  const Questions back = questions_from_json(to_json(questions));
  CHECK(back.seed == questions.seed);
  REQUIRE(back.asked.size() == 3);
  CHECK(back.asked[0].params.seed == questions.asked[0].params.seed);
  CHECK(back.asked[0].params.numbers.at("a") == 0.1);
  CHECK(back.asked[0].question == "n = 10");
  CHECK(back.asked[1].status == Status::crashed);
  CHECK(back.asked[2].columns == 2);
  CHECK_THROWS_AS(questions_from_json("{}"), carlo::Error);
  CHECK_THROWS_AS(questions_from_json("no JSON"), carlo::Error);
  CHECK_THROWS_AS(questions_from_json(R"({"seed": "x", "probes": []})"), carlo::Error);
}

TEST_CASE("a question is picked by number, or by name the first that failed", "[replay]") {
  const auto asked = some();
  CHECK(number_of(asked, pick(asked, "3")) == 3);
  CHECK(number_of(asked, pick(asked, "means")) == 2);
  CHECK(number_of(asked, pick(asked, "values")) == 3);
  CHECK_THROWS_AS(pick(asked, "0"), carlo::Error);
  CHECK_THROWS_AS(pick(asked, "4"), carlo::Error);
  CHECK_THROWS_AS(pick(asked, "other"), carlo::Error);
  CHECK_THROWS_AS(pick({}, "1"), carlo::Error);
}

TEST_CASE("the list names each test once and each question with its end", "[replay]") {
  const std::string text = listing(some());
  CHECK(text.find("it is unbiased\n") == text.rfind("it is unbiased\n"));
  CHECK(text.find("   2  means   n = 20: it crashed\n") != std::string::npos);
  CHECK(text.find("   3  values  2 values\n") != std::string::npos);
}
