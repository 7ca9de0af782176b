#include "course/verdict/verdict_json.h"
#include "grader/judge/compare.h"
#include "grader/judge/figures.h"
#include "grader/judge/results.h"
#include "grader/page/figure_svg.h"
#include "grader/page/grade_page.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace carlo;
using namespace carlo::grader;
using nlohmann::json;

namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++count;
  return count;
}

/// Checks that elements are closed as often as they are opened.
void check_balanced(const std::string& html) {
  for (const std::string tag : {"svg", "figure", "table", "details", "article", "div", "dl", "p",
                                "span", "pre", "section", "main", "title"}) {
    INFO(tag);
    CHECK(count_of(html, "<" + tag + ">") + count_of(html, "<" + tag + " ") ==
          count_of(html, "</" + tag + ">"));
  }
}

const std::string hostile =
    "</script><script>alert(1)</script><!-- \"' onload=\"x\" & \xFF\xC3 \x01\x1b[2J </pre></svg>";

Figure hostile_listing() {
  return {hostile, hostile, ListingFigure{{hostile, "b"}, {{hostile, hostile}}}};
}

std::vector<Figure> every_kind() {
  constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  HistogramFigure histogram{hostile, 0, 1, {1, nan_value, 3}, {2, infinity, 2}, {1, 1, 1}, {}};
  histogram.marks = {{0.5, hostile, Mark::Role::measured}, {nan_value, "x", Mark::Role::expected}};
  return {
      {hostile, hostile, histogram},
      {hostile, "", HistogramFigure{"x", 0, 1, {0}, {}, {}, {}}},
      {hostile, hostile,
       PointsFigure{hostile,
                    hostile,
                    true,
                    false,
                    {{-1, infinity, infinity, nan_value}, {3, 1, infinity, 2}, {4, 2, 1, 2}}}},
      {"", "", PointsFigure{"x", "y", false, true, {}}},
      {"", "", PointsFigure{"x", "y", true, true, {{0, 1, 0, 1}}}},
      {"", "", PointsFigure{"x", "y", false, false, {{1, 1e308, 1e308, -1e308}}}},
      {hostile, hostile,
       GridFigure{hostile, hostile, 2, {1, nan_value, 3, infinity}, {1, 2, 3, 4}, {0, 0, 0, 1}}},
      hostile_listing()};
}

/// Returns the result as a page gets it: of bounded size, in valid UTF-8.
LabResult read_back(const LabResult& result) {
  return lab_result_from_text(to_text(result));
}

LabPage demo_lab(const Verdict& verdict, const std::string& problem = "") {
  const carlo::Lab lab{7,
                       "demo",
                       "Demo",
                       {{"Lab 7.1", "First", 2, {"f"}, {"a", "b"}},
                        {"Lab 7.2", "Second", 3, {"g"}, {"a", "b"}},
                        {"Lab 7.3", "Third", 1, {"h"}, {"a", "b"}}}};
  TestRecord failed{"Lab 7.1", "it holds", {verdict, verdict}, Status::failed, problem, problem};
  const TestRecord passed{
      "Lab 7.2", "it is right", {holds("it", true, "1", "1")}, Status::passed, "", ""};
  TestRecord open{"Lab 7.3", "it is done", {}, Status::not_implemented, "not implemented yet", ""};
  open.needs = "Lab 7.1";
  return {read_back(collect(lab, {failed, passed, open}, ""))};
}

Verdict wrong_mean() {
  const std::vector<double> values(1000, 0.7);
  return mean_is("the mean of it", values, {0.5, 0.3, 0},
                 {{0.7, {"too-large", "it is too large."}}});
}

}  // namespace

TEST_CASE("the page shows points, diagnosis, numbers, figure and the hint's command", "[page]") {
  const std::string page = grade_page({demo_lab(wrong_mean())}, {"Lab 07"});
  check_balanced(page);
  CHECK(has(page, "3 of 6 points"));
  CHECK(has(page, "Likely cause:"));
  CHECK(has(page, "it is too large."));
  CHECK(has(page, "0.7 ± 0.0095, the mean of 1000"));
  CHECK(has(page, "this cannot be chance"));
  CHECK(has(page, "<svg"));
  CHECK(has(page, "./carlo hint 7.1"));
  CHECK(has(page, "calls Lab 7.1"));
  CHECK(has(page, "<details class=\"exercise passed\""));
  CHECK_FALSE(has(page, "<script"));
}

TEST_CASE("a crash stands first on the page, with how to find its line", "[page]") {
  const carlo::Lab lab{1, "demo", "Demo", {{"Lab 1.1", "First", 2, {"f"}, {"a", "b"}}}};
  const TestRecord wrong{"Lab 1.1",      "small", {holds("it", false, "1", "2")},
                         Status::failed, "",      ""};
  TestRecord crash{"Lab 1.1", "empty", {}, Status::crashed, "it crashed: abort", ""};
  crash.lacks_line = true;
  const std::string page = grade_page({{collect(lab, {wrong, crash}, "")}}, {"Lab 01"});
  CHECK(page.find("✗ empty") < page.find("✗ small"));
  CHECK(
      has(page,
          "To find the line of the crash (the first build takes minutes): <code>CARLO_PRESET=debug "
          "./carlo test 1.1</code>"));
}

TEST_CASE("nothing that a student's program says becomes markup", "[page]") {
  Verdict verdict = holds(hostile, false, hostile, hostile, {{hostile, hostile}});
  verdict.certainty = hostile;
  for (const Figure& figure : every_kind()) {
    verdict.figure = figure;
    LabPage lab = demo_lab(verdict, hostile);
    lab.compiler = lab.note = hostile;
    lab.result.title = lab.result.sandbox = hostile;
    lab.result.exercises[0].title = hostile;
    lab.result.exercises[0].tag = "Lab " + hostile;
    lab.result.exercises[2].tests[0].needs = "Lab " + hostile;
    lab.result.exercises[0].unsound = {hostile};
    lab.result = read_back(lab.result);
    const std::string page = grade_page({lab, lab}, {hostile, hostile, {{hostile, hostile}}});
    check_balanced(page);
    CHECK_FALSE(has(page, "<script"));
    CHECK_FALSE(has(page, "<!--"));
    CHECK_FALSE(has(page, "onload=\""));
    CHECK_FALSE(has(page, "\x1b"));
    CHECK_FALSE(has(page, "\xFF"));
    CHECK_NOTHROW((void)json(page).dump());  // throws if it is not UTF-8
  }
}

TEST_CASE("numbers that are none are drawn nowhere", "[page]") {
  for (const Figure& figure : every_kind()) {
    const std::string html = figure_html(figure);
    check_balanced(html);
    for (std::size_t at = 0; (at = html.find(" d=\"", at)) != std::string::npos; ++at) {
      const std::string path = html.substr(at, html.find('"', at + 4) - at);
      CHECK_FALSE(has(path, "nan"));
      CHECK_FALSE(has(path, "inf"));
    }
    for (const char* attribute : {"x=\"", "y=\"", "cx=\"", "cy=\"", "width=\"", "height=\""}) {
      CHECK_FALSE(has(html, std::string(attribute) + "nan"));
      CHECK_FALSE(has(html, std::string(attribute) + "inf"));
      CHECK_FALSE(has(html, std::string(attribute) + "-nan"));
    }
  }
}

TEST_CASE("the aspects that are judged apart have a mark each", "[page]") {
  LabPage lab = demo_lab(wrong_mean());
  ExerciseResult& first = lab.result.exercises[0];
  const TestRecord good{"Lab 7.1", "it is right", {}, Status::passed, "", ""};
  TestRecord noisy = first.tests[0];
  noisy.aspect = Aspect::variance;
  first.tests = {good, noisy};
  first.points = 1.5;
  const std::string page = grade_page({lab}, {"Lab 07"});
  CHECK(has(page, "<span class=\"chip passed\">✓ correctness</span>"));
  CHECK(has(page, "<span class=\"chip failed\">✗ variance</span>"));
  CHECK(has(page, "◐<span class=\"words\"> in part</span>"));
  CHECK_FALSE(has(page, "efficiency"));
  CHECK(has(page, "1.5 of 2 points"));
  first.tests = {good};
  CHECK_FALSE(has(grade_page({lab}, {"Lab 07"}), "correctness"));
}

TEST_CASE("a grading's record shows what was not judged", "[page]") {
  LabPage broken;
  broken.result.lab = 8;
  broken.result.title = "Broken";
  broken.note = "does not compile";
  broken.compiler = "path.cpp:3: error: expected ';'";
  ExerciseResult first, second;
  first.tag = "Lab 8.1";
  first.max = 3;
  first.status = Status::does_not_compile;
  second.tag = "Lab 8.2";
  second.max = 1;
  second.status = Status::grader_error;
  broken.result.exercises = {first, second};
  const std::string page = grade_page({demo_lab(wrong_mean()), broken}, {"Ada"});
  check_balanced(page);
  CHECK(has(page, "3 of 10 points"));
  CHECK(has(page, "Lab 07: Demo – 3 of 6 points"));
  CHECK(has(page, "Lab 08: Broken – 0 of 4 points"));
  CHECK(has(page, "path.cpp:3: error: expected &#39;;&#39;"));
  CHECK(has(page, "it is too large."));
  CHECK(has(page, "not graded"));
  CHECK(has(page, "? of 1 points"));
}

TEST_CASE("a page is offered when something failed, not when nothing is done", "[page]") {
  LabResult lab = demo_lab(wrong_mean()).result;
  CHECK(something_failed(lab));
  for (const auto& [status, failed] :
       {std::pair{Status::not_implemented, false}, std::pair{Status::passed, false},
        std::pair{Status::crashed, true}}) {
    lab.exercises[0].status = status;
    CHECK(something_failed(lab) == failed);
  }
}
