#include "report/page.h"

#include "cli/atomic_file.h"
#include "cli/error.h"
#include "report/format.h"
#include "report/web_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <system_error>

namespace carlo {

using nlohmann::json;

namespace {

std::string_view name(Scale scale) {
  return scale == Scale::log ? "log" : "linear";
}

std::string_view name(Unit unit) {
  switch (unit) {
    case Unit::count:
      return "count";
    case Unit::seconds:
      return "seconds";
    case Unit::number:
      break;
  }
  return "number";
}

json axis_json(const Axis& axis) {
  return {{"label", axis.label}, {"unit", name(axis.unit)}, {"scale", name(axis.scale)}};
}

/// The fitted line at places from the first point's x to the last one's: x, y, band factor.
json fit_json(const Series& series) {
  const auto [first, last] =
      std::minmax_element(series.points.begin(), series.points.end(),
                          [](const Point& a, const Point& b) { return a.x < b.x; });
  auto line = json::array();
  constexpr int steps = 24;
  for (int i = 0; i <= steps; ++i) {
    const double x = first->x * std::pow(last->x / first->x, static_cast<double>(i) / steps);
    line.push_back({x, series.fit->at(x), series.fit->band_factor(x)});
  }
  return line;
}

std::string slope_text(const PowerFit& fit) {
  return interval_text(fit.slope, fit.slope_half_width);
}

json series_json(const Series& series) {
  auto points = json::array();
  for (const Point& p : series.points)
    points.push_back({p.x, p.y});
  json result = {{"name", series.name}, {"points", points}, {"joined", true}};
  if (series.fit && !series.points.empty()) {
    result["fit"] = fit_json(series);
    result["slope"] = slope_text(*series.fit);
  }
  return result;
}

std::string cell_text(const Axis& axis, double value) {
  switch (axis.unit) {
    case Unit::count:
      return number_text(value, 7);
    case Unit::seconds:
      return duration_text(value);
    case Unit::number:
      break;
  }
  return number_text(value);
}

std::string table_html(const Table& table, std::string_view caption) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Table\">"
      "<table>\n";
  if (!caption.empty()) {
    html += fmt::format("<caption><span>{}</span></caption>\n", html_escaped(caption));
  }
  const auto row = [&](std::string_view tag, const auto& text_of) {
    html += "<tr>";
    for (std::size_t c = 0; c < table.titles().size(); ++c) {
      html += fmt::format("<{}{}>{}</{}>", tag, table.numeric(c) ? " class=\"number\"" : "",
                          html_escaped(text_of(c)), tag.substr(0, 2));
    }
    html += "</tr>\n";
  };
  html += "<thead>";
  row("th", [&](std::size_t c) { return table.titles()[c]; });
  html += "</thead>\n<tbody>\n";
  for (const auto& cells : table.rows()) {
    row("td", [&](std::size_t c) { return cells[c].text; });
  }
  return html + "</tbody></table></div>\n";
}

/// The chart in words and numbers, for whoever does not see it.
std::string data_html(const Chart& chart) {
  Table table({"series", chart.x.label, chart.y.label});
  for (const Series& series : chart.series) {
    for (const Point& p : series.points) {
      table.add_row(
          {series.name, Cell(cell_text(chart.x, p.x), p.x), Cell(cell_text(chart.y, p.y), p.y)});
    }
  }
  return "<details><summary>The numbers</summary>" + table_html(table, "") + "</details>\n";
}

std::string chart_label(const Chart& chart) {
  std::string label =
      fmt::format("Chart: {}. {} against {}.", chart.title, chart.y.label, chart.x.label);
  for (const Series& series : chart.series) {
    label += fmt::format(" {}: {} points", series.name, series.points.size());
    if (series.fit) label += ", slope " + slope_text(*series.fit);
    label += '.';
  }
  return label + " Arrow keys walk along the points; all numbers are in the table below.";
}

/// `text` with each {{key}} replaced, in one pass: values are not searched again.
std::string filled(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string result;
  while (true) {
    const std::size_t open = text.find("{{");
    result += text.substr(0, open);
    if (open == std::string_view::npos) return result;
    const std::size_t close = text.find("}}", open);
    result += values.at(std::string(text.substr(open + 2, close - open - 2)));
    text.remove_prefix(close + 2);
  }
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string script_escaped(std::string_view code) {
  // Inside a JavaScript string or regular expression the backslash changes nothing.
  std::string result(code);
  replace_all(result, "<!--", "<\\!--");
  constexpr std::string_view end_tag = "</script";
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  auto at = result.begin();
  while ((at = std::search(at, result.end(), end_tag.begin(), end_tag.end(), same)) !=
         result.end()) {
    at = result.insert(at + 1, '\\');
  }
  return result;
}

std::string json_for_html(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  replace_all(text, "<", "\\u003c");
  return text;
}

Page::Page(std::string title, std::string subtitle)
    : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

void Page::close_section() {
  if (!sections_.empty()) body_ += "</section>\n";
}

void Page::section(std::string_view title) {
  close_section();
  sections_.emplace_back(title);
  body_ += fmt::format("<section id=\"section-{}\">\n<h2>{}</h2>\n", sections_.size(),
                       html_escaped(title));
}

void Page::prose(std::string_view paragraph) {
  body_ += fmt::format("<p>{}</p>\n", html_escaped(paragraph));
}

void Page::note(std::string_view paragraph) {
  body_ += fmt::format("<p class=\"note\">{}</p>\n", html_escaped(paragraph));
}

void Page::table(const Table& table, std::string_view caption) {
  body_ += table_html(table, caption);
}

void Page::charts(const std::vector<Chart>& row) {
  body_ += "<div class=\"charts\">\n";
  for (const Chart& chart : row) {
    const std::string id = fmt::format("chart-{}", charts_.size() + 1);
    const std::string note =
        chart.note.empty() ? "" : fmt::format("<span>{}</span>", html_escaped(chart.note));
    body_ += fmt::format(
        "<figure id=\"{}\"><figcaption>{}{}</figcaption>\n"
        "<div class=\"legend\"></div>\n"
        "<div class=\"plot\"><canvas role=\"img\" tabindex=\"0\" "
        "aria-label=\"{}\"></canvas></div>\n"
        "<div class=\"sr-only\" aria-live=\"polite\"></div>\n{}</figure>\n",
        id, html_escaped(chart.title), note, html_escaped(chart_label(chart)), data_html(chart));
    auto series = json::array();
    for (const Series& s : chart.series)
      series.push_back(series_json(s));
    charts_.push_back(json_for_html(
        {{"id", id}, {"x", axis_json(chart.x)}, {"y", axis_json(chart.y)}, {"series", series}}));
  }
  body_ += "</div>\n";
}

void Page::fact(std::string name, std::string value) {
  facts_.emplace_back(std::move(name), std::move(value));
}

void Page::raw_html(std::string_view html) {
  body_ += html;
}

void Page::style(std::string_view rules) {
  styles_ += rules;
}

bool Page::once(std::string_view name) {
  return added_.emplace(name).second;
}

void Page::script(std::string_view code) {
  scripts_.emplace_back(code);
}

std::string Page::html() const {
  std::string contents;
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    contents +=
        fmt::format("<li><a href=\"#section-{}\">{}</a></li>\n", i + 1, html_escaped(sections_[i]));
  }
  if (!contents.empty()) {
    contents = "<nav aria-label=\"Contents\"><ol>\n" + contents + "</ol></nav>";
  }
  std::string facts;
  for (const auto& [key, value] : facts_) {
    facts += fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_escaped(key), html_escaped(value));
  }
  if (!facts.empty()) facts = "<dl>\n" + facts + "</dl>";

  std::string scripts;
  const auto add_script = [&](std::string_view code) {
    scripts += fmt::format("<script>\n{}\n</script>\n", script_escaped(code));
  };
  if (!charts_.empty()) {
    scripts += fmt::format("<script type=\"application/json\" id=\"charts\">[{}]</script>\n",
                           fmt::join(charts_, ","));
    add_script(web::chart_library_js());
    add_script(web::charts_js());
  }
  for (const std::string& code : scripts_)
    add_script(code);

  return filled(web::page_html(), {{"title", html_escaped(title_)},
                                   {"subtitle", html_escaped(subtitle_)},
                                   {"css", std::string(web::page_css()) + styles_},
                                   {"contents", contents},
                                   {"body", sections_.empty() ? body_ : body_ + "</section>\n"},
                                   {"facts", facts},
                                   {"scripts", scripts}});
}

void Page::write(const std::filesystem::path& path) const {
  std::error_code failed;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failed);
  if (failed) {
    throw Error("cannot make the folder {}: {}", path.parent_path().string(), failed.message());
  }
  write_file(path, html());
}

}  // namespace carlo
