#include "battery.h"
#include "course/report/format.h"
#include "course/report/html.h"
#include "course/report/page.h"
#include "experiments.h"
#include "support/wall_clock.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

// The table generator x test: the sample size at which each test first rejects each generator.

namespace carlo::web {
std::string_view heat_css();
}

namespace lab03 {
namespace {

constexpr double level = 1e-10;
constexpr int first_log2 = 10;

/// The result of one test on one generator.
struct Finding {
  bool judged = false;  ///< the test could be applied at some sample size
  int log2_n = 0;       ///< of the first rejection; without one, of the largest sample tested
  bool rejected = false;
  TestResult result;  ///< at that size
};

class Judge {
 public:
  Judge(const Generator& generator, std::span<const std::uint32_t> words)
      : generator_(generator), words_(words) {}

  /// Tests the largest sample first: a generator that passes there is not tested again.
  Finding find(const RandomnessTest& test) const {
    const int most = std::min(test.most_log2, static_cast<int>(std::bit_width(words_.size())) - 1);
    Finding finding = largest(test, most);
    if (!finding.rejected) return finding;
    for (int log2_n = first_log2; log2_n < finding.log2_n; ++log2_n) {
      const Finding smaller = at(test, log2_n);
      if (smaller.rejected) return smaller;
    }
    return finding;
  }

 private:
  Finding at(const RandomnessTest& test, int log2_n) const {
    const Outcome outcome =
        test.run({words_.first(std::size_t{1} << log2_n), generator_.bits, generator_.lags});
    if (!outcome) return {};
    return {true, log2_n, two_sided(*outcome) < level, *outcome};
  }

  Finding largest(const RandomnessTest& test, int most) const {
    for (int log2_n = most; log2_n >= first_log2; --log2_n) {
      const Finding finding = at(test, log2_n);
      if (finding.judged) return finding;
    }
    return {};
  }

  const Generator& generator_;
  std::span<const std::uint32_t> words_;
};

/// The tests that can run: those that count cells need Lab 3.7.
std::vector<RandomnessTest> runnable_tests(Notebook& notebook) {
  std::vector<RandomnessTest> tests;
  std::vector<std::uint32_t> words(1 << 18);
  find_generator("philox").make(1)(words);
  for (const RandomnessTest& test : battery()) {
    notebook.attempt([&] {
      for (int log2_n = first_log2; log2_n <= std::min(18, test.most_log2); ++log2_n)
        (void)test.run({std::span<const std::uint32_t>(words).first(std::size_t{1} << log2_n)});
      tests.push_back(test);
    });
  }
  return tests;
}

struct Row {
  const Generator* generator;
  std::vector<Finding> findings;
  double seconds = 0;
};

std::string short_text(const Finding& finding) {
  if (!finding.judged) return "";
  if (!finding.rejected) return "·";
  return fmt::format("{}{}", finding.log2_n,
                     finding.result.p_lower < finding.result.p_upper ? "-" : "+");
}

/// A cell's text and colour: the smaller the sample that was enough, the stronger.
std::string cell_html(const Finding& finding) {
  if (!finding.judged) return "<td class=\"none\">not applicable</td>";
  const auto& [statistic, lower, upper] = finding.result;
  const std::string tails = fmt::format("statistic {:.5g}; lower tail {:.3g}, upper tail {:.3g}",
                                        statistic, lower, upper);
  if (!finding.rejected) {
    return fmt::format(
        "<td class=\"pass\" title=\"{}\">p = {}<small>at 2<sup>{}</sup></small></td>", tails,
        carlo::html_typeset(carlo::number_text(two_sided(finding.result), 2)), finding.log2_n);
  }
  const double strength = std::clamp((26.0 - finding.log2_n) / 16, 0.25, 1.0);
  return fmt::format(
      "<td class=\"fail\" style=\"--strength:{:.0f}%\" title=\"{}\"><b>2<sup>{}</sup></b>"
      "<small>{}</small></td>",
      60 * strength, tails, finding.log2_n, lower < upper ? "too even" : "too uneven");
}

std::string heat_map(const std::vector<RandomnessTest>& tests, const std::vector<Row>& rows) {
  std::string html = fmt::format("<style>{}</style>", carlo::web::heat_css());
  html +=
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Table of generators and "
      "tests\"><table class=\"heat\"><caption><span>Numbers until the first rejection at p &lt; "
      "10<sup>−10</sup>, or the p-value at the largest sample. Point at a cell for both "
      "tails.</span></caption><thead><tr><th scope=\"col\"></th>";
  for (const RandomnessTest& test : tests) {
    html += fmt::format("<th scope=\"col\" title=\"{}\">{}</th>", carlo::html_escaped(test.about),
                        carlo::html_escaped(test.name));
  }
  html += "</tr></thead><tbody>";
  for (const Row& row : rows) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", carlo::html_escaped(row.generator->name));
    for (const Finding& finding : row.findings)
      html += cell_html(finding);
    html += "</tr>";
  }
  return html + "</tbody></table></div>";
}

/// The letter of a test's column: the same whether or not all others can run.
char letter_of(const RandomnessTest& test) {
  const auto& all = battery();
  const auto place = std::find_if(
      all.begin(), all.end(), [&](const RandomnessTest& other) { return other.key == test.key; });
  return static_cast<char>('a' + (place - all.begin()));
}

/// The table for the console: one narrow column per test.
carlo::Table short_table(const std::vector<RandomnessTest>& tests, const std::vector<Row>& rows) {
  std::vector<std::string> titles = {"generator"}, keys = {"generator"};
  for (const RandomnessTest& test : tests) {
    titles.push_back(std::string(1, letter_of(test)));
    keys.push_back(test.key);
  }
  titles.emplace_back("time");
  keys.emplace_back("seconds");
  carlo::Table table(titles, keys);
  for (const Row& row : rows) {
    std::vector<carlo::Cell> cells = {row.generator->name};
    for (const Finding& finding : row.findings)
      cells.emplace_back(short_text(finding));
    cells.push_back(carlo::seconds_cell(row.seconds));
    table.add_row(std::move(cells));
  }
  return table;
}

carlo::Table tails_table(const std::vector<RandomnessTest>& tests, const std::vector<Row>& rows) {
  carlo::Table table(
      {"generator", "test", "numbers", "log2", "statistic", "lower tail", "upper tail", "verdict"},
      {"generator", "test", "numbers", "log2", "statistic", "p_lower", "p_upper", "verdict"});
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < tests.size(); ++i) {
      const Finding& f = row.findings[i];
      if (!f.judged) continue;
      table.add_row({row.generator->name, tests[i].name, std::int64_t{1} << f.log2_n,
                     std::int64_t{f.log2_n}, f.result.statistic, f.result.p_lower, f.result.p_upper,
                     f.rejected ? "rejected" : "passed"});
    }
  }
  return table;
}

/// Explains the console's table; the page's table explains itself.
std::string legend(const std::vector<RandomnessTest>& tests) {
  std::string text =
      "log2 of the numbers until the first rejection, - too even, + too uneven; a dot: passed;\n"
      "nothing: the test does not apply";
  for (std::size_t i = 0; i < tests.size(); ++i)
    text += fmt::format("{}{} {}", i % 3 == 0 ? "\n" : ", ", letter_of(tests[i]), tests[i].name);
  return text;
}

std::vector<Row> judge_all(Notebook& notebook, const std::vector<RandomnessTest>& tests) {
  std::vector<Row> rows;
  std::vector<std::uint32_t> words(std::bit_floor(
      static_cast<std::size_t>(std::min<std::int64_t>(notebook.options().n, 1 << 24))));
  double step = 0;
  for (const Generator& generator : generators()) {
    notebook.progress(step++, static_cast<double>(generators().size()));
    notebook.attempt([&] {
      const carlo::WallClock clock;
      generator.make(notebook.options().seed)(words);
      const Judge judge(generator, words);
      Row row{&generator, {}, 0};
      for (const RandomnessTest& test : tests)
        row.findings.push_back(judge.find(test));
      row.seconds = clock.seconds();
      rows.push_back(std::move(row));
    });
  }
  return rows;
}

}  // namespace

void battery_experiment(Notebook& notebook) {
  notebook.begin("Which test catches which generator");
  const std::vector<RandomnessTest> tests = runnable_tests(notebook);
  const std::vector<Row> rows = judge_all(notebook, tests);
  notebook.say(
      "Each test looks at the first 2^10, 2^11, ... numbers of a stream, as long as the "
      "distribution of its result is known. A generator is rejected if a perfect one would be that "
      "far off, to either side, once in 10^10 tries.");
  if (rows.empty() || tests.empty()) return;
  notebook.table("battery", short_table(tests, rows), legend(tests), heat_map(tests, rows));
  notebook.data("battery_tails", tails_table(tests, rows), "Both tails of every test");
}

}  // namespace lab03
