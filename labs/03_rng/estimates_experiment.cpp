#include "experiments.h"
#include "generators.h"
#include "spectral.h"

#include <array>
#include <cmath>
#include <numbers>

// How a generator's weakness affects an estimate: a little, or completely.

namespace lab03 {
namespace {

using carlo::Curve;

using Integrand = std::function<double(const std::array<double, 3>&)>;

/// The mean of f over n triples of a fresh stream.
double estimate(const Generator& generator, std::uint64_t seed, std::int64_t n,
                const Integrand& f) {
  const Fill fill = generator.make(seed);
  std::array<std::uint32_t, 3 * 256> words{};
  double sum = 0;
  for (std::int64_t done = 0; done < n;) {
    fill(words);
    for (std::size_t i = 0; i < words.size() && done < n; i += 3, ++done)
      sum += f({words[i] * 0x1p-32, words[i + 1] * 0x1p-32, words[i + 2] * 0x1p-32});
  }
  return sum / static_cast<double>(n);
}

Curve curve(Notebook& notebook, const std::string& key, const std::string& name, const Integrand& f,
            double exact) {
  const Generator& generator = find_generator(key);
  Curve result{name.empty() ? generator.name : name, {}};
  carlo::Rng seeds = notebook.rng();
  const std::int64_t most = std::min<std::int64_t>(notebook.options().n / 16, 1 << 16);
  for (const std::int64_t n : carlo::ladder(64, most)) {
    result.runs.push_back(
        carlo::repeat(n, notebook.repetitions(64), carlo::Summary::root_mean_square, [&] {
          return carlo::Trial{estimate(generator, seeds.next_u64(), n, f), exact};
        }));
  }
  return result;
}

/// 1 + cos of the phase along s: constant on each plane that s belongs to, 1 on average.
Integrand wave(const DualVector& dual) {
  return [s = dual.s](const std::array<double, 3>& x) {
    double phase = 0;
    for (std::size_t i = 0; i < 3; ++i)
      phase += static_cast<double>(s[i]) * x[i];
    return 1 + std::cos(2 * std::numbers::pi * phase);
  };
}

/// The slope of a curve; an error that does not depend on N has none.
carlo::Cell slope(const Curve& c, const std::optional<carlo::PowerFit>& fit) {
  const bool constant = std::fabs(c.runs.front().error / c.runs.back().error - 1) < 1e-6;
  return constant ? carlo::Cell("constant", 0) : carlo::slope_cell(fit);
}

void show(Notebook& notebook, const std::string& key, const std::string& title,
          const std::vector<Curve>& curves, bool fitted) {
  if (curves.empty()) return;
  notebook.table(key, carlo::measurement_table(curves, 3), title);
  carlo::Table slopes({"generator", "slope against N", "slope against time"},
                      {"generator", "slope_points", "slope_seconds"});
  for (const Curve& c : curves)
    slopes.add_row({c.name, slope(c, c.against_points()), slope(c, c.against_seconds())});
  notebook.table(key + "_slopes", slopes, "Slope of log error, with 95 % interval");
  notebook.charts(carlo::error_charts(title, "root mean square error", curves, fitted));
  notebook.data(key + "_all", carlo::measurement_table(curves), title + ": all measurements");
}

}  // namespace

void estimates_experiment(Notebook& notebook) {
  notebook.begin("What a weak generator does to an estimate");
  const Integrand ball = [](const std::array<double, 3>& x) {
    return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] < 1 ? 1.0 : 0.0;
  };
  std::vector<Curve> harmless, fatal;
  double step = 0;
  const auto add = [&](std::vector<Curve>& curves, const char* key, const std::string& name,
                       const Integrand& f, double exact) {
    notebook.progress(step++, 8);
    notebook.attempt([&] { curves.push_back(curve(notebook, key, name, f, exact)); });
  };
  for (const char* key : {"lcg", "randu", "lfg-24-55-add", "pcg32", "philox"})
    add(harmless, key, "", ball, std::numbers::pi / 6);
  const Integrand lcg_wave = wave(shortest_dual_vector(Lcg::a, std::uint64_t{1} << 32, 3));
  const Integrand randu_wave = wave(shortest_dual_vector(65539, std::uint64_t{1} << 31, 3));
  add(fatal, "lcg", "LCG, wave along its planes", lcg_wave, 1);
  add(fatal, "pcg32", "PCG32, the LCG's wave", lcg_wave, 1);
  add(fatal, "randu", "RANDU, wave along its planes", randu_wave, 1);
  notebook.say(
      "First an eighth of a ball in the cube: its volume does not care much about planes. Then a "
      "wave whose crests are just as far apart as the generator's planes: every point sees the "
      "same phase, and more of them do not help. Streams start from random seeds; the error is "
      "over these.");
  show(notebook, "ball", "An eighth of a ball", harmless, true);
  show(notebook, "wave", "A wave along the planes", fatal, false);
}

}  // namespace lab03
