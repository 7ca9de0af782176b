// Checks of exercise 9.4: which light photons leave, and where they land.

#include "09_bias/photon_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace lab09_photons {

using namespace carlo::grader;

namespace {

const Diagnosis not_divided{"chance-not-divided",
                            "the light was chosen at random: divide the flux by its chance()."};
const Diagnosis multiplied{"chance-multiplied", "divide by the light's chance(), do not multiply."};
const Diagnosis evenly{"lights-chosen-evenly",
                       "all lights have the same probability: world.choose() chooses half of the "
                       "time by power."};
const Diagnosis never_chosen{"light-never-chosen", "a light is never chosen."};
const Diagnosis by_power{"lights-chosen-by-power-alone",
                         "lights are chosen by power alone, so that a weak one beside a strong "
                         "one has no photons: world.choose() samples every light often enough."};

using Lights = std::span<const ColouredLight>;

PhotonVec power_of(const ColouredLight& light) {
  const auto side = static_cast<double>(light.side);
  return std::numbers::pi * side * side * PhotonVec(light.radiance);
}

/// Each light's fraction of the total power, by luminance.
std::vector<double> shares_by_power(Lights lights) {
  std::vector<double> shares;
  double all = 0;
  for (const ColouredLight& light : lights) {
    shares.push_back(glm::dot(power_of(light), PhotonVec(0.2126, 0.7152, 0.0722)));
    all += shares.back();
  }
  for (double& share : shares)
    share /= all;
  return shares;
}

/// World::choose()'s probabilities.
std::vector<double> chances_of(Lights lights) {
  std::vector<double> chances = shares_by_power(lights);
  for (double& chance : chances)
    chance = (chance + 1 / static_cast<double>(lights.size())) / 2;
  return chances;
}

/// True if these frequencies match `expected` within chance.
bool look_like(const std::vector<double>& measured, const std::vector<double>& expected) {
  double most = 0;
  for (std::size_t i = 0; i < measured.size(); ++i)
    most = std::max(most, std::abs(measured[i] - expected[i]));
  return most < 0.03;
}

/// The light that each of many photons left, and the flux that they carry.
struct Emitted {
  static constexpr std::size_t photons = 20'000;
  std::vector<double> shares;
  std::vector<std::vector<PhotonVec>> flux;

  Emitted(Lights lights, bool weak) : shares(lights.size()), flux(lights.size()) {
    const Rows rows = probe("Lab 9.4 lights", {.n = photons, .numbers = {{"weak", weak ? 1 : 0}}},
                            {.rows = photons, .columns = 4});
    for (std::size_t i = 0; i < photons; ++i) {
      const double light =
          std::clamp(rows.at(i, 0) / light_step, 0.0, static_cast<double>(lights.size() - 1));
      const auto index = static_cast<std::size_t>(light);
      shares[index] += 1.0 / photons;
      flux[index].push_back(vec(rows, i, 1));
    }
  }
};

std::vector<Diagnosis> of_shares(const std::vector<double>& measured) {
  if (std::find(measured.begin(), measured.end(), 0) != measured.end()) return {never_chosen};
  if (look_like(measured, {1 / 3.0, 1 / 3.0, 1 / 3.0})) return {evenly};
  if (look_like(measured, shares_by_power(coloured_lights))) return {by_power};
  return {};
}

/// Returns true if lights are chosen correctly.
bool judge_shares(const std::string& what, const Emitted& emitted,
                  const std::vector<double>& chances, const std::vector<Diagnosis>& diagnoses) {
  double statistic = 0;
  for (std::size_t i = 0; i < chances.size(); ++i) {
    const double difference = emitted.shares[i] - chances[i];
    statistic += difference * difference / chances[i] * Emitted::photons;
  }
  const auto freedom = static_cast<double>(chances.size() - 1);
  Verdict verdict = chi_square_fits(what, statistic, freedom);
  verdict.effect = effect_on_cells(statistic, freedom, Emitted::photons);
  if (!verdict.passed) verdict.diagnoses = diagnoses;
  const bool passed = verdict.passed;
  judge(verdict);
  return passed;
}

void judge_fluxes(const std::string& of, Lights lights, const Emitted& emitted) {
  const std::vector<double> chances = chances_of(lights);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const PhotonVec power = power_of(lights[i]);
    judge_flux(fmt::format("the flux of a photon of light {} of {}", i + 1, of), emitted.flux[i],
               power / chances[i], {{power, not_divided}, {power * chances[i], multiplied}});
  }
}

}  // namespace

// 20 000 photons detect probabilities that are off by a fiftieth with power .999.
TEST_CASE("Lab 9.4: lights half by their powers, half evenly", "[lab09][ex4]") {
  const Emitted emitted(coloured_lights, false);
  if (judge_shares("how often each of three lights is chosen", emitted, chances_of(coloured_lights),
                   of_shares(emitted.shares)))
    judge_fluxes("three", coloured_lights, emitted);
}

// Without its photons the weak light's surroundings would be dark, whatever the error bar says.
TEST_CASE("Lab 9.4: a weak light beside a strong one has its photons", "[lab09][ex4]") {
  const Emitted emitted(weak_and_strong, true);
  std::vector<Diagnosis> diagnoses;
  if (!look_like(emitted.shares, chances_of(weak_and_strong)))
    diagnoses = of_shares(Emitted(coloured_lights, false).shares);
  if (judge_shares("how often a weak light and a strong one are chosen", emitted,
                   chances_of(weak_and_strong), diagnoses))
    judge_fluxes("two", weak_and_strong, emitted);
}

namespace {

/// The solid angle of the rectangle from (0, 0) to (x, y), seen from the point at distance 1 above
/// its first corner.
double corner_angle(double x, double y) {
  return std::atan(x * y / std::sqrt(x * x + y * y + 1));
}

Rows land(bool square, std::size_t photons) {
  return probe("Lab 9.4 landing",
               {.n = static_cast<std::int64_t>(photons), .numbers = {{"square", square ? 1 : 0}}},
               {.rows = photons, .columns = 3, .of = square ? "a square light" : "a point light"});
}

/// Cells of side 1/4 of the square from (-1, -1) to (1, 1), and a last one for everything else.
constexpr std::size_t cells_across = 8;

std::size_t cell_of(double x, double y) {
  const double column = (x + 1) * 4, row = (y + 1) * 4;
  const bool inside = column >= 0 && column < cells_across && row >= 0 && row < cells_across;
  return inside ? static_cast<std::size_t>(column) * cells_across + static_cast<std::size_t>(row)
                : cells_across * cells_across;
}

/// The fraction of a point light's photons in each cell: its fraction of the solid angle.
std::vector<double> shares_below() {
  std::vector<double> shares;
  double rest = 1;
  for (std::size_t cell = 0; cell < cells_across * cells_across; ++cell) {
    const std::size_t column = cell / cells_across, row = cell % cells_across;
    const double x = static_cast<double>(column) / 4 - 1;
    const double y = static_cast<double>(row) / 4 - 1;
    const double angle = corner_angle(x + 0.25, y + 0.25) - corner_angle(x, y + 0.25) -
                         corner_angle(x + 0.25, y) + corner_angle(x, y);
    shares.push_back(angle / (4 * std::numbers::pi));
    rest -= shares.back();
  }
  shares.push_back(rest);
  return shares;
}

}  // namespace

TEST_CASE("Lab 9.4: the irradiance under a point light", "[lab09][ex4]") {
  constexpr std::size_t photons = 40'000;
  const Rows rows = land(false, photons);
  std::vector<double> expected = shares_below(), counts(expected.size());
  for (std::size_t i = 0; i < photons; ++i)
    counts[rows.at(i, 2) == 1 ? cell_of(rows.at(i, 0), rows.at(i, 1)) : counts.size() - 1] += 1;
  double statistic = 0;
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    expected[cell] *= photons;
    const double difference = counts[cell] - expected[cell];
    statistic += difference * difference / expected[cell];
  }
  const auto freedom = static_cast<double>(counts.size() - 1);
  Verdict verdict = chi_square_fits("photons under a point light, as I cos/d^2", statistic, freedom,
                                    " over 65 cells");
  verdict.effect = effect_on_cells(statistic, freedom, photons);
  if (!verdict.passed) verdict.figure = counts_figure({}, counts, expected);
  judge(verdict);
}

TEST_CASE("Lab 9.4: the irradiance under a square light", "[lab09][ex4]") {
  // The view factor of two unit squares at distance 1.
  const double root = std::sqrt(2.0);
  const double share =
      2 / std::numbers::pi *
      (std::log(std::sqrt(4 / 3.0)) + 2 * root * std::atan(1 / root) - std::numbers::pi / 2);
  constexpr std::size_t photons = 20'000;
  const Rows rows = land(true, photons);
  std::vector<double> met;
  for (std::size_t i = 0; i < photons; ++i) {
    const bool below = std::abs(rows.at(i, 0)) < 0.5 && std::abs(rows.at(i, 1)) < 0.5;
    met.push_back(below && rows.at(i, 2) == 1 ? 1 : 0);
  }
  judge(mean_is("the share of a square light's photons on the square below", met,
                {share, std::sqrt(share * (1 - share))}));
}

}  // namespace lab09_photons
