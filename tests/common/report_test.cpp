#include "course/cli/wrap.h"
#include "course/json/json_fields.h"
#include "course/report/format.h"
#include "course/report/html.h"
#include "course/report/notebook.h"
#include "course/report/page.h"
#include "course/report/results.h"
#include "course/report/table.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using carlo::Page;
using carlo::Table;

namespace {

std::vector<std::string> lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(in, line);)
    result.push_back(line);
  return result;
}

carlo::Chart chart_named(const std::string& name) {
  carlo::Chart chart{name, "", {"N", carlo::Unit::count}, {"error"}, {}};
  chart.series.push_back({name, {{16, 0.25}, {64, 0.125}, {256, 0.0625}}});
  return chart;
}

/// The numbers of the first path of this kind in the page's drawing.
std::vector<double> path_of(const std::string& html, const std::string& kind) {
  const std::size_t at = html.find("<path class=\"" + kind);
  REQUIRE(at != std::string::npos);
  std::string path = html.substr(html.find(" d=\"", at) + 4);
  path = path.substr(0, path.find('"'));
  for (char& c : path)
    if (c == 'M' || c == 'L') c = ' ';
  std::istringstream in(path);
  std::vector<double> numbers;
  for (double number = 0; in >> number;)
    numbers.push_back(number);
  return numbers;
}

const std::string hostile = "</script><script>alert('x')</script><b>&\"";

}  // namespace

TEST_CASE("Formulas in a page's words are set as formulas, and everything is escaped", "[report]") {
  using carlo::html_typeset;
  CHECK(html_typeset("falls as N^(-2/d), x^7 and x^-1/4.") ==
        "falls as N<sup>−2/d</sup>, x<sup>7</sup> and x<sup>−1/4</sup>.");
  CHECK(html_typeset("2^10, ... of 2^32; cos^n, x^2.5") ==
        "2<sup>10</sup>, ... of 2<sup>32</sup>; cos<sup>n</sup>, x<sup>2.5</sup>");
  CHECK(html_typeset("p < 1e-10, 2.5e6 and 1e7") ==
        "p &lt; 10<sup>−10</sup>, 2.5·10<sup>6</sup> and 10<sup>7</sup>");
  CHECK(html_typeset("-0.5 to (-.25)") == "−0.5 to (−.25)");
  for (const char* plain :
       {"", "^", "a ^ b", "x^", "x^-", "1e", "1ex", "0x1e5", "lab-1", "e-5", "a - b", "1-2"})
    CHECK(html_typeset(plain) == plain);
  CHECK(html_typeset("x^(<b>)^'") == "x<sup>&lt;b&gt;</sup>^&#39;");
  CHECK(html_typeset("x^(1") == "x^(1");
  CHECK(html_typeset("x^-1/n") == "x<sup>−1</sup>/n");
}

TEST_CASE("Numbers are written for people", "[report]") {
  CHECK(carlo::number_text(0) == "0");
  CHECK(carlo::number_text(1.5) == "1.5");
  CHECK(carlo::number_text(-0.012345) == "-0.01235");
  CHECK(carlo::number_text(999.96) == "1000");
  CHECK(carlo::number_text(1234567) == "1.235e6");
  CHECK(carlo::number_text(1e-9) == "1e-9");
  CHECK(carlo::number_text(std::nan("")) == "nan");
  CHECK(carlo::number_text(-std::numeric_limits<double>::infinity()) == "-inf");
  CHECK(carlo::count_text(4096) == "4096");
  CHECK(carlo::count_text(-1234567) == "-1\u2009234\u2009567");
  CHECK(carlo::duration_text(0.00123) == "1.23 ms");
  CHECK(carlo::duration_text(0.0009999) == "1 ms");
  CHECK(carlo::duration_text(2e-7) == "200 ns");
  CHECK(carlo::duration_text(90) == "90 s");
  CHECK(carlo::interval_text(-0.50123, 0.0123) == "-0.501 ± 0.012");
  CHECK(carlo::interval_text(2, 0) == "2 ± 0");
  CHECK(carlo::interval_text(1, std::nan("")) == "1 ± nan");
}

TEST_CASE("A table aligns words left and numbers right, counting letters and not bytes",
          "[report]") {
  REQUIRE(::setenv("NO_COLOR", "1", 1) == 0);
  Table table({"µ-name", "value", "n"});
  table.add_row({"é", 1.5, 7});
  table.add_row({"longer name", 123.5, 65536});
  const auto rows = lines(table.text());
  REQUIRE(rows.size() == 3);
  for (const std::string& row : rows) {
    CHECK(carlo::display_width(row) == carlo::display_width(rows[0]));
  }
  CHECK(rows[0] == "µ-name       value       n");
  CHECK(rows[1] == "é              1.5       7");
  CHECK(rows[2] ==
        "longer name  123.5  65\u2009"
        "536");
}

TEST_CASE("A table wider than the terminal goes on below, behind the names of its rows",
          "[report]") {
  REQUIRE(::setenv("NO_COLOR", "1", 1) == 0);
  Table table({"method", "first value", "second value", "third value"});
  table.add_row({"one", 1.5, 2.5, 3.5});
  table.add_row({"another", 10, 20, 30});
  CHECK(table.text(0) == table.text(80));
  const auto rows = lines(table.text(36));
  REQUIRE(rows.size() == 7);
  for (const std::string& row : rows)
    CHECK(carlo::display_width(row) <= 36);
  CHECK(rows[0] == "method   first value  second value");
  CHECK(rows[2] == "another           10            20");
  CHECK(rows[3].empty());
  CHECK(rows[4] == "method   third value");
  CHECK(rows[6] == "another           30");
  CHECK(lines(table.text(5)).size() == 11);  // at least one column in each block
  CHECK(lines(Table({"alone"}).text(3)).size() == 1);
  table.add_row({"one", 1.75, 2.5, 3.5});  // a second one: its first value tells it apart
  CHECK(lines(table.text(36))[5] == "method   first value  third value");
}

TEST_CASE("Words in a table's last column break at the terminal's width", "[report]") {
  REQUIRE(::setenv("NO_COLOR", "1", 1) == 0);
  Table table({"n", "remark"});
  table.add_row({1, "a remark that is longer than the line"});
  const auto rows = lines(table.text(30));
  REQUIRE(rows.size() == 3);
  CHECK(rows[1] == "1  a remark that is longer");
  CHECK(rows[2] == "   than the line");
}

TEST_CASE("A table says in JSON what it shows, at full precision", "[report]") {
  Table table({"method", "error"}, {"name", "rms"});
  table.add_row({"a \"quoted\" name", 1.0 / 3});
  table.add_row({"bad", std::nan("")});
  const auto json = nlohmann::json::parse(carlo::json_text(carlo::Results{{{"t", table}}})).at("t");
  CHECK(json.at(0).at("name") == "a \"quoted\" name");
  CHECK(json.at(0).at("rms").get<double>() == 1.0 / 3);
  CHECK(json.at(1).at("rms").is_null());
}

TEST_CASE("A table refuses rows of another width", "[report]") {
  Table table({"a", "b"});
  CHECK_THROWS_AS(table.add_row({"alone"}), carlo::Error);
  CHECK_THROWS_AS(Table({}), carlo::Error);
  CHECK_THROWS_AS(Table({"a", "b"}, {"a"}), carlo::Error);
}

TEST_CASE("Whatever text a page is given stays text", "[report]") {
  Page page(hostile, hostile);
  page.section(hostile);
  page.prose(hostile);
  page.note(hostile);
  page.chart(chart_named(hostile));
  Table table({hostile});
  table.add_row({hostile});
  page.table(table, hostile);
  page.fact(hostile, hostile);
  const std::string html = page.html();
  CHECK(occurrences(html, "<b>") == 0);
  CHECK(occurrences(html, "<script>alert") == 0);
  // A page of text and charts has no script, and no text opens or closes one.
  CHECK(occurrences(html, "<script") == 0);
  CHECK(occurrences(html, "</script") == 0);
  // The title; the series in the legend, in the description, at its 3 points and in 3 rows.
  CHECK(occurrences(html, carlo::html_escaped(hostile)) >= 9);
}

TEST_CASE("Placeholders in a page's text are not filled in", "[report]") {
  Page page("{{css}}");
  page.prose("{{scripts}} and {{");
  const std::string html = page.html();
  CHECK(html.find("<title>{{css}}</title>") != std::string::npos);
  CHECK(html.find("<p>{{scripts}} and {{</p>") != std::string::npos);
}

TEST_CASE("Code in a page cannot end its script element", "[report]") {
  Page page("raw");
  page.script("const s = '</SCRIPT><!--';");
  const std::string html = page.html();
  CHECK(html.find("const s = '<\\/SCRIPT><\\!--';") != std::string::npos);
  CHECK(carlo::script_escaped("a < b / c </script</script") == "a < b / c <\\/script<\\/script");
}

TEST_CASE("A chart carries its points, its fitted line and a table of both", "[report]") {
  carlo::Chart chart = chart_named("error");
  carlo::Series& series = chart.series[0];
  series.fit =
      carlo::fit_power_law(std::vector{16.0, 64.0, 256.0}, std::vector{0.25, 0.125, 0.0625});
  series.points.push_back({1024, std::nan("")});
  Page page("page");
  page.chart(chart);
  const std::string html = page.html();
  // Four numbers, three of which can be drawn; the line goes through them and has a band.
  CHECK(occurrences(html, "<td>error</td>") == 4);
  CHECK(occurrences(html, "<path class=\"mark") == 3);
  CHECK(occurrences(html, "<path class=\"line dashed\"") == 1);
  CHECK(occurrences(html, "<path class=\"band") == 1);
  const std::vector<double> line = path_of(html, "line dashed"), mark = path_of(html, "mark");
  REQUIRE(line.size() == 50);
  CHECK(std::fabs(line[0] - mark[0]) <= 0.1);
  CHECK(std::fabs(line[1] - mark[1]) <= 0.1);
  for (std::size_t i = 2; i < 48; i += 2) {
    const double along = (line[i] - line[0]) / (line[48] - line[0]);
    CHECK(std::fabs(line[1] + along * (line[49] - line[1]) - line[i + 1]) <= 0.15);
  }
  CHECK(html.find("N: 64\nerror: 0.125</title>") != std::string::npos);
  CHECK(html.find("<small> slope −0.5") != std::string::npos);
  CHECK(html.find("<td class=\"number\">0.0625</td>") != std::string::npos);
  CHECK(html.find("aria-label=\"Chart: error.") != std::string::npos);
}

TEST_CASE("An experiment draws the same numbers whenever it runs", "[report]") {
  carlo::Page page("title");
  const auto first_word = [&page](int index, double from, double to) {
    carlo::Notebook notebook("label", {.seed = 7}, page);
    notebook.set_experiment(index, from, to);
    return notebook.rng().uniform();
  };
  CHECK(first_word(3, 0, 1) == first_word(3, 0.5, 0.6));
  CHECK(first_word(3, 0, 1) != first_word(0, 0, 1));
}

TEST_CASE("A page needs nothing from outside and is the same each time", "[report]") {
  Page page("page");
  page.chart(chart_named("error"));
  const std::string html = page.html();
  CHECK(html == page.html());
  for (const char* outside : {"src=", "href=\"http", "@import", "url("}) {
    CHECK(occurrences(html.substr(0, html.find("<script")), outside) == 0);
  }
  CHECK(occurrences(html, "{{") == 0);
}

TEST_CASE("A page makes its folder, and says so when it cannot", "[report]") {
  const auto folder =
      std::filesystem::temp_directory_path() / ("carlo_report_test." + std::to_string(::getpid()));
  std::filesystem::remove_all(folder);
  Page page("page");
  page.write(folder / "deep" / "page.html");
  CHECK(carlo::read_file(folder / "deep" / "page.html") == page.html());
  // A file where a folder would have to be.
  CHECK_THROWS_AS(page.write(folder / "deep" / "page.html" / "other.html"), carlo::Error);
  std::filesystem::remove_all(folder);
}

TEST_CASE("Cells of numbers and shares show few digits and keep all", "[report]") {
  CHECK(carlo::number_cell(1.23456).text == "1.23");
  CHECK(carlo::number_cell(1.23456, 5).text == "1.2346");
  CHECK(carlo::number_cell(1.23456).value == 1.23456);
  CHECK(carlo::percent_cell(0.0123456).text == "1.23 %");
  CHECK(carlo::percent_cell(0.0123456).value == 0.0123456);
}
