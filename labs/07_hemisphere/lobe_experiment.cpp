#include "course/report/stopwatch.h"
#include "experiments.h"
#include "numeric/robust.h"

#include <cmath>
#include <functional>
#include <set>

// Lobes as they become narrow: the lecture's recipe to the letter in float, and yours.

namespace lab07 {
namespace {

using Sample = std::function<Vec3(Vec2 u, float n)>;

/// The recipe as printed. The subject of the experiment, not an example.
Vec3 by_the_recipe(Vec2 u, float n) {
  const float alpha = std::acos(std::pow(u.x, 1 / (n + 1)));
  const float phi = 2 * carlo::pi_f * u.y;
  return {std::sin(alpha) * std::cos(phi), std::sin(alpha) * std::sin(phi), std::cos(alpha)};
}

struct LobeFound {
  double mean = 0;  ///< of 1 - cos(alpha), from w.x and w.y in double
  std::size_t angles = 0;
  double seconds = 0;  ///< per direction
};

LobeFound measure(const Sample& sample, double n, std::int64_t count, carlo::Rng rng) {
  std::vector<Vec3> directions;
  directions.reserve(static_cast<std::size_t>(count));
  const carlo::Stopwatch watch;
  for (std::int64_t i = 0; i < count; ++i) {
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    directions.push_back(sample({x, y}, static_cast<float>(n)));
  }
  const double spent = watch.seconds();
  LobeFound found;
  // Angles to five digits, since phi is rounded as well.
  std::set<double> angles;
  for (const Vec3 w : directions) {
    const double sine = std::hypot(w.x, w.y);
    found.mean += w.z > 0.7f ? sine * sine / (1 + std::sqrt(1 - sine * sine)) : 1 - w.z;
    angles.insert(std::round(1e5 * std::log(sine + 1e-30)));
  }
  found.mean /= static_cast<double>(count);
  found.angles = angles.size();
  found.seconds = spent / static_cast<double>(count);
  return found;
}

/// The worst relative error of the density in the very middle, where it is (n + 1)/(2 pi), computed
/// from the float dot product of a direction with itself.
double worst_power(double n) {
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto k = static_cast<float>(i);
    const Vec3 d = glm::normalize(Vec3(std::sin(k), std::cos(1.7f * k), std::sin(2.3f * k + 1)));
    const double power = std::pow(glm::dot(d, d), static_cast<float>(n));
    worst = std::max(worst, std::abs(power - 1));
  }
  return worst;
}

}  // namespace

void lobe_experiment(Notebook& notebook) {
  notebook.begin("Narrow lobes");
  notebook.attempt([&] {
    (void)sample_lobe({0.5f, 0.5f}, 1);
    carlo::Table table({"n", "exact", "yours / exact", "recipe / exact", "angles, yours",
                        "angles, recipe", "time, yours", "time, recipe", "pow(d·d, n) off by"},
                       {"n", "exact", "yours", "recipe", "angles", "angles_recipe", "seconds",
                        "seconds_recipe", "power_error"});
    carlo::Chart chart{"Relative error of the lobe's mean width",
                       "of the mean of 1 - cos(alpha), which is 1/(n + 2)",
                       {"n"},
                       {"relative error"},
                       {{"yours", {}}, {"the recipe in float", {}}}};
    const std::int64_t count = notebook.options().n / 2;
    for (int decade = 0; decade <= 8; ++decade) {
      notebook.progress(decade, 9);
      const double n = std::pow(10.0, decade), exact = 1 / (n + 2);
      const LobeFound yours = measure(sample_lobe, n, count, notebook.rng());
      const LobeFound recipe = measure(by_the_recipe, n, count, notebook.rng());
      table.add_row({n, exact, yours.mean / exact, recipe.mean / exact,
                     static_cast<std::int64_t>(yours.angles),
                     static_cast<std::int64_t>(recipe.angles), carlo::seconds_cell(yours.seconds),
                     carlo::seconds_cell(recipe.seconds), worst_power(n)});
      chart.series[0].points.push_back({n, std::abs(yours.mean / exact - 1)});
      chart.series[1].points.push_back({n, std::abs(recipe.mean / exact - 1)});
    }
    notebook.say(
        "1 - cos(alpha) has the mean 1/(n + 2), whatever n. The recipe alpha = acos(z^(1/(n+1))) "
        "is right on paper. In float the root rounds to one of the few numbers just below 1: its "
        "angles are counted here, to five digits, among all directions drawn. The last column is "
        "cos^n for a cosine of 1 that has rounded to 1 + 1e-7. Your lobe has to work up to n = "
        "1e7 only; the last row is beyond that.");
    notebook.table("lobe", table, "Mean of 1 - cos(alpha) and different angles");
    notebook.charts({chart});
  });
}

}  // namespace lab07
