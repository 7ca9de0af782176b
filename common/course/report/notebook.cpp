#include "course/report/notebook.h"

#include "course/cli/wrap.h"
#include "course/report/signals.h"
#include "support/terminal.h"

#include <fmt/core.h>

#include <cstdio>
#include <utility>

namespace carlo {

Notebook::Notebook(std::string label, const LabOptions& options, Page& page)
    : options_(options), page_(page), bar_(std::move(label), true) {}

void Notebook::begin(std::string_view title) {
  bar_.clear();
  note_experiment(title);
  fmt::print("\n{}\n\n", coloured(Colour::bold, title));
  page_.section(title);
  left_out_here_.clear();
}

void Notebook::say(std::string_view paragraph) {
  bar_.clear();
  constexpr int readable = 88;
  fmt::print("{}\n\n", wrapped(std::string(paragraph), readable));
  page_.prose(paragraph);
}

void Notebook::table(const std::string& key, const Table& table, std::string_view caption) {
  if (table.rows().empty()) return;
  print_table(key, table, caption);
  page_.table(table, caption);
}

void Notebook::table(const std::string& key, const Table& table, std::string_view caption,
                     std::string_view html) {
  print_table(key, table, caption);
  page_.raw_html(html);
}

void Notebook::numbers(const std::string& key, const Table& table, std::string_view caption) {
  fold(table, caption);
  print_table(key, table, caption);
}

void Notebook::data(const std::string& key, const Table& table, std::string_view caption) {
  fold(table, caption);
  results_.tables.insert_or_assign(key, table);
}

void Notebook::fold(const Table& table, std::string_view caption) {
  page_.raw_html(fmt::format("<details><summary>{}</summary>", html_typeset(caption)));
  page_.table(table);
  page_.raw_html("</details>");
}

void Notebook::print_table(const std::string& key, const Table& table, std::string_view caption) {
  bar_.clear();
  fmt::print("{}:\n{}\n", wrapped(std::string(caption)), table.text());
  (void)std::fflush(stdout);
  results_.tables.insert_or_assign(key, table);
}

void Notebook::leave_out(const NotImplemented& missing) {
  left_out_.insert(missing.tag());
  if (!left_out_here_.insert(missing.tag()).second) return;
  const std::string reason = missing.what();
  warn(reason);
}

void Notebook::warn(const std::string& text) {
  bar_.clear();
  fmt::print("{}\n\n", wrapped(coloured(Colour::yellow, text)));
  page_.note(text);
}

void Notebook::set_experiment(int index, double from, double to) {
  from_ = from;
  to_ = to;
  // An experiment's random numbers do not depend on which others were run before it, nor on which
  // exercises those found done.
  next_stream_ = static_cast<std::uint64_t>(index) << 32;
  progress(0, 1);
}

void Notebook::progress(double done, double total) {
  bar_.update(from_ + (to_ - from_) * done / total);
}

}  // namespace carlo
