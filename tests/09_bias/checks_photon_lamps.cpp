// Checks of exercise 9.4: which lamp a photon leaves, and where photons come down.

#include "09_bias/photon_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab09_photons;

namespace {

const Diagnosis not_divided{"chance-not-divided",
                            "the lamp was chosen with a chance: the flux is to be divided by it."};
const Diagnosis multiplied{"chance-multiplied", "divide by the lamp's chance, do not multiply."};
const Diagnosis evenly{"lamps-chosen-evenly",
                       "all lamps have the same chance: they should have it in proportion to the "
                       "luminance of their powers."};
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

std::vector<Diagnosis> of_shares(const Shares& measured) {
  if (look_like(measured, {1 / 3.0, 1 / 3.0, 1 / 3.0})) return {evenly};
  if (look_like(measured, shares_by([](double, PhotonVec c) { return luminance_of(c); })))
    return {by_radiance};
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
  if (!verdict.passed) verdict.diagnoses = of_shares(measured);
  const bool chosen_well = verdict.passed;
  judge(verdict);
  // Right or wrong, the chance with which a lamp was chosen is what its flux is divided by.
  for (std::size_t i = 0; chosen_well && i < 3; ++i) {
    if (flux[i].empty()) continue;
    const auto side = static_cast<double>(coloured_lamps[i].side);
    const PhotonVec power = std::numbers::pi * side * side * PhotonVec(coloured_lamps[i].radiance);
    judge_flux(fmt::format("the flux of a photon of lamp {} of three", i + 1), flux[i],
               power / chances[i], {{power, not_divided}, {power * chances[i], multiplied}});
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

}  // namespace

TEST_CASE("Lab 9.4: the irradiance under a point lamp and under a square one", "[lab09][ex4]") {
  // Cells of side 1/4 of the square from (-1, -1) to (1, 1), and all else.
  constexpr std::size_t photons = 40'000, across = 8;
  std::vector<double> counts(across * across + 1), expected(counts.size());
  const Rows rows = land(false, photons);
  for (std::size_t i = 0; i < photons; ++i) {
    const double x = (rows.at(i, 0) + 1) * 4, y = (rows.at(i, 1) + 1) * 4;
    const bool inside = rows.at(i, 2) == 1 && x >= 0 && x < across && y >= 0 && y < across;
    counts[inside ? static_cast<std::size_t>(x) * across + static_cast<std::size_t>(y)
                  : counts.size() - 1] += 1;
  }
  double statistic = 0, rest = photons;
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    const double x = static_cast<double>(cell / across) / 4 - 1,
                 y = static_cast<double>(cell % across) / 4 - 1;
    const double angle = corner_angle(x + 0.25, y + 0.25) - corner_angle(x, y + 0.25) -
                         corner_angle(x + 0.25, y) + corner_angle(x, y);
    expected[cell] = cell + 1 == counts.size() ? rest : photons * angle / (4 * std::numbers::pi);
    rest -= expected[cell];
    statistic += (counts[cell] - expected[cell]) * (counts[cell] - expected[cell]) / expected[cell];
  }
  Verdict verdict = chi_square_fits("photons in cells under a point lamp: I cos/d^2", statistic,
                                    across * across, " over 65 cells");
  verdict.effect = effect_on_cells(statistic, across * across, photons);
  if (!verdict.passed) verdict.figure = counts_figure({}, counts, expected);
  judge(verdict);

  // The view factor of two unit squares at distance 1.
  const double root = std::sqrt(2.0);
  const double share =
      2 / std::numbers::pi *
      (std::log(std::sqrt(4 / 3.0)) + 2 * root * std::atan(1 / root) - std::numbers::pi / 2);
  constexpr std::size_t of_square = 20'000;
  const Rows under = land(true, of_square);
  std::vector<double> met;
  for (std::size_t i = 0; i < of_square; ++i) {
    const bool inside = std::abs(under.at(i, 0)) < 0.5 && std::abs(under.at(i, 1)) < 0.5;
    met.push_back(inside && under.at(i, 2) == 1 ? 1 : 0);
  }
  judge(mean_is("the share of a square lamp's photons on the square below", met,
                {share, std::sqrt(share * (1 - share))}));
}
