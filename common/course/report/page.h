#pragma once

#include "course/report/chart.h"
#include "course/report/html.h"
#include "course/report/table.h"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carlo {

/// A page of results: one HTML file that needs nothing else, not even a network. It follows the
/// reader's light or dark scheme and the screen width, works from the keyboard, and has the data of
/// every chart in a table below it. Text is escaped; only raw_html() and script() are taken as they
/// are. The same calls give the same bytes.
class Page {
 public:
  explicit Page(std::string title, std::string subtitle = "");

  /// Starts a section and lists it in the contents.
  void section(std::string_view title);
  /// Adds a paragraph.
  void prose(std::string_view paragraph);
  /// Adds a highlighted paragraph that the reader should not miss.
  void note(std::string_view paragraph);
  void table(const Table& table, std::string_view caption = "");
  void chart(const Chart& chart) { charts({chart}); }
  /// Adds charts, side by side where the screen is wide enough.
  void charts(const std::vector<Chart>& row);
  /// Adds a line to the page's foot: the command, the seed, the machine.
  void fact(std::string name, std::string value);

  /// Adds trusted HTML, CSS and JavaScript for what this class cannot draw. Scripts run at the end
  /// of the page.
  void raw_html(std::string_view html);
  void style(std::string_view rules);
  void script(std::string_view code);
  /// Returns true the first time it is called with this name: for content that several parts of a
  /// page need once.
  bool once(std::string_view name);

  std::string html() const;
  /// Writes html(), creating the folder if it is missing. Throws Error.
  void write(const std::filesystem::path& path) const;

 private:
  void close_section();

  std::string title_, subtitle_;
  std::vector<std::string> sections_;
  std::string body_, styles_;
  std::set<std::string, std::less<>> added_;
  std::vector<std::string> scripts_;
  std::vector<std::pair<std::string, std::string>> facts_;
};

}  // namespace carlo
