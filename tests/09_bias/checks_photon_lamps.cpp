// Checks of exercise 9.4: which lamp a photon leaves, and where photons come down.

#include "09_bias/photon_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace lab09_photons {

using namespace carlo::grader;

namespace {

const Diagnosis not_divided{"chance-not-divided",
                            "the lamp was chosen with a chance: the flux is to be divided by it."};
const Diagnosis multiplied{"chance-multiplied", "divide by the lamp's chance, do not multiply."};
const Diagnosis evenly{"lamps-chosen-evenly",
                       "all lamps have the same chance: they should have it in proportion to the "
                       "luminance of their powers."};
const Diagnosis never_chosen{"lamp-never-chosen", "a lamp is never chosen."};
const Diagnosis by_radiance{"lamps-chosen-by-radiance",
                            "lamps are chosen by their radiance: a large one has more power than "
                            "a small one."};
const Diagnosis by_mean{"lamps-chosen-by-channel-mean",
                        "lamps are chosen by the mean of the channels, not by luminance()."};

}  // namespace

namespace {

using Shares = std::array<double, 3>;

/// What decides how often each lamp is chosen.
Shares shares_by(double (*weight)(double area, PhotonVec radiance)) {
  Shares shares{};
  double all = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto side = static_cast<double>(coloured_lamps[i].side);
    shares[i] = weight(side * side, PhotonVec(coloured_lamps[i].radiance));
    all += shares[i];
  }
  for (double& share : shares)
    share /= all;
  return shares;
}

double luminance_of(PhotonVec c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// Whether these shares are nearer to `expected` than chance would bring others.
bool look_like(const Shares& measured, const Shares& expected) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    most = std::max(most, std::abs(measured[i] - expected[i]));
  return most < 0.03;
}

PhotonVec power_of(std::size_t lamp) {
  const auto side = static_cast<double>(coloured_lamps[lamp].side);
  return std::numbers::pi * side * side * PhotonVec(coloured_lamps[lamp].radiance);
}

/// `flux`: of a photon of the second lamp.
std::vector<Diagnosis> of_shares(const Shares& measured, PhotonVec flux) {
  if (std::find(measured.begin(), measured.end(), 0) != measured.end()) return {never_chosen};
  if (look_like(measured, {1 / 3.0, 1 / 3.0, 1 / 3.0})) return {evenly};
  const Shares radiance = shares_by([](double, PhotonVec c) { return luminance_of(c); });
  // Or is it that power knows nothing of the area?
  const bool power_is_right = off(flux * radiance[1], power_of(1)) < 0.01;
  if (look_like(measured, radiance) && power_is_right) return {by_radiance};
  if (look_like(measured,
                shares_by([](double area, PhotonVec c) { return area * (c.r + c.g + c.b); })))
    return {by_mean};
  return {};
}

}  // namespace

TEST_CASE("Lab 9.4: lamps by the luminance of their powers", "[lab09][ex4]") {
  constexpr std::size_t photons = 20'000;
  const Rows rows = probe("Lab 9.4 lamps", {.n = photons}, {.rows = photons, .columns = 4});
  const Shares chances = shares_by([](double area, PhotonVec c) { return area * luminance_of(c); });
  Shares counts{};
  std::array<std::vector<PhotonVec>, 3> flux;
  for (std::size_t i = 0; i < photons; ++i) {
    const double lamp = std::clamp(rows.at(i, 0) / lamp_step, 0.0, 2.0);
    const auto index = static_cast<std::size_t>(lamp);
    counts[index] += 1;
    flux[index].push_back(vec(rows, i, 1));
  }
  double statistic = 0;
  Shares measured{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double expected = chances[i] * photons;
    statistic += (counts[i] - expected) * (counts[i] - expected) / expected;
    measured[i] = counts[i] / photons;
  }
  Verdict verdict = chi_square_fits("how often each of three lamps is chosen", statistic, 2);
  verdict.effect = effect_on_cells(statistic, 2, photons);
  if (!verdict.passed)
    verdict.diagnoses = of_shares(measured, flux[1].empty() ? PhotonVec(0) : flux[1].front());
  const bool chosen_well = verdict.passed;
  judge(verdict);
  for (std::size_t i = 0; chosen_well && i < 3; ++i) {
    judge_flux(fmt::format("the flux of a photon of lamp {} of three", i + 1), flux[i],
               power_of(i) / chances[i],
               {{power_of(i), not_divided}, {power_of(i) * chances[i], multiplied}});
  }
}

namespace {

/// The solid angle of the rectangle from (0, 0) to (x, y) at distance 1 from the point above its
/// first corner.
double corner_angle(double x, double y) {
  return std::atan(x * y / std::sqrt(x * x + y * y + 1));
}

Rows land(bool square, std::size_t photons) {
  return probe("Lab 9.4 landing",
               {.n = static_cast<std::int64_t>(photons), .numbers = {{"square", square ? 1 : 0}}},
               {.rows = photons, .columns = 3, .of = square ? "a square lamp" : "a point lamp"});
}

/// Cells of side 1/4 of the square from (-1, -1) to (1, 1), and a last one for all else.
constexpr std::size_t cells_across = 8;

std::size_t cell_of(double x, double y) {
  const double column = (x + 1) * 4, row = (y + 1) * 4;
  const bool inside = column >= 0 && column < cells_across && row >= 0 && row < cells_across;
  return inside ? static_cast<std::size_t>(column) * cells_across + static_cast<std::size_t>(row)
                : cells_across * cells_across;
}

/// The share of a point lamp's photons in each cell: its part of the solid angle.
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

TEST_CASE("Lab 9.4: the irradiance under a point lamp", "[lab09][ex4]") {
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
  Verdict verdict = chi_square_fits("photons under a point lamp, as I cos/d^2", statistic, freedom,
                                    " over 65 cells");
  verdict.effect = effect_on_cells(statistic, freedom, photons);
  if (!verdict.passed) verdict.figure = counts_figure({}, counts, expected);
  judge(verdict);
}

TEST_CASE("Lab 9.4: the irradiance under a square lamp", "[lab09][ex4]") {
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
  judge(mean_is("the share of a square lamp's photons on the square below", met,
                {share, std::sqrt(share * (1 - share))}));
}

}  // namespace lab09_photons
