#include "course/report/page.h"

#include "course/report/web_files.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/format.h>

#include <map>
#include <system_error>

namespace carlo {

namespace {

/// Returns `text` with each {{key}} replaced, in one pass: values are not searched again.
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

}  // namespace

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
  body_ += fmt::format("<p>{}</p>\n", html_typeset(paragraph));
}

void Page::note(std::string_view paragraph) {
  body_ += fmt::format("<p class=\"note\">{}</p>\n", html_typeset(paragraph));
}

void Page::table(const Table& table, std::string_view caption) {
  body_ += table.html(caption);
}

void Page::charts(const std::vector<Chart>& row) {
  body_ += "<div class=\"charts\">\n";
  for (const Chart& chart : row)
    body_ += chart_html(chart);
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
