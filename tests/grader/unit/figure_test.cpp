#include "course/verdict/verdict_json.h"
#include "grader/judge/compare.h"
#include "grader/judge/figures.h"
#include "random/rng.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace carlo;
using namespace carlo::grader;
using nlohmann::json;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> uniform_values(std::size_t count, double shift = 0) {
  carlo::Rng rng(21);
  std::vector<double> values(count);
  for (double& value : values)
    value = rng.uniform() + shift;
  return values;
}

json to_json(const Figure& figure) {
  return json::parse(json_text(figure));
}

Figure figure_from(const json& document) {
  return from_json_text<Figure>(document.dump(), "a figure");
}

json round_trip(const Figure& figure) {
  return to_json(figure_from(to_json(figure)));
}

const auto all_wrong = [](std::size_t) { return true; };

std::string name_of_place(std::size_t i) {
  return "place " + std::to_string(i);
}

template <class Data>
Data data(const Figure& figure) {
  return std::get<Data>(figure.data);
}

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum;
}

}  // namespace

TEST_CASE("every kind of figure survives JSON, numbers that are none included", "[figure]") {
  HistogramFigure histogram{"x", -1, 2, {1, 2.5, 3}, {2, 2, 2}, {0.5, 0.5, 0.5}, {}};
  histogram.marks = {{nan_value, "a", Mark::Role::measured},
                     {1, "b", Mark::Role::expected},
                     {-infinity, "c", Mark::Role::suspect}};
  PointsFigure points{"n", "y", true, false, {{1, nan_value, infinity, 3}, {2, 1, 0, nan_value}}};
  const GridFigure grid{"column", "row", 2, {1, nan_value, 3, 4}, {1, 2, 3, 4}, {1, 1, 0, 1}};
  const ListingFigure listing{{"a", "b"}, {{"\"</script>", "\xFF"}, {"", "–"}}};
  for (const Figure& figure : {Figure{"title", "note", histogram}, Figure{"title", "", points},
                               Figure{"", "note", grid}, Figure{"t", "n", listing}}) {
    CHECK(round_trip(figure) == to_json(figure));
  }
  const Figure back = figure_from(to_json({"", "", points}));
  CHECK(std::isnan(data<PointsFigure>(back).points[0].measured));
  CHECK(data<PointsFigure>(back).points[0].half_width == infinity);
  CHECK(data<PointsFigure>(back).log_x);
}

TEST_CASE("what is no figure, or too large a one, is refused", "[figure]") {
  const json good = to_json({"", "", HistogramFigure{"x", 0, 1, {1, 2}, {}, {}, {}}});
  CHECK_NOTHROW(figure_from(good));
  const auto with = [&](const char* key, const json& value) {
    json changed = good;
    changed[key] = value;
    return changed;
  };
  for (const json& bad :
       {json(), json(3), json::object(), json::array(), with("kind", "pie"), with("title", 3),
        with("measured", "many"), with("measured", json::array()), with("measured", {1, "x"}),
        with("measured", std::vector<double>(most_bins + 1, 1.0)), with("expected", {1, 2, 3}),
        with("first", 1), with("last", "inf"), with("marks", {1, 2}),
        with("marks", {{{"at", 1}, {"label", "a"}, {"role", "king"}}})}) {
    INFO(bad.dump());
    CHECK_THROWS_AS(figure_from(bad), carlo::Error);
  }
  json grid = to_json({"", "", GridFigure{"", "", 2, {1, 2, 3, 4}, {1, 2, 3, 4}, {1, 1, 1, 1}}});
  grid["columns"] = 3;
  CHECK_THROWS_AS(figure_from(grid), carlo::Error);
  grid["columns"] = 0;
  CHECK_THROWS_AS(figure_from(grid), carlo::Error);
  json listing = to_json({"", "", ListingFigure{{"a"}, {{"1"}}}});
  listing["cells"] = {"1", "2", "3", "4"};
  CHECK_NOTHROW(figure_from(listing));
  listing["titles"] = {"a", "b", "c"};
  CHECK_THROWS_AS(figure_from(listing), carlo::Error);
}

TEST_CASE("makers keep to the sizes that readers allow, whatever they are given", "[figure]") {
  const std::vector<double> many = uniform_values(100'000);
  std::vector<double> ugly = many;
  ugly[3] = nan_value;
  ugly[5] = infinity;
  ugly[7] = -1e308;
  ugly[9] = 1e308;
  const std::vector<double> cells(10'000, 3.0), one{2.0}, none(3, nan_value);
  std::vector<Figure> figures;
  using List = std::initializer_list<const std::vector<double>*>;
  for (const std::vector<double>* values : List{&many, &ugly, &one, &none}) {
    figures.push_back(mean_figure(*values, 0.5, 0.3));
    figures.push_back(mean_figure(*values, 7, 0));
    figures.push_back(mean_figure(*values, nan_value, infinity));
    figures.push_back(spread_figure(*values, 0.5, 0.3));
    figures.push_back(curve_figure("x", *values, *values, *values, all_wrong));
    figures.push_back(
        curve_figure("x", *values, *values, std::vector<double>(values->size(), 0.0), all_wrong));
    figures.push_back(differences_listing("at", name_of_place, *values, *values, all_wrong));
  }
  figures.push_back(uniform_figure(std::vector{-1e300, 0.5, 1e300}, 0, 1));
  figures.push_back(counts_figure({}, cells, cells));
  figures.push_back(counts_figure({"x", 0, 1}, one, one));
  figures.push_back(cells_figure("c", "r", 100, cells, cells));
  figures.push_back(cells_figure("c", "r", 10'000, cells, cells));
  figures.push_back(tiles_figure(100, cells, cells, cells));
  for (const Figure& figure : figures) {
    INFO(figure.title);
    CHECK_NOTHROW(round_trip(figure));
  }
}

TEST_CASE("neighbours that are added up keep their sums and the axis its ends", "[figure]") {
  std::vector<double> counts(150);
  for (std::size_t i = 0; i < counts.size(); ++i)
    counts[i] = static_cast<double>(i);
  const Figure figure = counts_figure({"x", 10, 160}, counts, counts);
  const auto h = data<HistogramFigure>(figure);
  REQUIRE(h.measured.size() == 50);
  CHECK(h.measured[1] == 3 + 4 + 5);
  CHECK(total(h.measured) == total(counts));
  CHECK(std::abs(h.last - 160) <= 1e-12);
  const Figure cells = cells_figure("", "", 50, counts, counts);
  CHECK(data<GridFigure>(cells).columns == 25);
  CHECK(data<GridFigure>(cells).measured[1] == 2 + 3);
  CHECK(total(data<GridFigure>(cells).measured) == total(counts));
  // Five cells three by three: the last bin is half empty, but as wide as the others.
  const std::vector<double> five(65 * 2 - 1, 1.0);
  const Figure odd = counts_figure({"x", 0, 129}, five, five);
  CHECK(data<HistogramFigure>(odd).measured.size() == 43);
  CHECK(std::abs(data<HistogramFigure>(odd).last - 129) <= 1e-12);
}

TEST_CASE("a mean far off is shown in a histogram, a small bias against n", "[figure]") {
  const std::vector<double> values = uniform_values(40'000);
  const double sd = std::sqrt(1.0 / 12);
  const Figure far = mean_figure(values, 0.8, sd);
  CHECK(data<HistogramFigure>(far).marks.size() == 2);
  CHECK(total(data<HistogramFigure>(far).measured) >= 0.98 * 40'000);
  const Figure near = mean_figure(values, 0.51, sd);
  const auto points = data<PointsFigure>(near).points;
  REQUIRE(points.size() > 5);
  CHECK(points.back().x == 40'000);
  CHECK(std::abs(points.back().half_width - 3 * sd / 200) <= 1e-12);
  const std::vector<double> coins(1000, 1.0);  // two values at most make no useful histogram
  CHECK(std::holds_alternative<PointsFigure>(mean_figure(coins, 0.5, 0.5).data));
}

TEST_CASE("one ratio for all that differ is told, pi by its name", "[figure]") {
  const std::vector<double> expected{1, 2, 3, 4}, mixed{1, 4, 3, 4};
  std::vector<double> measured;
  for (const double value : expected)
    measured.push_back(value * std::acos(-1.0));
  const auto differ = [&](const std::vector<double>& values) {
    return differences_listing("at", name_of_place, values, expected,
                               [&](std::size_t i) { return values[i] != expected[i]; });
  };
  CHECK(differ(measured).note == "4 of 4 differ, and each is 3.1416 (pi) times what is expected.");
  CHECK(differ(mixed).note == "1 of 4 differ.");
  const auto rows = data<ListingFigure>(differ(mixed)).rows;
  REQUIRE(rows.size() == 1);
  CHECK(rows[0] == std::vector<std::string>{"place 1", "4", "2", "2"});
}

TEST_CASE("a curve is drawn where the eye sees the difference, else the values are listed",
          "[figure]") {
  std::vector<double> at, right, near, far;
  for (int i = 0; i <= 400; ++i) {
    at.push_back(i / 400.0);
    right.push_back(at.back() * at.back());
    near.push_back(right.back() + 1e-9);
    far.push_back(at.back());
  }
  const Figure curve = curve_figure("x", at, far, right, all_wrong);
  REQUIRE(std::holds_alternative<PointsFigure>(curve.data));
  CHECK(data<PointsFigure>(curve).points.size() >= 64);
  CHECK(std::holds_alternative<ListingFigure>(curve_figure("x", at, near, right, all_wrong).data));
}

TEST_CASE("comparisons that fail bring their figures, those that pass bring none", "[compare]") {
  const std::vector<double> values = uniform_values(5000), shifted = uniform_values(5000, 0.2);
  const Theory theory{0.5, std::sqrt(1.0 / 12), -1.2}, wide{0.5, 1, 0};
  CHECK_FALSE(mean_is("", values, theory).figure);
  CHECK(mean_is("", shifted, theory).figure);
  CHECK_FALSE(variance_is("", values, theory).figure);
  CHECK(variance_is("", values, wide).figure);
  CHECK_FALSE(uniform_on("", values, 0, 1).figure);
  CHECK(uniform_on("", shifted, 0, 1).figure);
  CHECK_FALSE(all_equal("", values, values, 0).figure);
  CHECK(all_equal("", values, shifted, 0).figure);
  CHECK_FALSE(equals("", 1, 2, 0).figure);
}
