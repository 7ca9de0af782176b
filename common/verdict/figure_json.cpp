#include "verdict/figure_json.h"

#include "cli/error.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>

namespace carlo {

using nlohmann::json;

namespace {

json number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

json numbers(const std::vector<double>& values) {
  auto list = json::array();
  for (const double value : values)
    list.push_back(number(value));
  return list;
}

const char* name(Mark::Role role) {
  if (role == Mark::Role::expected) return "expected";
  return role == Mark::Role::suspect ? "suspect" : "measured";
}

json data_json(const HistogramFigure& h) {
  auto marks = json::array();
  for (const Mark& mark : h.marks)
    marks.push_back({{"at", number(mark.at)}, {"label", mark.label}, {"role", name(mark.role)}});
  return {{"kind", "histogram"},
          {"x_label", h.x_label},
          {"first", number(h.first)},
          {"last", number(h.last)},
          {"measured", numbers(h.measured)},
          {"expected", numbers(h.expected)},
          {"band", numbers(h.band)},
          {"marks", marks}};
}

json data_json(const PointsFigure& p) {
  auto points = json::array();
  for (const PointsFigure::Point& point : p.points) {
    points.push_back({number(point.x), number(point.measured), number(point.half_width),
                      number(point.expected)});
  }
  return {{"kind", "points"}, {"x_label", p.x_label}, {"y_label", p.y_label},
          {"log_x", p.log_x}, {"joined", p.joined},   {"points", points}};
}

json data_json(const GridFigure& g) {
  return {
      {"kind", "grid"},       {"column_label", g.column_label},  {"row_label", g.row_label},
      {"columns", g.columns}, {"measured", numbers(g.measured)}, {"expected", numbers(g.expected)},
      {"sd", numbers(g.sd)}};
}

json data_json(const ListingFigure& l) {
  return {{"kind", "listing"}, {"titles", l.titles}, {"rows", l.rows}};
}

// Reading. Library exceptions become Errors in figure_from_json().

double read_number(const json& value) {
  if (value.is_number()) return value.get<double>();
  if (value == "inf") return HUGE_VAL;
  if (value == "-inf") return -HUGE_VAL;
  if (value == "nan") return std::nan("");
  throw Error("a figure holds {} where a number is expected", value.dump().substr(0, 40));
}

void check_size(const char* what, std::size_t size, std::size_t most) {
  if (size > most) throw Error("a figure has {} {}, at most {} are allowed", size, what, most);
}

std::vector<double> read_numbers(const json& list, const char* what, std::size_t most) {
  if (!list.is_array()) throw Error("a figure's {} are no list", what);
  check_size(what, list.size(), most);
  std::vector<double> values;
  for (const json& value : list)
    values.push_back(read_number(value));
  return values;
}

Mark::Role read_role(const std::string& text) {
  if (text == "measured") return Mark::Role::measured;
  if (text == "expected") return Mark::Role::expected;
  if (text == "suspect") return Mark::Role::suspect;
  throw Error("a mark is \"{}\", expected measured, expected or suspect", text.substr(0, 40));
}

HistogramFigure read_histogram(const json& j) {
  HistogramFigure h;
  h.x_label = j.at("x_label").get<std::string>();
  h.first = read_number(j.at("first"));
  h.last = read_number(j.at("last"));
  h.measured = read_numbers(j.at("measured"), "bins", most_bins);
  h.expected = read_numbers(j.at("expected"), "bins", most_bins);
  h.band = read_numbers(j.at("band"), "bins", most_bins);
  if (!(h.first < h.last) || !std::isfinite(h.last - h.first)) {
    throw Error("a histogram reaches from {} to {}", h.first, h.last);
  }
  const auto agrees = [&](std::size_t size) { return size == 0 || size == h.measured.size(); };
  if (h.measured.empty() || !agrees(h.expected.size()) || !agrees(h.band.size())) {
    throw Error("a histogram has {} bins, {} expected and {} bands", h.measured.size(),
                h.expected.size(), h.band.size());
  }
  check_size("marks", j.at("marks").size(), most_marks);
  for (const json& mark : j.at("marks")) {
    h.marks.push_back({read_number(mark.at("at")), mark.at("label").get<std::string>(),
                       read_role(mark.at("role").get<std::string>())});
  }
  return h;
}

PointsFigure read_points(const json& j) {
  PointsFigure p;
  p.x_label = j.at("x_label").get<std::string>();
  p.y_label = j.at("y_label").get<std::string>();
  p.log_x = j.at("log_x").get<bool>();
  p.joined = j.at("joined").get<bool>();
  check_size("points", j.at("points").size(), most_points);
  for (const json& point : j.at("points")) {
    const std::vector<double> v = read_numbers(point, "numbers in a point", 4);
    if (v.size() != 4) throw Error("a point has {} numbers, expected 4", v.size());
    p.points.push_back({v[0], v[1], v[2], v[3]});
  }
  return p;
}

GridFigure read_grid(const json& j) {
  GridFigure g;
  constexpr std::size_t most = most_cells_a_side * most_cells_a_side;
  g.column_label = j.at("column_label").get<std::string>();
  g.row_label = j.at("row_label").get<std::string>();
  g.columns = j.at("columns").get<std::size_t>();
  g.measured = read_numbers(j.at("measured"), "cells", most);
  g.expected = read_numbers(j.at("expected"), "cells", most);
  g.sd = read_numbers(j.at("sd"), "cells", most);
  const std::size_t cells = g.measured.size();
  if (g.columns == 0 || g.columns > most_cells_a_side || cells == 0 || cells % g.columns != 0 ||
      cells / g.columns > most_cells_a_side || g.expected.size() != cells || g.sd.size() != cells) {
    throw Error("a grid of {} columns has {} cells, {} expected and {} deviations", g.columns,
                cells, g.expected.size(), g.sd.size());
  }
  return g;
}

ListingFigure read_listing(const json& j) {
  ListingFigure l;
  l.titles = j.at("titles").get<std::vector<std::string>>();
  l.rows = j.at("rows").get<std::vector<std::vector<std::string>>>();
  check_size("columns", l.titles.size(), most_columns);
  check_size("rows", l.rows.size(), most_rows);
  for (const auto& row : l.rows) {
    if (row.size() != l.titles.size()) {
      throw Error("a row has {} cells, expected {}", row.size(), l.titles.size());
    }
  }
  return l;
}

}  // namespace

json to_json(const Figure& figure) {
  json result = std::visit([](const auto& data) { return data_json(data); }, figure.data);
  result["title"] = figure.title;
  result["note"] = figure.note;
  return result;
}

Figure figure_from_json(const json& j) {
  try {
    Figure figure{j.at("title").get<std::string>(), j.at("note").get<std::string>(),
                  ListingFigure{}};
    const std::string kind = j.at("kind").get<std::string>();
    if (kind == "histogram") {
      figure.data = read_histogram(j);
    } else if (kind == "points") {
      figure.data = read_points(j);
    } else if (kind == "grid") {
      figure.data = read_grid(j);
    } else if (kind == "listing") {
      figure.data = read_listing(j);
    } else {
      throw Error("there is no figure of kind \"{}\"", kind.substr(0, 40));
    }
    return figure;
  } catch (const json::exception& problem) {
    throw Error("this is no figure: {}", problem.what());
  }
}

}  // namespace carlo
