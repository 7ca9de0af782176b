#include "grader/has.h"
#include "grader/judge/compare.h"
#include "grader/judge/figure_json.h"
#include "grader/judge/figures.h"
#include "grader/judge/report.h"
#include "grader/page/figure_svg.h"
#include "grader/page/grade_page.h"

#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace carlo::grader;
using nlohmann::json;

namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++count;
  return count;
}

/// Elements are closed as often as they are opened.
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

json demo_lab(const Verdict& verdict, const std::string& problem = "") {
  const carlo::Lab lab{7,
                       "demo",
                       "Demo",
                       {{"Lab 7.1", "First", 2, "L", {"f"}, {"a", "b"}},
                        {"Lab 7.2", "Second", 3, "L", {"g"}, {"a", "b"}},
                        {"Lab 7.3", "Third", 1, "L", {"h"}, {"a", "b"}}}};
  TestRecord failed{"Lab 7.1", "it holds", {verdict, verdict}, Status::failed, problem, problem};
  const TestRecord passed{
      "Lab 7.2", "it is right", {holds("it", true, "1", "1")}, Status::passed, "", ""};
  TestRecord open{"Lab 7.3", "it is done", {}, Status::not_implemented, "not implemented yet", ""};
  open.needs = "Lab 7.1";
  return json::parse(report_json(collect(lab, {failed, passed, open}, "")));
}

Verdict wrong_mean() {
  const std::vector<double> values(1000, 0.7);
  return mean_is("the mean of it", values, {0.5, 0.3, 0},
                 {{0.7, {"too-large", "it is too large."}}});
}

}  // namespace

TEST_CASE("the page shows points, diagnosis, numbers, figure and the hint's command", "[page]") {
  const std::string page = grade_page(demo_lab(wrong_mean()), {"Lab 07"});
  check_balanced(page);
  CHECK(has(page, "3 of 6 points"));
  CHECK(has(page, "It looks like this:"));
  CHECK(has(page, "it is too large."));
  CHECK(has(page, "0.7 ± 0.0095, the mean of 1000"));
  CHECK(has(page, "chance does not do that"));
  CHECK(has(page, "<svg"));
  CHECK(has(page, "./carlo hint 7.1"));
  CHECK(has(page, "calls Lab 7.1"));
  CHECK(has(page, "<details class=\"exercise passed\""));
  CHECK_FALSE(has(page, "<script"));
}

TEST_CASE("a crash stands first on the page, with how to find its line", "[page]") {
  const carlo::Lab lab{1, "demo", "Demo", {{"Lab 1.1", "First", 2, "L", {"f"}, {"a", "b"}}}};
  const TestRecord wrong{"Lab 1.1",      "small", {holds("it", false, "1", "2")},
                         Status::failed, "",      ""};
  const TestRecord crash{"Lab 1.1", "empty", {}, Status::crashed, "it crashed: abort", ""};
  const json verdicts = json::parse(report_json(collect(lab, {wrong, crash}, "")));
  const std::string page = grade_page(verdicts, {"Lab 01"});
  CHECK(page.find("✗ empty") < page.find("✗ small"));
  CHECK(has(page,
            "In which line it crashes (it builds for minutes, once): <code>CARLO_PRESET=debug "
            "./carlo test 1.1</code>"));
}

TEST_CASE("nothing that a student's program says becomes markup", "[page]") {
  Verdict verdict = holds(hostile, false, hostile, hostile, {{hostile, hostile}});
  verdict.certainty = hostile;
  for (const Figure& figure : every_kind()) {
    verdict.figure = figure;
    json lab = demo_lab(verdict, hostile);
    lab["title"] = lab["compiler"] = lab["note"] = lab["sandbox"] = hostile;
    lab["exercises"][0]["title"] = lab["exercises"][0]["tag"] = hostile;
    lab["exercises"][0]["status"] = hostile;
    lab["exercises"][2]["tests"][0]["needs"] = "Lab " + hostile;
    lab["exercises"][0]["unsound"] = {hostile};
    const std::string page = grade_page({lab, lab}, {hostile, hostile, {{hostile, hostile}}});
    check_balanced(page);
    CHECK_FALSE(has(page, "<script"));
    CHECK_FALSE(has(page, "<!--"));
    CHECK_FALSE(has(page, "onload=\""));
    CHECK_FALSE(has(page, "\x1b"));
    CHECK_FALSE(has(page, "\xFF"));
    CHECK_NOTHROW((void)json(page).dump());  // throws where it is no UTF-8
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
  json lab = demo_lab(wrong_mean());
  lab["exercises"][0]["aspects"] = {{"correctness", true}, {"variance", false}};
  lab["exercises"][0]["points"] = 1.5;
  const std::string page = grade_page(lab, {"Lab 07"});
  CHECK(has(page, "<span class=\"chip passed\">✓ correctness</span>"));
  CHECK(has(page, "<span class=\"chip failed\">✗ variance</span>"));
  CHECK(has(page, "◐<span class=\"words\"> in part</span>"));
  CHECK_FALSE(has(page, "efficiency"));
  CHECK(has(page, "1.5 of 2 points"));
  lab["exercises"][0]["aspects"] = {{"correctness", true}};
  CHECK_FALSE(has(grade_page(lab, {"Lab 07"}), "correctness"));
}

TEST_CASE("verdicts that lack something make a page without it", "[page]") {
  for (const json& labs : {json(), json(3), json::array(), json::object(), json{{"lab", 1}},
                           json{{{"lab", 1}, {"note", "did not compile"}}, 7},
                           json{{"exercises", {1, json::object(), {{"tests", {3}}}}}},
                           json{{"exercises",
                                 {{{"status", "failed"},
                                   {"diagnoses", {3, "x"}},
                                   {"tests", {{{"verdicts", {1, json::object()}}}}}}}}}}) {
    INFO(labs.dump());
    check_balanced(grade_page(labs, {"x"}));
  }
  json lab = demo_lab(wrong_mean());
  lab["exercises"][0]["tests"][0]["verdicts"][0]["figure"] = "none";
  CHECK(has(grade_page(lab, {"x"}), "cannot be read"));
  CHECK(has(grade_page({{{"lab", 1}, {"note", "did not compile"}}, {{"lab", 2}}}, {"x"}),
            "did not compile"));
}

TEST_CASE("a grading's record shows what was not judged", "[page]") {
  const json judged{
      {"lab", 7}, {"note", ""}, {"compiler", ""}, {"verdict", demo_lab(wrong_mean())}};
  const json broken{{"lab", 8},
                    {"title", "Broken"},
                    {"note", "does not compile"},
                    {"compiler", "path.cpp:3: error: expected ';'"},
                    {"verdict", nullptr},
                    {"exercises",
                     {{{"tag", "Lab 8.1"},
                       {"title", "A"},
                       {"points", 0},
                       {"max", 3},
                       {"status", "does_not_compile"}},
                      {{"tag", "Lab 8.2"},
                       {"title", "B"},
                       {"points", nullptr},
                       {"max", 1},
                       {"status", "grader_error"}}}}};
  const std::string page = grade_page({judged, broken}, {"Ada"});
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
  json lab = demo_lab(wrong_mean());
  CHECK(something_failed(lab));
  lab["exercises"][0]["status"] = "not_implemented";
  CHECK_FALSE(something_failed(lab));
  lab["exercises"][0]["status"] = "passed";
  CHECK_FALSE(something_failed(lab));
  lab["exercises"][0]["status"] = "crashed";
  CHECK(something_failed(lab));
}
