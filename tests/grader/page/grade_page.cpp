#include "grader/page/grade_page.h"

#include "grader/page/exercise.h"
#include "grader/page/style.h"
#include "grader/page/text.h"
#include "report/format.h"
#include "report/page.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace carlo::grader {

using nlohmann::json;

namespace {

std::string lab_name(const json& lab) {
  const std::string number = number_in(lab, "lab"), title = text_in(lab, "title");
  const std::string name = fmt::format("Lab {}{}", number.size() == 1 ? "0" : "", number);
  return title.empty() ? name : name + ": " + title;
}

double sum_of(const json& list, const char* key) {
  double sum = 0;
  for (const json& entry : list) {
    const auto found = entry.find(key);
    if (found != entry.end() && found->is_number()) sum += found->get<double>();
  }
  return sum;
}

/// A lab's verdict, out of the record that it may stand in; with its points, if nobody added them.
json verdict_of(const json& entry) {
  json lab = entry;
  const auto verdict = entry.find("verdict");
  if (verdict != entry.end() && verdict->is_object()) {
    lab = *verdict;
    if (!lab.contains("lab")) lab["lab"] = entry.value("lab", json());
  }
  for (const char* key : {"note", "compiler"}) {
    if (entry.contains(key)) lab[key] = entry[key];
  }
  for (const char* key : {"points", "max"}) {
    if (!lab.contains(key)) lab[key] = sum_of(list_in(lab, "exercises"), key);
  }
  return lab;
}

/// What stands in place of exercises that were not judged.
std::string problem_html(const json& lab) {
  std::string out;
  const std::string note = text_in(lab, "note"), compiler = text_in(lab, "compiler");
  if (!note.empty()) out += fmt::format("<p class=\"note\">{}</p>\n", html(note));
  if (!compiler.empty()) out += fmt::format("<pre>{}</pre>\n", html(compiler));
  return out;
}

std::string lab_html(const json& lab) {
  const std::string number = number_in(lab, "lab");
  std::string overview, details;
  for (const json& exercise : list_in(lab, "exercises")) {
    if (!exercise.is_object()) continue;
    overview += overview_row(exercise, number);
    details += exercise_html(exercise, number);
  }
  std::string out = problem_html(lab);
  if (!overview.empty()) {
    out += "<div class=\"scroll\"><table class=\"overview\"><tbody>\n" + overview +
           "</tbody></table></div>\n";
  }
  const auto whole = lab.find("whole");
  if (whole != lab.end() && *whole == false) {
    out += "<p class=\"soft\">Only a part of the lab's exercises was judged.</p>\n";
  }
  return out + details;
}

/// A list of objects, in valid UTF-8, whatever came.
json cleaned(const json& labs) {
  const json clean = json::parse(labs.dump(-1, ' ', false, json::error_handler_t::replace));
  json list = json::array();
  if (clean.is_object()) list.push_back(verdict_of(clean));
  if (!clean.is_array()) return list;
  for (const json& lab : clean) {
    if (lab.is_object()) list.push_back(verdict_of(lab));
  }
  return list;
}

/// Printable, valid UTF-8.
std::string cleaned(const std::string& text) {
  return json::parse(json(printable(text)).dump(-1, ' ', false, json::error_handler_t::replace))
      .get<std::string>();
}

}  // namespace

std::string grade_page(const json& labs, const PageWords& words) {
  const json list = cleaned(labs);
  std::string subtitle = cleaned(words.subtitle);
  if (subtitle.empty()) {
    subtitle = fmt::format("{} of {} points", number_text(sum_of(list, "points"), 6),
                           number_text(sum_of(list, "max"), 6));
  }
  Page page(cleaned(words.title), subtitle);
  page.raw_html(page_style());
  if (list.size() == 1) {
    page.raw_html(lab_html(list[0]));
  } else {
    for (const json& lab : list) {
      page.section(printable(fmt::format("{} – {} of {} points", lab_name(lab),
                                         number_in(lab, "points"), number_in(lab, "max"))));
      page.raw_html(lab_html(lab));
    }
  }
  for (const auto& [name, value] : words.facts)
    page.fact(cleaned(name), cleaned(value));
  return page.html();
}

bool something_failed(const json& lab) {
  const json& exercises = list_in(lab, "exercises");
  return std::any_of(exercises.begin(), exercises.end(), [](const json& exercise) {
    const std::string status = text_in(exercise, "status");
    return status != "passed" && status != "not_implemented";
  });
}

}  // namespace carlo::grader
