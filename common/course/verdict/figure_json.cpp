#include "course/verdict/verdict_json.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <cmath>

namespace carlo {
namespace {

/// Rounds a written value to six digits: nobody sees more.
void shorten(const JsonFields& json, double& value) {
  if (json.reading() || !std::isfinite(value)) return;
  value = number_of<double>(fmt::format("{:.6g}", value)).value_or(value);
}

void number(JsonFields& json, const char* name, double& value) {
  shorten(json, value);
  json(name, value);
}

void numbers(JsonFields& json, const char* name, std::vector<double>& values) {
  for (double& value : values)
    shorten(json, value);
  json(name, values);
}

void check_size(const JsonFields& json, const char* what, std::size_t size, std::size_t most) {
  if (size > most)
    json.fail(fmt::format("a figure has {} {}, at most {} are allowed", size, what, most));
}

std::string name_of(Mark::Role role) {
  if (role == Mark::Role::expected) return "expected";
  return role == Mark::Role::suspect ? "suspect" : "measured";
}

Mark::Role role_named(const std::string& text) {
  for (const Mark::Role role : {Mark::Role::measured, Mark::Role::expected, Mark::Role::suspect}) {
    if (name_of(role) == text) return role;
  }
  throw Error("a mark is \"{}\", expected measured, expected or suspect", text.substr(0, 40));
}

}  // namespace

static void fields(JsonFields& json, Mark& mark) {
  number(json, "at", mark.at);
  json("label", mark.label);
  json.named("role", mark.role, name_of, role_named);
}

static void fields(JsonFields& json, PointsFigure::Point& point) {
  number(json, "x", point.x);
  number(json, "measured", point.measured);
  number(json, "half_width", point.half_width);
  number(json, "expected", point.expected);
}

static void fields(JsonFields& json, HistogramFigure& h) {
  json("x_label", h.x_label);
  number(json, "first", h.first);
  number(json, "last", h.last);
  numbers(json, "measured", h.measured);
  numbers(json, "expected", h.expected);
  numbers(json, "band", h.band);
  json("marks", h.marks);
  if (!json.reading()) return;
  for (const std::size_t size : {h.measured.size(), h.expected.size(), h.band.size()})
    check_size(json, "bins", size, most_bins);
  check_size(json, "marks", h.marks.size(), most_marks);
  if (!(h.first < h.last) || !std::isfinite(h.last - h.first)) {
    json.fail(fmt::format("a histogram reaches from {} to {}", h.first, h.last));
  }
  const auto agrees = [&](std::size_t size) { return size == 0 || size == h.measured.size(); };
  if (h.measured.empty() || !agrees(h.expected.size()) || !agrees(h.band.size())) {
    json.fail(fmt::format("a histogram has {} bins, {} expected and {} bands", h.measured.size(),
                          h.expected.size(), h.band.size()));
  }
}

static void fields(JsonFields& json, PointsFigure& p) {
  json("x_label", p.x_label);
  json("y_label", p.y_label);
  json("log_x", p.log_x);
  json("joined", p.joined);
  json("points", p.points);
  if (json.reading()) check_size(json, "points", p.points.size(), most_points);
}

static void fields(JsonFields& json, GridFigure& g) {
  json("column_label", g.column_label);
  json("row_label", g.row_label);
  json("columns", g.columns);
  numbers(json, "measured", g.measured);
  numbers(json, "expected", g.expected);
  numbers(json, "sd", g.sd);
  const std::size_t cells = g.measured.size();
  if (json.reading() && (g.columns == 0 || g.columns > most_cells_a_side || cells == 0 ||
                         cells % g.columns != 0 || cells / g.columns > most_cells_a_side ||
                         g.expected.size() != cells || g.sd.size() != cells)) {
    json.fail(fmt::format("a grid of {} columns has {} cells, {} expected and {} deviations",
                          g.columns, cells, g.expected.size(), g.sd.size()));
  }
}

/// The cells of all rows form one list.
static void fields(JsonFields& json, ListingFigure& l) {
  std::vector<std::string> cells;
  for (const std::vector<std::string>& row : l.rows)
    cells.insert(cells.end(), row.begin(), row.end());
  json("titles", l.titles);
  json("cells", cells);
  if (!json.reading()) return;
  const std::size_t columns = l.titles.size();
  check_size(json, "columns", columns, most_columns);
  if (columns == 0 || cells.size() % columns != 0) {
    json.fail(fmt::format("a listing of {} columns has {} cells", columns, cells.size()));
  }
  check_size(json, "rows", cells.size() / columns, most_rows);
  for (auto row = cells.begin(); row != cells.end(); row += static_cast<std::ptrdiff_t>(columns))
    l.rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(columns));
}

namespace {

constexpr const char* kinds[] = {"histogram", "points", "grid", "listing"};

/// Returns an empty figure of the kind, to read into.
decltype(Figure::data) empty_figure(const std::string& kind) {
  if (kind == kinds[0]) return HistogramFigure{};
  if (kind == kinds[1]) return PointsFigure{};
  if (kind == kinds[2]) return GridFigure{};
  if (kind == kinds[3]) return ListingFigure{};
  throw Error("there is no figure of kind \"{}\"", kind.substr(0, 40));
}

}  // namespace

void fields(JsonFields& json, Figure& figure) {
  std::string kind = kinds[figure.data.index()];
  json("kind", kind);
  json("title", figure.title);
  json("note", figure.note);
  if (json.reading()) figure.data = empty_figure(kind);
  std::visit([&](auto& data) { fields(json, data); }, figure.data);
}

}  // namespace carlo
