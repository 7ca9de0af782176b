#include "grader/grade/similarity.h"

#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

using namespace carlo;
using namespace carlo::grader;

namespace {

/// A lab of seven, all of whose 21 pairs have the same similarity but the first ones.
LabSimilarity lab_of_seven(const std::vector<SimilarPair>& first, double others) {
  LabSimilarity lab{"01_demo", {"a", "b", "c", "d", "e", "f", "g"}};
  lab.pairs = first;
  while (lab.pairs.size() < 21)
    lab.pairs.push_back({"a", "g", others, 1, 2});
  return lab;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at)
    ++found;
  return found;
}

const std::map<std::string, std::string> shown{{"a", "a"}, {"b", "student 2"}, {"c", "c"},
                                               {"d", "d"}, {"e", "e"},         {"f", "f"},
                                               {"g", "g"}, {"h", "h"}};

}  // namespace

TEST_CASE("Pairs stand out above the class's quartiles, and above what chance explains",
          "[similarity]") {
  const auto low = usual_of(lab_of_seven({{"a", "b", 0.9, 40, 80}}, 0.05));
  REQUIRE(low);
  CHECK(low->threshold == least_threshold);
  LabSimilarity spread = lab_of_seven({}, 0);
  for (std::size_t i = 0; i < spread.pairs.size(); ++i)
    spread.pairs[i].similarity = 0.05 * static_cast<double>(20 - i);
  const auto wide = usual_of(spread);
  REQUIRE(wide);
  CHECK(wide->lower == 0.25);
  CHECK(wide->median == 0.5);
  CHECK(wide->threshold == most_threshold);  // a ring of many does not hide itself
  CHECK_FALSE(usual_of({"01_demo", {"a", "b"}, {}, {{"a", "b", 1, 9, 9}}}));
}

TEST_CASE("Groups are what pairs above the threshold connect", "[similarity]") {
  const LabSimilarity lab = lab_of_seven(
      {{"a", "b", 0.9, 9, 9}, {"e", "c", 0.8, 9, 9}, {"c", "b", 0.7, 9, 9}, {"f", "g", 0.6, 9, 9}},
      0.1);
  using Groups = std::vector<std::vector<std::string>>;
  CHECK(groups_of(lab, 0.5) == Groups{{"a", "b", "c", "e"}, {"f", "g"}});
  CHECK(groups_of(lab, 0.85) == Groups{{"a", "b"}});
  CHECK(groups_of(lab, 0.9).empty());
}

TEST_CASE("The page warns, escapes what students wrote, and names nobody if asked",
          "[similarity]") {
  LabSimilarity lab = lab_of_seven({{"a", "b", 0.9, 40, 80}}, 0.05);
  lab.pairs[0].fragments = {
      {{{"x.cpp", 7, "</pre><script>alert(1)</script>\x1b[2J"}}, {{"x.cpp", 9, "// by Alice"}}, 3}};
  lab.left_out = {{"h", "is not text"}};
  const std::string open = similarity_page({lab}, shown, true).html();
  CHECK(open.find("These figures prove nothing") < open.find("stands out"));
  CHECK(count(open, "&lt;/pre&gt;&lt;script&gt;") == 1);
  CHECK(count(open, "<script>alert") == 0);
  CHECK(count(open, "\x1b") == 0);
  CHECK(count(open, "student 2") >= 3);
  CHECK(count(open, "and 3 lines more") == 1);
  CHECK(count(open, "is not text") == 1);
  const std::string closed = similarity_page({lab}, shown, false).html();
  CHECK(count(closed, "Alice") == 0);
  CHECK(count(closed, "x.cpp, lines 7 to 7") == 1);
  const std::string csv = similarity_csv({lab});
  CHECK(csv.find("01_demo,a,b,0.9000,40,80,stands out\n") != std::string::npos);
  CHECK(csv.find("01_demo,h,,,,,not compared: is not text\n") != std::string::npos);
  CHECK(count(csv, "\n") == 1 + 21 + 1);
}

TEST_CASE("A result that cannot be read is refused", "[similarity]") {
  CHECK_THROWS_AS(similarities_from_json("{}"), Error);
  CHECK_THROWS_AS(similarities_from_json("nothing"), Error);
  CHECK(similarities_from_json(R"({"labs": [{"folder": "01_demo", "compared": ["a"],
    "left_out": [{"name": "b", "why": "is not text"}], "pairs": []}]})")
            .at(0)
            .left_out.at(0)
            .second == "is not text");
}
