#include "grader/calibrate/tables.h"

#include "grader/judge/compare.h"
#include "stats/distributions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace carlo::grader {
namespace {

Cell count(std::size_t n) {
  return static_cast<std::int64_t>(n);
}

Cell share(std::size_t part, std::size_t whole) {
  return {fmt::format("{} of {}", part, whole),
          whole == 0 ? std::nan("") : static_cast<double>(part) / static_cast<double>(whole)};
}

Cell p_cell(double p) {
  return {p < 1e-3 ? fmt::format("{:.1e}", p) : fmt::format("{:.3f}", p), p};
}

Cell lab_cell(int lab) {
  return {fmt::format("{:02}", lab), static_cast<double>(lab)};
}

/// Returns the level of one comparison's tests for uniformity.
double behaviour_level(const LabFinding& lab) {
  return sidak(uniformity_level, std::max<std::size_t>(1, lab.comparisons.size()));
}

/// How many orders of magnitude below the level a mistake should lie to be caught reliably.
constexpr double close_margin = 3;

Cell margin_cell(double margin) {
  if (std::isinf(margin)) return {margin > 0 ? "exact" : "none"};
  return {fmt::format("{:.1f}", margin)};
}

bool needs_attention(const MistakeFinding& mistake) {
  return mistake.caught < mistake.runs || mistake.alone < mistake.runs ||
         !(mistake.margin >= close_margin);
}

/// Returns "the mean of ...: in the test ...", and its index among several.
std::vector<Cell> name_cells(const ComparisonName& name) {
  const auto& [exercise, test, what, place] = name;
  return {exercise, place == 0 ? what : fmt::format("{} ({})", what, place + 1), test};
}

}  // namespace

Findings findings(const std::vector<Judged>& judged) {
  Findings all;
  std::vector<Judged> mistakes;
  for (const Judged& one : judged) {
    if (one.records.empty()) continue;
    if (one.subject.is_solution()) {
      all.labs.push_back(lab_finding(one));
    } else {
      all.mistakes.push_back(mistake_finding(one));
      mistakes.push_back(one);
    }
  }
  for (const LabFinding& lab : all.labs) {
    const std::vector<PowerFinding> power = power_findings(lab, mistakes);
    all.power.insert(all.power.end(), power.begin(), power.end());
  }
  return all;
}

Table rates_table(const Findings& findings) {
  Table table(
      {"lab", "gradings", "false failures", "rate below (95 %)", "comparisons", "level of each",
       "level of all", "CPU, median", "worst", "memory, worst (MB)"},
      {"lab", "gradings", "false_failures", "rate_upper_95", "comparisons", "comparison_alpha",
       "family_alpha", "cpu_seconds_median", "cpu_seconds_worst", "megabytes_worst"});
  for (const LabFinding& lab : findings.labs) {
    const std::size_t tests = lab.comparisons.size();
    const double family = -std::expm1(static_cast<double>(tests) * std::log1p(-comparison_alpha()));
    table.add_row({lab_cell(lab.lab), count(lab.gradings), count(lab.false_failures),
                   rate_upper_bound(lab.false_failures, lab.gradings), count(tests),
                   Cell(fmt::format("{:.2e}", comparison_alpha()), comparison_alpha()),
                   Cell(fmt::format("{:.1e}", family), family), seconds_cell(lab.median_seconds),
                   seconds_cell(lab.worst_seconds), number_cell(lab.worst_megabytes)});
  }
  return table;
}

Table uniformity_table(const Findings& findings) {
  Table table({"lab", "p-values", "smallest", "uniform: p", "too small: p", "so they are",
               "cautious comparisons", "uniform without them: p"},
              {"lab", "p_values", "smallest", "ks_two_sided", "ks_too_small", "behaviour",
               "cautious", "ks_two_sided_without_cautious"});
  for (const LabFinding& lab : findings.labs) {
    const auto cautious = std::count_if(
        lab.comparisons.begin(), lab.comparisons.end(), [&](const ComparisonFinding& one) {
          return one.behaviour(behaviour_level(lab)) == Behaviour::cautious;
        });
    table.add_row({lab_cell(lab.lab), count(lab.all.count), p_cell(lab.all.smallest),
                   p_cell(lab.all.either_way), p_cell(lab.all.too_small),
                   to_string(lab.all.behaviour(uniformity_level)),
                   static_cast<std::int64_t>(cautious), p_cell(lab.without_cautious.either_way)});
  }
  return table;
}

Table behaviour_table(const Findings& findings, bool all) {
  Table table({"exercise", "comparison", "test", "p-values", "smallest", "uniform: p",
               "too small: p", "so they are", "larger because"},
              {"exercise", "what", "test", "p_values", "smallest", "ks_two_sided", "ks_too_small",
               "behaviour", "caution"});
  for (const LabFinding& lab : findings.labs) {
    for (const ComparisonFinding& one : lab.comparisons) {
      const Behaviour behaviour = one.behaviour(behaviour_level(lab));
      if (!all && behaviour == Behaviour::uniform) continue;
      std::vector<Cell> row = name_cells(one.name);
      for (const Cell& cell : {count(one.uniformity.count), p_cell(one.uniformity.smallest),
                               p_cell(one.uniformity.either_way), p_cell(one.uniformity.too_small),
                               Cell(to_string(behaviour)), Cell(one.caution())})
        row.push_back(cell);
      table.add_row(row);
    }
  }
  return table;
}

Table catch_table(const Findings& findings) {
  Table table({"lab", "mistakes", "runs", "caught each time", "named in 95 % of runs",
               "runs caught", "runs named", "runs named alone"},
              {"lab", "mistakes", "runs", "always_caught", "named_in_95_percent", "runs_caught",
               "runs_named", "runs_named_alone"});
  for (int lab = 1; lab < 100; ++lab) {
    std::size_t mistakes = 0, runs = 0, always = 0, often = 0, caught = 0, named = 0, alone = 0;
    for (const MistakeFinding& one : findings.mistakes) {
      if (one.subject.lab != lab) continue;
      ++mistakes;
      runs += one.runs;
      caught += one.caught;
      named += one.named;
      alone += one.alone;
      always += one.caught == one.runs ? 1 : 0;
      often += 20 * one.named >= 19 * one.runs ? 1 : 0;
    }
    if (mistakes == 0) continue;
    table.add_row({lab_cell(lab), count(mistakes), count(runs), share(always, mistakes),
                   share(often, mistakes), share(caught, runs), share(named, runs),
                   share(alone, runs)});
  }
  return table;
}

Table mistakes_table(const Findings& findings, bool all) {
  Table table(
      {"exercise", "mistake", "diagnosis", "caught", "named", "named alone", "smallest margin",
       "not as expected"},
      {"exercise", "mistake", "diagnosis", "caught", "named", "alone", "margin", "unexpected"});
  for (const MistakeFinding& one : findings.mistakes) {
    if (!all && !needs_attention(one)) continue;
    table.add_row({"Lab " + one.subject.exercise, one.subject.what, one.subject.diagnosis,
                   share(one.caught, one.runs), share(one.named, one.runs),
                   share(one.alone, one.runs), margin_cell(one.margin), one.first_missed});
  }
  return table;
}

Table power_table(const Findings& findings) {
  Table table({"exercise", "comparison", "test", "sees from", "unit", "mistakes caught",
               "weakest of them", "its effect", "caught"},
              {"exercise", "what", "test", "resolution", "unit", "mistakes_caught", "weakest",
               "effect", "power"});
  for (const PowerFinding& one : findings.power) {
    const bool some = one.mistakes_caught > 0;
    std::vector<Cell> row = name_cells(one.comparison.name);
    for (const Cell& cell :
         {Cell(one.comparison.resolution),
          Cell(one.comparison.unit.empty() ? "as compared" : one.comparison.unit),
          count(one.mistakes_caught), some ? Cell(one.weakest.mistake) : Cell("–"),
          some ? Cell(one.weakest.effect) : empty_cell(),
          some ? share(one.weakest.caught, one.weakest.runs) : empty_cell()})
      row.push_back(cell);
    table.add_row(row);
  }
  return table;
}

Table claims_table(const Findings& findings) {
  Table table({"lab", "comparisons", "that caught a mistake", "runs of effects they claim to see",
               "caught"},
              {"lab", "comparisons", "useful", "runs_in_sight", "caught_in_sight"});
  for (const LabFinding& lab : findings.labs) {
    std::size_t useful = 0, runs = 0, caught = 0;
    for (const PowerFinding& one : findings.power) {
      if (one.lab != lab.lab) continue;
      useful += one.mistakes_caught > 0 ? 1 : 0;
      runs += one.runs_in_sight;
      caught += one.caught_in_sight;
    }
    table.add_row({lab_cell(lab.lab), count(lab.comparisons.size()), count(useful), count(runs),
                   share(caught, runs)});
  }
  return table;
}

}  // namespace carlo::grader
