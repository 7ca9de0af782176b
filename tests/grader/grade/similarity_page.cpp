#include "course/verdict/printed.h"
#include "grader/grade/similarity.h"
#include "grader/judge/numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>

namespace carlo::grader {
namespace {

using Shown = std::map<std::string, std::string>;

constexpr const char* warning =
    "These figures prove nothing. Short exercises have few right solutions, and handout and contract "
    "give names and formulas; two honest solutions may be alike. Similarity does not show who took "
    "from whom, nor whether both learned from the same book or were allowed to work together. Read "
    "the code side by side, and talk with the students before you conclude anything. No mark is "
    "changed by this page.";
constexpr const char* method =
    "Similarity is the share of two submissions' own code that occurs in both. Code is compared by its "
    "structure: names, numbers, comments, layout and the order of functions do not matter. What the "
    "stub or the suite's solution has is not counted. Overlap and the longest fragment are counted in "
    "fingerprints; a line of code has about two.";
constexpr const char* scale =
    "What is much? In lab 1, right solutions that were written independently of each other share about "
    "4 %; copies with other names, layout, order and comments share 73 to 100 %. In between, and in "
    "labs whose exercises leave less choice, only the code itself can tell.";

constexpr const char* similarity_style = R"(
.note { margin-top: 1.6rem; }
.pair { margin: .6rem 0; border-top: 1px solid var(--rule); padding-top: .6rem; }
.pair summary { color: var(--ink); font-size: 1rem; overflow-wrap: anywhere; }
.sides { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: .5rem 1rem;
  margin: .8rem 0 1.2rem; }
.sides h3 { margin: 0; font-size: .88rem; overflow-wrap: anywhere; }
.sides pre { margin: .3rem 0 0; padding: .6rem; border-radius: 8px; background: var(--grid);
  color: var(--ink); font: .78rem/1.45 ui-monospace, "DejaVu Sans Mono", monospace;
  white-space: pre-wrap; overflow-wrap: anywhere; }
.sides pre span { display: block; padding-left: 3.2em; text-indent: -3.2em; unicode-bidi: isolate; }
.sides pre i { display: inline-block; width: 2.6em; margin-right: .6em; color: var(--soft);
  text-align: right; text-indent: 0; font-style: normal; user-select: none; }
@media (max-width: 34rem) { .sides { grid-template-columns: minmax(0, 1fr); } }
@media print {
  .sides pre { font-size: 7pt; border: 1px solid var(--rule); }
  .sides pre span { break-inside: avoid; }
}
)";

std::string percent(double share) {
  return fmt::format("{:.0f}\u00a0%", 100 * share);
}

/// "integration.cpp, lines 3 to 9"
std::string place_of(const std::vector<SharedLine>& side) {
  return fmt::format("{}, lines {} to {}", side.front().file, side.front().row, side.back().row);
}

std::string side_html(const std::string& name, const std::vector<SharedLine>& side, bool code) {
  if (side.empty()) return "<div></div>";
  std::string html = fmt::format("<div><h3>{}: {}</h3>", html_escaped(name),
                                 html_escaped(harmless(place_of(side))));
  if (!code) return html + "</div>\n";
  html += "<pre>";
  for (const SharedLine& line : side)
    html += fmt::format("<span><i>{}</i>{}</span>", line.row, html_escaped(harmless(line.text)));
  return html + "</pre></div>\n";
}

std::string pair_html(const SimilarPair& pair, std::size_t number, const Shown& shown, bool code,
                      bool open) {
  const std::string &first = shown.at(pair.first), &second = shown.at(pair.second);
  std::string html = fmt::format("<details class=\"pair\"{}><summary>{}. {} and {}: {}</summary>\n",
                                 open ? " open" : "", number, html_escaped(first),
                                 html_escaped(second), percent(pair.similarity));
  for (const Fragment& fragment : pair.fragments) {
    html += "<div class=\"sides\">" + side_html(first, fragment.left, code) +
            side_html(second, fragment.right, code) + "</div>\n";
    if (fragment.more > 0) html += fmt::format("<p>and {} lines more</p>\n", fragment.more);
  }
  if (pair.fragments.empty()) html += "<p>No fragment of two lines or more.</p>\n";
  return html + "</details>\n";
}

Table pairs_table(const LabSimilarity& lab, const Shown& shown, const std::optional<Usual>& usual) {
  Table table({"pair", "submissions", "similarity", "longest fragment", "overlap", "remark"});
  for (std::size_t i = 0; i < std::min(lab.pairs.size(), most_pairs); ++i) {
    const SimilarPair& pair = lab.pairs[i];
    const bool stands_out = usual && pair.similarity > usual->threshold;
    table.add_row({static_cast<int>(i + 1), shown.at(pair.first) + ", " + shown.at(pair.second),
                   Cell(percent(pair.similarity), pair.similarity), pair.longest, pair.overlap,
                   stands_out ? "stands out" : ""});
  }
  return table;
}

void add_usual(Page& page, const LabSimilarity& lab, const std::optional<Usual>& usual) {
  const std::size_t compared = lab.compared.size(), left_out = lab.left_out.size();
  page.prose(fmt::format("{} {} compared, {} {} not; that makes {}.",
                         counted(static_cast<double>(compared), "submission"),
                         compared == 1 ? "was" : "were", left_out, left_out == 1 ? "was" : "were",
                         counted(static_cast<double>(lab.pairs.size()), "pair")));
  if (!usual) {
    page.prose(
        fmt::format("From fewer than {} pairs nobody can tell what is usual in this class: no "
                    "pair is marked, and no groups are formed.",
                    fewest_pairs));
    return;
  }
  page.prose(fmt::format(
      "In this class half of all pairs share {} or less, and a quarter {} or more. A pair stands out "
      "above {}: the upper quartile ({}) and three times the distance between the quartiles ({} to "
      "{}), but at least {} and at most {}.{}",
      percent(usual->median), percent(usual->upper), percent(usual->threshold),
      percent(usual->upper), percent(usual->lower), percent(usual->upper), percent(least_threshold),
      percent(most_threshold),
      usual->upper > most_threshold
          ? " More than a quarter of all pairs are alike: look at all of them."
          : ""));
}

void add_groups(Page& page, const LabSimilarity& lab, const Shown& shown, double threshold) {
  Table table({"group", "size", "submissions"});
  for (const auto& group : groups_of(lab, threshold)) {
    std::string names;
    for (const std::string& name : group)
      names += (names.empty() ? "" : ", ") + shown.at(name);
    table.add_row(
        {static_cast<int>(table.rows().size() + 1), static_cast<int>(group.size()), names});
  }
  if (table.rows().empty()) {
    page.prose("No pair stands out.");
  } else {
    page.table(table, "Groups: what pairs that stand out connect");
  }
}

void add_lab(Page& page, const LabSimilarity& lab, const Shown& shown, bool code) {
  const std::optional<Usual> usual = usual_of(lab);
  const std::string number = lab.folder.substr(0, 2);
  page.section("Lab " + number);
  add_usual(page, lab, usual);
  if (usual) add_groups(page, lab, shown, usual->threshold);
  if (!lab.pairs.empty()) {
    page.table(pairs_table(lab, shown, usual));
    if (lab.pairs.size() > most_pairs)
      page.prose(
          fmt::format("The other {} pairs are in similarity.csv.", lab.pairs.size() - most_pairs));
    page.section("Lab " + number + " side by side");
    if (!code) page.prose("Only places: code may name its author. Without --no-names it is shown.");
    std::string html;
    for (std::size_t i = 0; i < std::min(lab.pairs.size(), most_pairs); ++i) {
      const bool open = usual && lab.pairs[i].similarity > usual->threshold;
      html += pair_html(lab.pairs[i], i + 1, shown, code, open);
    }
    page.raw_html(html);
  }
  if (lab.left_out.empty()) return;
  page.section("Lab " + number + " not compared");
  Table table({"submission", "why not"});
  for (const auto& [name, why] : lab.left_out)
    table.add_row({shown.at(name), why});
  page.table(table);
}

}  // namespace

Page similarity_page(const std::vector<LabSimilarity>& labs, const Shown& shown, bool code) {
  Page page("What submissions share", fmt::format("{} submissions", shown.size()));
  page.style(similarity_style);
  page.note(warning);
  page.prose(method);
  page.prose(scale);
  for (const LabSimilarity& lab : labs)
    add_lab(page, lab, shown, code);
  page.fact("command", "./carlo grade --similarity");
  page.fact("compared with", "Dolos, https://dolos.ugent.be");
  return page;
}

}  // namespace carlo::grader
