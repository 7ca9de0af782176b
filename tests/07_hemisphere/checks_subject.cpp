// What the checks of 7.3 to 7.6 have in common.

#include "07_hemisphere/subject.h"

namespace lab07_tests {

using namespace carlo::grader;

void judge_density(const Subject& subject, const std::vector<OtherPdf>& others,
                   const Suspects& integrals) {
  constexpr std::size_t count = std::size_t{density_rings} * density_sectors;
  const Rows rows = probe("Lab 7.3 to 7.6 density", subject.params(), {.rows = count});
  std::vector<Double3> places;
  double sum = 0;
  for (int ring = 0; ring < density_rings; ++ring) {
    for (int sector = 0; sector < density_sectors; ++sector)
      places.emplace_back(density_place(ring, sector));
  }
  for (const double value : rows.values)
    sum += value;
  judge(density_is("the density of " + subject.name, subject, places, rows.values, others));
  // The midpoint rule at 200 heights: off by less than .002 for n up to 10.
  judge(equals("the integral of the density over the sphere", sum * 4 * pi / count, 1, 0.004,
               integrals));
}

void judge_edges(const Subject& subject, const std::vector<Diagnosis>& at_zero) {
  const std::vector<Vec2> u = edge_numbers();
  const Rows rows = probe("Lab 7.3 to 7.6 edges", subject.params(),
                          {.rows = u.size(), .columns = 4, .finite = false});
  const std::vector<Double3> directions = directions_in(rows);
  judge(all_unit(directions));
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double pdf = rows.at(i, 3);
    const bool above = subject.sampler == Sampler::mirror || directions[i].z > 0;
    if (std::isfinite(pdf) && pdf > 0 && above) continue;
    judge(holds(fmt::format("the direction of u = ({:.8g}, {:.8g})", u[i].x, u[i].y), false,
                fmt::format("cos(theta) = {:.3g}, density {:.3g}", directions[i].z, pdf),
                "a density above 0, and finite", at_zero));
    return;
  }
  judge(holds("directions at the edges of [0, 1)^2", true, "all with a density above 0",
              "a density above 0"));
}

Drawn draw(const Subject& subject, std::size_t count) {
  const Rows rows =
      probe("Lab 7.3 to 7.6 directions", subject.params(static_cast<std::int64_t>(count)),
            {.rows = count, .columns = 4});
  return {directions_in(rows), column(rows, 3)};
}

void judge_drawn(const Subject& subject, const Drawn& drawn) {
  judge(all_unit(drawn.directions));
  if (subject.sampler != Sampler::mirror) {
    std::size_t lost = 0;
    for (const Double3 w : drawn.directions)
      lost += w.z > 0 ? 0 : 1;
    judge(holds("directions below the horizon", lost == 0,
                fmt::format("{} of {}", lost, drawn.directions.size()), "none", {below_kept}));
  }
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < drawn.pdf.size(); ++i) {
    const Double3 w = drawn.directions[i];
    // A density is asked for elsewhere; here that it belongs to the samples. A direction on the
    // very edge may be rounded out of the lobe.
    const bool edge = subject.axes().local(w).z < 1e-6;
    if (!edge && !agree(drawn.pdf[i], subject.pdf(w), 2 * subject.tolerance(w))) ++wrong;
  }
  judge(holds("the density that goes with each direction", wrong == 0,
              fmt::format("wrong for {} of {}", wrong, drawn.pdf.size()), "theory's"));
}

}  // namespace lab07_tests
