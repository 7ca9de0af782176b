// Shared by the checks of 7.3 to 7.6.

#include "07_hemisphere/subject.h"

#include <algorithm>

namespace lab07_tests {

using namespace carlo::grader;

void judge_density(const Subject& subject, const std::vector<OtherPdf>& others,
                   const Suspects& integrals) {
  constexpr std::size_t count = std::size_t{density_rings} * density_sectors;
  const Rows rows = probe("Lab 7.3 to 7.6 density", subject.params(),
                          {.rows = count, .finite = false, .of = subject.name});
  std::vector<Double3> places;
  double sum = 0;
  for (int ring = 0; ring < density_rings; ++ring) {
    for (int sector = 0; sector < density_sectors; ++sector)
      places.emplace_back(density_place(ring, sector));
  }
  for (const double value : rows.values)
    sum += value;
  judge(density_is("the density of " + subject.name, subject, places, rows.values, others));
  // The midpoint rule at 200 heights: its error is below .002 for n up to 10.
  judge(equals("the integral of the density over the sphere", sum * 4 * pi / count, 1, 0.004,
               integrals));
}

namespace {

const Diagnosis on_horizon{"direction-on-horizon",
                           "there are u whose direction lies on the horizon, where the density is "
                           "0: keep the cosine above 0."};
/// True if only numbers u with a coordinate 0 are bad, and all of them.
bool bad_at_zero_only(const std::vector<Vec2>& u, const std::vector<bool>& bad) {
  bool x = true, y = true;
  for (std::size_t i = 0; i < u.size(); ++i) {
    x = x && bad[i] == (u[i].x == 0);
    y = y && bad[i] == (u[i].y == 0);
  }
  return x || y;
}

}  // namespace

void judge_edges(const Subject& subject, const std::vector<Diagnosis>& at_zero) {
  const std::vector<Vec2> u = edge_numbers();
  const Rows rows = probe("Lab 7.3 to 7.6 edges", subject.params(),
                          {.rows = u.size(), .columns = 4, .finite = false, .of = subject.name});
  const std::vector<Double3> directions = directions_in(rows);
  judge(all_unit(directions));
  std::vector<bool> bad;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double pdf = rows.at(i, 3);
    const bool above = subject.sampler == Sampler::mirror || directions[i].z > 0;
    bad.push_back(!(std::isfinite(pdf) && pdf > 0 && above));
  }
  const auto first = std::find(bad.begin(), bad.end(), true) - bad.begin();
  if (const auto i = static_cast<std::size_t>(first); i < bad.size()) {
    const double cosine = subject.axes().local(directions[i]).z;
    const bool has_exponent =
        subject.sampler == Sampler::lobe || subject.sampler == Sampler::mirror;
    std::vector<Diagnosis> diagnoses;
    if (has_exponent && cosine > 1e-8 && cosine < 0.01) {
      diagnoses = {near_horizon};
    } else if (subject.sampler != Sampler::mirror && std::abs(cosine) < 1e-6) {
      diagnoses = bad_at_zero_only(u, bad) ? at_zero : std::vector<Diagnosis>{on_horizon};
    }
    judge(holds(
        fmt::format("{}: the direction of u = ({:.8g}, {:.8g})", subject.name, u[i].x, u[i].y),
        false, fmt::format("cosine {:.3g}, density {}", cosine, number_or_nan(rows.at(i, 3))),
        subject.sampler == Sampler::mirror ? "a density above 0, and finite"
                                           : "a cosine above 0, and a density above 0 and finite",
        diagnoses));
    return;
  }
  judge(holds("directions at the edges of [0, 1)^2", true, "all with a density above 0",
              "a density above 0"));
}

namespace {

const Diagnosis degrees_given{"degrees-for-radians",
                              "the azimuth is passed to std::cos and std::sin in degrees: they "
                              "take radians; a whole turn is 2 pi. So it winds round 57 times."};
const Diagnosis neighbours_parted{"neighbours-parted",
                                  "nearby u give directions far apart: stratified u will not give "
                                  "stratified directions."};

/// The position of a direction when the law is spread evenly over the unit disc: directions that
/// are close relative to the law's width are close there.
glm::dvec2 on_disc(Double3 w, const Share& share) {
  const double across = std::hypot(w.x, w.y);
  if (!(across > 0)) return {0, 0};
  return std::sqrt(share(w)) / across * glm::dvec2(w.x, w.y);
}

/// Statistics of pairs of neighbours in one coordinate of u.
struct Steps {
  double far = 0;      ///< the number of pairs that are much farther apart than their u
  double degrees = 0;  ///< the number of pairs whose azimuth moved by 360 radians per unit of u
};

Steps steps_between(const std::vector<Double3>& from, const std::vector<Double3>& to,
                    const Share& share) {
  constexpr double step = neighbour_step, too_far = 30;
  Steps steps;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double apart = glm::length(on_disc(from[i], share) - on_disc(to[i], share));
    steps.far += apart <= too_far * step ? 0 : 1;
    const double turn = std::abs(azimuth_share(from[i]) - azimuth_share(to[i])) * 2 * pi;
    steps.degrees +=
        std::abs(std::min(turn, 2 * pi - turn) - 360 * step) < 0.02 * 360 * step ? 1 : 0;
  }
  return steps;
}

}  // namespace

// On the disc, if u moves by d, right formulas move directions by at most 2 pi d along a circle,
// and by d/(2 r) outwards at radius r: more than 30 d for one pair in 3600. A line along which the
// direction jumps separates one pair in 8000. A twentieth of 2000 pairs may be separated: right
// mappings fail with a probability below 1e-30, and so do those with ten such lines. A mapping that
// winds round 57 times separates 99 % of them.
void judge_neighbours(const Subject& subject) {
  constexpr std::size_t pairs = 2000;
  const Rows rows = probe("Lab 7.3 to 7.5 neighbours", subject.params(pairs),
                          {.rows = pairs, .columns = 9, .finite = false, .of = subject.name});
  const Share share = power_law(subject.m());
  const std::vector<Double3> here = directions_in(rows);
  for (const std::size_t coordinate : {0u, 1u}) {
    const Steps steps = steps_between(here, directions_in(rows, 3 + 3 * coordinate), share);
    const bool right = steps.far <= 0.05 * pairs, wound = steps.degrees > 0.8 * pairs;
    judge(holds(fmt::format("{}: directions whose u.{} differ by {:.2g}", subject.name,
                            coordinate == 0 ? 'x' : 'y', neighbour_step),
                right, fmt::format("{} of {} pairs are far apart", steps.far, pairs),
                "a few at most, where the direction jumps",
                {wound ? degrees_given : neighbours_parted}));
  }
}

Drawn draw(const Subject& subject, std::size_t count) {
  const Rows rows =
      probe("Lab 7.3 to 7.6 directions", subject.params(static_cast<std::int64_t>(count)),
            {.rows = count,
             .columns = 4,
             .finite = false,
             .of = fmt::format("{} directions of {}", count, subject.name)});
  return {directions_in(rows), column(rows, 3)};
}

void judge_drawn(const Subject& subject, const Drawn& drawn,
                 const std::vector<Diagnosis>& all_below) {
  judge(all_unit(drawn.directions));
  if (subject.sampler != Sampler::mirror) {
    std::size_t lost = 0;
    for (const Double3 w : drawn.directions)
      lost += w.z > 0 ? 0 : 1;
    judge(holds("directions of " + subject.name + " below the horizon", lost == 0,
                fmt::format("{} of {}", lost, drawn.directions.size()), "none",
                lost == drawn.directions.size() && !all_below.empty() ? all_below
                                                                      : std::vector{below_kept}));
  }
  std::size_t wrong = 0;
  std::string example;
  for (std::size_t i = 0; i < drawn.pdf.size(); ++i) {
    const Double3 w = drawn.directions[i];
    // Densities are tested elsewhere; here they must belong to the samples. A direction on the very
    // edge may be rounded out of the lobe.
    const bool edge = subject.axes().local(w).z < 1e-6;
    if (edge || agree(drawn.pdf[i], subject.pdf(w), 2 * subject.tolerance(w))) continue;
    if (++wrong > 1) continue;
    example =
        fmt::format("; the first is {} at w = ({:.6g}, {:.6g}, {:.6g}), where {:.6g} is right",
                    number_or_nan(drawn.pdf[i]), w.x, w.y, w.z, subject.pdf(w));
  }
  judge(holds("the density that goes with each direction of " + subject.name, wrong == 0,
              fmt::format("wrong for {} of {}{}", wrong, drawn.pdf.size(), example), "theory's"));
}

}  // namespace lab07_tests
