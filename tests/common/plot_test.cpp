#include "course/report/plot.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using carlo::Axis;
using carlo::Plot;
using carlo::Scale;
using carlo::Stretch;
using carlo::Unit;

namespace {

const Axis linear{"x", Unit::number, Scale::linear}, logarithmic{"x"};
const Axis degrees{"angle", Unit::degrees, Scale::linear};

Stretch around(const Axis& axis, const std::vector<double>& values) {
  return carlo::round_stretch(axis, values);
}

/// The labels along the x axis of an empty plot, powers as "10^-9".
std::vector<std::string> ticks(const Axis& axis, Stretch across) {
  const std::string svg = Plot(axis, across, {"", Unit::number, Scale::linear}, {0, 1}).svg("");
  std::vector<std::string> words;
  const std::string open = "text-anchor=\"middle\">";
  for (std::size_t at = 0; (at = svg.find(open, at)) != std::string::npos; ++at) {
    const std::size_t from = at + open.size();
    std::string word = svg.substr(from, svg.find("</text>", from) - from);
    const std::size_t power = word.find("<tspan");
    if (power != std::string::npos) {
      word.replace(power, word.find('>') + 1 - power, "^");
      word.resize(word.find('<'));
    }
    words.push_back(word);
  }
  words.pop_back();  // the axis's label
  return words;
}

bool is(Stretch on, double first, double last) {
  return std::abs(on.first - first) <= 1e-9 * std::abs(last) &&
         std::abs(on.last - last) <= 1e-9 * std::abs(last);
}

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("Axes go from round numbers to round numbers around what they show", "[plot]") {
  CHECK(is(around(linear, {0.03, 0.48}), 0, 0.5));
  CHECK(is(around(linear, {-3, 17}), -5, 20));
  CHECK(is(around(linear, {2, 2}), 1.8, 2.2));
  CHECK(is(around(linear, {0, 0}), -1, 1));
  CHECK(is(around(logarithmic, {16, 16384}), 10, 1e5));
  CHECK(is(around(logarithmic, {0.0039, 0.12}), 0.002, 0.2));
  CHECK(is(around(logarithmic, {1, 1e6}), 1, 1e6));
  CHECK(is(around(logarithmic, {5, 5}), 2.5, 10));
  CHECK(is(around(logarithmic, {-1, 0, 3, 20, std::nan("")}), 2, 20));
  CHECK(is(around(logarithmic, {}), 0.1, 1));
  CHECK(is(around(linear, {std::nan(""), HUGE_VAL}), 0, 1));
  CHECK(std::isfinite(around(linear, {-1e308, 1e308}).last));
}

TEST_CASE("An axis of angles ends at 0 and 90", "[plot]") {
  CHECK(is(around(degrees, {1, 89}), 0, 90));
  CHECK(is(around(degrees, {0, 90}), 0, 90));
  CHECK(ticks(degrees, {0, 90}) == Words{"0", "15", "30", "45", "60", "75", "90"});
}

TEST_CASE("Numbers stand at both ends of an axis where they are round", "[plot]") {
  CHECK(ticks(linear, {0, 0.5}) == Words{"0", "0.1", "0.2", "0.3", "0.4", "0.5"});
  CHECK(ticks(linear, {-1, 1}) == Words{"−1", "−0.5", "0", "0.5", "1"});
  CHECK(ticks(linear, {0, 3e6}) ==
        Words{"0", "500000", "10^6", "1.5·10^6", "2·10^6", "2.5·10^6", "3·10^6"});
  CHECK(ticks(logarithmic, {1e-9, 1}) == Words{"10^−9", "10^−6", "10^−3", "1"});
  CHECK(ticks(logarithmic, {1e-11, 1}) ==
        Words{"10^−11", "10^−9", "10^−7", "10^−5", "10^−3", "0.1"});
  CHECK(ticks(logarithmic, {10, 1e5}) == Words{"10", "100", "1000", "10^4", "10^5"});
  CHECK(ticks(logarithmic, {2, 20}) == Words{"2", "5", "10", "20"});
  CHECK(ticks({"t", Unit::seconds}, {1e-7, 1e-4}) == Words{"100 ns", "1 µs", "10 µs", "100 µs"});
  CHECK(ticks(linear, {0, 3.14159}) == Words{"0", "0.5", "1", "1.5", "2", "2.5", "3"});
}

TEST_CASE("Tags take no room in a text", "[plot]") {
  CHECK(carlo::text_width("10<tspan dy=\"-4\">−9</tspan>") == carlo::text_width("10−9"));
}

TEST_CASE("What an axis cannot show is left out, and any ends are lived with", "[plot]") {
  Plot plot(logarithmic, {1, 100}, linear, {0, 1});
  const std::vector<carlo::Point> points{{1, 0}, {10, std::nan("")}, {0, 1}, {100, 1}, {50, 1e300}};
  plot.line("c1", points);
  for (const carlo::Point& p : points)
    plot.mark("c1", 0, p, "");
  plot.bar("c1", 1, 2, std::nan(""));
  plot.error_bar("c1", points[0], HUGE_VAL);
  const std::string svg = plot.svg("a < b");
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
  CHECK(svg.find("aria-label=\"a &lt; b\"") != std::string::npos);
  constexpr double most = std::numeric_limits<double>::max();
  for (const Stretch on : {Stretch{1e20, 1e20 + 32768}, {-most, most}, {0, 5e-324}, {1, 1}})
    CHECK(ticks(linear, on).size() < 20);
}
