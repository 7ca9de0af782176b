#include "grader/calibrate/page.h"

#include "course/json/json_fields.h"
#include "course/report/results.h"

#include <fmt/core.h>

#include <algorithm>

namespace carlo::grader {
namespace {

std::size_t wrong_verdicts(const Findings& findings) {
  std::size_t count = 0;
  for (const LabFinding& lab : findings.labs)
    count += lab.false_failures;
  for (const MistakeFinding& mistake : findings.mistakes)
    count += mistake.runs - mistake.caught;
  return count;
}

/// Says, over all mistakes, how many are caught in every run, and how many named in 95 % of theirs.
std::string mistakes_sentence(const Findings& findings) {
  std::size_t caught = 0, named = 0;
  for (const MistakeFinding& one : findings.mistakes) {
    caught += one.caught == one.runs ? 1 : 0;
    named += 20 * one.named >= 19 * one.runs ? 1 : 0;
  }
  return fmt::format("Of {} mistakes {} are caught in every run, {} are named in 95 % of runs.",
                     findings.mistakes.size(), caught, named);
}

/// Charts the distribution of the p-values of each lab's solution: the share below p against p.
Chart p_value_chart(const Findings& findings) {
  Chart chart{"p-values of right solutions",
              "uniform ones lie on the diagonal; above it a comparison fails more than it claims",
              {"p", Unit::number, Scale::linear},
              {"share of p-values below p", Unit::number, Scale::linear},
              {}};
  for (const LabFinding& lab : findings.labs) {
    std::vector<double> p;
    for (const ComparisonFinding& one : lab.comparisons)
      p.insert(p.end(), one.p_values.begin(), one.p_values.end());
    std::sort(p.begin(), p.end());
    Series series{fmt::format("lab {:02}", lab.lab), {}};
    constexpr int steps = 50;
    for (int i = 0; i <= steps && !p.empty(); ++i) {
      const double x = static_cast<double>(i) / steps;
      const auto below = std::upper_bound(p.begin(), p.end(), x) - p.begin();
      series.points.push_back({x, static_cast<double>(below) / static_cast<double>(p.size())});
    }
    if (!p.empty()) chart.series.push_back(series);
  }
  return chart;
}

constexpr const char* rates_note =
    "Right solutions, graded with different seeds. The bound is the largest rate of false failures "
    "that these gradings do not exclude with 95 % confidence (Clopper and Pearson). The levels are "
    "what the comparisons promise; a lab's is what they add up to.";
constexpr const char* uniformity_note =
    "The p-values of a right solution are uniform on [0, 1]: Kolmogorov-Smirnov tests, either way "
    "and one-sided against values that are too small, which alone would fail right solutions too "
    "often. Cautious comparisons have p-values that are not uniform but larger: counts that take "
    "few values, and bounds. Comparisons of the same numbers depend on each other a little, which "
    "these tests leave out.";
constexpr const char* mistakes_note =
    "Named: the expected diagnosis is among the two that a report shows; alone: no other one "
    "stands beside it. The margin is the orders of magnitude by which p lay below the level in the "
    "run where that was least; \"exact\" where every run failed a comparison that no chance "
    "enters.";
constexpr const char* power_note =
    "A comparison sees an effect with power .999 from the size that its theory and its number of "
    "values give. Beside it stands the weakest mistake that it caught at least once, its mean "
    "effect, and in how many runs it was caught; below the resolution that need not be all. An "
    "effect on a mean that is also one on the spread is caught more or less often than that.";

}  // namespace

bool sound(const Findings& findings) {
  return wrong_verdicts(findings) == 0 &&
         std::none_of(findings.labs.begin(), findings.labs.end(), [](const LabFinding& lab) {
           return lab.all.behaviour(uniformity_level) == Behaviour::too_small;
         });
}

std::string report_text(const Findings& findings) {
  std::string out = "Right solutions\n" + rates_table(findings).text() + "\n";
  for (const LabFinding& lab : findings.labs) {
    for (const std::string& failure : lab.failures)
      out += fmt::format("false failure: {}\n", failure);
  }
  out += "Their p-values\n" + uniformity_table(findings).text() + "\n";
  const Table behaviour = behaviour_table(findings, false);
  if (!behaviour.rows().empty()) out += "Not uniform\n" + behaviour.text() + "\n";
  if (findings.mistakes.empty()) return out;
  out += "Mistakes\n" + catch_table(findings).text() + "\n";
  const Table close = mistakes_table(findings, false);
  if (!close.rows().empty()) {
    out += "Missed, not named, or caught by less than three orders of magnitude\n" + close.text() +
           "\n";
  }
  out += "Power\n" + claims_table(findings).text() + "\n";
  return out + mistakes_sentence(findings) + "\n";
}

std::string report_json(const Findings& findings) {
  const Results results{{{"false_failures", rates_table(findings)},
                         {"uniformity", uniformity_table(findings)},
                         {"comparisons", behaviour_table(findings, true)},
                         {"labs_mistakes", catch_table(findings)},
                         {"mistakes", mistakes_table(findings, true)},
                         {"claims", claims_table(findings)},
                         {"power", power_table(findings)}}};
  return json_text(results, 1) + "\n";
}

Page report_page(const Findings& findings) {
  Page page("Calibration of the grader", "How often it errs, measured");
  page.section("Right solutions");
  page.prose(rates_note);
  page.table(rates_table(findings));
  for (const LabFinding& lab : findings.labs) {
    for (const std::string& failure : lab.failures)
      page.note("False failure: " + failure);
  }
  page.section("p-values");
  page.prose(uniformity_note);
  page.table(uniformity_table(findings));
  page.chart(p_value_chart(findings));
  page.table(behaviour_table(findings, true), "Every comparison");
  page.section("Mistakes");
  page.prose(mistakes_sentence(findings) + " " + mistakes_note);
  page.table(catch_table(findings));
  page.table(mistakes_table(findings, true), "Every mistake");
  page.section("Power");
  page.prose(power_note);
  page.table(claims_table(findings));
  page.table(power_table(findings), "Every comparison");
  page.fact("command", "./carlo grade --calibrate");
  return page;
}

}  // namespace carlo::grader
