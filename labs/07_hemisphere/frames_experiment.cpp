#include "course/report/stopwatch.h"
#include "experiments.h"

#include <algorithm>
#include <cmath>
#include <functional>

// How far frames deviate from right angles and unit lengths, near the normal where they are
// weakest.

namespace lab07 {
namespace {

using Double3 = glm::dvec3;

struct AxesOf {
  Vec3 s, t;
};

/// A cross product with the same helper for every normal: the subject of the experiment, not an
/// example.
const Vec3 helper = glm::normalize(Vec3(1, 2, 3));
AxesOf by_fixed_helper(Vec3 n) {
  const Vec3 s = glm::normalize(glm::cross(n, helper));
  return {s, glm::cross(n, s)};
}

AxesOf by_frame(Vec3 n) {
  const Frame frame(n);
  return {frame.s, frame.t};
}

/// The largest deviation of lengths from 1 and of cosines between axes from 0.
double error_of(const AxesOf& axes, Vec3 normal) {
  const Double3 s(axes.s), t(axes.t), n(normal);
  const double worst =
      std::max({std::abs(glm::length(s) - 1), std::abs(glm::length(t) - 1),
                std::abs(glm::dot(s, t)), std::abs(glm::dot(s, n)), std::abs(glm::dot(t, n))});
  return std::isfinite(glm::length(s) + glm::length(t)) ? worst : 1;
}

/// The largest error for 500 normals at this angle to the direction where the method is weakest.
double worst_error(const std::function<AxesOf(Vec3)>& make, Double3 weakest, double tilt) {
  const Double3 a = glm::normalize(glm::cross(weakest, Double3(0.8, -0.6, 0)));
  const Double3 b = glm::cross(weakest, a);
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    const double phi = 2.399963229728653 * i;
    const Vec3 n(std::sin(tilt) * (std::cos(phi) * a + std::sin(phi) * b) +
                 std::cos(tilt) * weakest);
    worst = std::max(worst, error_of(make(n), n));
  }
  return worst;
}

double seconds_a_frame(const std::function<AxesOf(Vec3)>& make) {
  constexpr int count = 100'000, rounds = 5;
  double best = 1;
  for (int round = 0; round < rounds; ++round) {
    const carlo::Stopwatch watch;
    volatile float sink = 0;
    for (int i = 0; i < count; ++i) {
      const float x = static_cast<float>(i) / count;
      sink = make({x, 0, -std::sqrt(1 - x * x)}).s.x;
    }
    (void)sink;
    const double spent = watch.seconds();
    best = std::min(best, spent / count);
  }
  return best;
}

}  // namespace

void frames_experiment(Notebook& notebook) {
  notebook.begin("Frames");
  notebook.attempt([&] {
    (void)Frame({0, 0, 1});
    carlo::Table table(
        {"angle in rad, to -z or to the helper", "your frame", "one helper for every normal"},
        {"tilt", "yours", "fixed_helper"});
    carlo::Chart chart{"Distance from an orthonormal frame",
                       "the worst of 500 normals at each angle",
                       {"angle to -z, or to the helper, in radians"},
                       {"error of lengths and right angles"},
                       {{"your frame", {}}, {"one helper for every normal", {}}}};
    for (int i = 0; i <= 14; ++i) {
      const double tilt = std::pow(10.0, -i / 2.0);
      const double yours = worst_error(by_frame, {0, 0, -1}, tilt);
      const double fixed = worst_error(by_fixed_helper, glm::normalize(Double3(1, 2, 3)), tilt);
      if (i % 2 == 0) table.add_row({tilt, yours, fixed});
      chart.series[0].points.push_back({tilt, yours});
      chart.series[1].points.push_back({tilt, fixed});
    }
    carlo::Table cost({"frame", "time"}, {"frame", "seconds"});
    cost.add_row({"yours", carlo::seconds_cell(seconds_a_frame(by_frame))});
    cost.add_row({"helper", carlo::seconds_cell(seconds_a_frame(by_fixed_helper))});
    notebook.say(
        "A frame must hold for every normal. Yours near n = -z, where closed formulas break; "
        "beside it axes from a cross product with one helper vector, (1, 2, 3)/|(1, 2, 3)|, for "
        "every normal, near that helper. The closer the normal is to it, the shorter the product "
        "and the fewer of its digits are right.");
    notebook.table("frames", table, "Largest error of a length or a right angle, in float");
    notebook.table("frames_cost", cost, "What a frame costs");
    notebook.charts({chart});
  });
}

}  // namespace lab07
