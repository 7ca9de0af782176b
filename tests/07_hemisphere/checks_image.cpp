// Checks of exercise 7.8: closed forms for the mapping and the densities. Drawn directions: the
// frequencies of texels by chi-square from 100 000 directions (one off by 2 % on average is
// detected), places within texels by Kolmogorov-Smirnov.

#include "07_hemisphere/image_law.h"
#include "07_hemisphere/quadrature.h"

#include <algorithm>
#include <array>

using namespace carlo::grader;
using namespace lab07_tests;

namespace {

const Unsaid image_case{"sky"};

const Diagnosis negative_azimuth{
    "negative-azimuth",
    "atan2 gives angles from -pi to pi: the negative ones are the image's right half."};
const Diagnosis at_one{"place-at-one",
                       "x or y becomes 1, which belongs to no texel: at the lower pole y is 1, and "
                       "a tiny negative azimuth plus a whole turn rounds to one."};
const Diagnosis near_poles{
    "digits-lost-at-poles",
    "it is wrong only next to the poles: there w.y rounds to 1 and no longer determines the "
    "angle, but w.x and w.z do."};
const Diagnosis neighbours_density{
    "density-of-the-neighbour",
    "at the edge of a texel wi rounds into its neighbour, which may be black: the sample's density "
    "is that of the texel drawn."};
const Diagnosis angle_in_row{
    "angle-uniform-in-row",
    "within a row the angle to the pole is uniform; for uniform directions w.y has to be."};
const Diagnosis heights_in_float{
    "heights-in-float",
    "next to a pole only a few heights occur: there a float cosine is 1 except for its last "
    "digits, and 1 - cos^2 loses them. Compute in double."};
const Diagnosis fixed_place{
    "one-place-a-texel",
    "all directions of a texel are the same: the position within the texel has to be drawn as well."};
const Diagnosis float_u{"u-in-float",
                        "u becomes a float: its steps of 6e-8 never find a texel that has 1e-9 of "
                        "the power. Keep it double."};
const Diagnosis numbers_reused{
    "reused-number", "row and column come from one random number: only some texels ever occur."};

Params of(Sky sky, std::int64_t n = 0) {
  return {.n = n, .numbers = {{"sky", static_cast<double>(sky)}}};
}

/// Directions drawn from a sky: x, y, z, the sample's density, and the value of pdf() for wi.
Rows drawn_from(Sky sky, std::size_t n) {
  return probe("Lab 7.8 directions", of(sky, static_cast<std::int64_t>(n)),
               {.rows = n, .columns = 5, .finite = false, .of = name_of(sky)});
}

std::string text(Double3 w) {
  return fmt::format("({:.7g}, {:.7g}, {:.7g})", w.x, w.y, w.z);
}

Verdict mapping_verdict(const std::vector<Double3>& measured,
                        const std::vector<ImagePoint>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Double3 exact = seen_in(places[i]);
    if (glm::length(measured[i] - exact) <= 1e-6) continue;
    std::vector<Diagnosis> diagnoses;
    for (const OtherMapping& other : other_mappings()) {
      bool fits = true;
      for (std::size_t k = 0; fits && k < places.size(); ++k)
        fits = glm::length(measured[k] - other.seen(places[k])) <= 2e-6;
      if (fits) diagnoses.push_back(other.diagnosis);
    }
    return holds(
        fmt::format("the direction of the place ({:.6g}, {:.6g})", places[i].x, places[i].y), false,
        text(measured[i]), text(exact), diagnoses);
  }
  return holds("the directions of places", true, fmt::format("right at all {}", places.size()),
               "right everywhere");
}

/// True if a place is right, up to whole turns.
bool place_fits(ImagePoint measured, Double3 w) {
  const ImagePoint exact = stands_at(w);
  const bool pole = std::hypot(w.x, w.z) < 1e-18;
  const double across = std::abs(measured.x - exact.x);
  return (pole || std::min(across, std::abs(1 - across)) <= 1e-6) &&
         std::abs(measured.y - exact.y) <= 1e-6;
}

std::vector<Diagnosis> why_places_are_wrong(const std::vector<ImagePoint>& measured,
                                            const std::vector<Vec3>& directions) {
  bool poles = true;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Double3 w(directions[i]);
    poles = poles && (place_fits(measured[i], w) || std::hypot(w.x, w.z) < 0.02);
  }
  if (poles) return {near_poles};
  std::vector<Diagnosis> diagnoses;
  for (const OtherMapping& other : other_mappings()) {
    bool fits = true;
    for (std::size_t i = 0; fits && i < measured.size(); ++i)
      fits = place_fits(measured[i], other.back(Double3(directions[i])));
    if (fits) diagnoses.push_back(other.diagnosis);
  }
  return diagnoses;
}

/// The texels that the directions fall into, and the positions within: across, and down by height
/// w.y.
struct Landed {
  std::vector<double> counts;
  std::vector<double> across, down, angles;  ///< in [0, 1]; `angles`: down by the angle
};

Landed land(const SkyImage& image, const Rows& rows) {
  Landed landed{std::vector<double>(image.luminance.size()), {}, {}, {}};
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const Double3 w(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
    const ImagePoint p = stands_at(w);
    const TexelPlace t = texel_place(image, p);
    landed.counts[t.index] += 1;
    landed.across.push_back(t.across);
    landed.angles.push_back(t.down);
    const std::size_t row = t.index / image.width;
    const double rows_high = static_cast<double>(image.height),
                 top = std::cos(pi * static_cast<double>(row) / rows_high),
                 bottom = std::cos(pi * static_cast<double>(row + 1) / rows_high);
    landed.down.push_back((top - std::cos(pi * p.y)) / (top - bottom));
  }
  return landed;
}

Verdict texels_verdict(Sky sky, const Landed& landed, double n) {
  const SkyImage image = sky_image(sky);
  const std::vector<double> shares = shares_by_power(image);
  const auto lit = std::count_if(shares.begin(), shares.end(), [](double s) { return s > 0; });
  const auto freedom = static_cast<double>(lit - 1);
  Verdict verdict = chi_square_fits(fmt::format("directions in each texel of {}", name_of(sky)),
                                    chi_square(landed.counts, shares, n), freedom,
                                    fmt::format(" over {} texels, from {} directions", lit, n));
  if (verdict.passed) return verdict;
  std::vector<double> expected = shares;
  for (double& share : expected)
    share *= n;
  verdict.figure =
      cells_figure("column", "row, from the top", image.width, landed.counts, expected);
  for (const OtherShares& other : other_shares(image)) {
    if (chi_square_fits("", chi_square(landed.counts, other.shares, n), freedom).passed)
      verdict.diagnoses.push_back(other.diagnosis);
  }
  const auto seen = std::count_if(landed.counts.begin(), landed.counts.end(),
                                  [](double count) { return count > 0; });
  if (verdict.diagnoses.empty() && 2 * seen < lit) verdict.diagnoses.push_back(numbers_reused);
  return verdict;
}

/// `by_sine`: whether the samples' densities divide by the sine of the direction; then uniform
/// angles are part of the same mistake.
Verdict within_verdict(Sky sky, const std::string& which, const std::vector<double>& values,
                       const std::vector<double>& angles, bool by_sine) {
  Verdict verdict =
      uniform_on(fmt::format("{} within the texels of {}", which, name_of(sky)), values, 0, 1);
  if (verdict.passed) return verdict;
  if (all_alike(values)) {
    verdict.diagnoses.push_back(fixed_place);
  } else if (sky == Sky::cap && few_values(values)) {
    verdict.diagnoses.push_back(heights_in_float);
  } else if (!angles.empty() && uniform_on("", angles, 0, 1).passed) {
    verdict.diagnoses.push_back(by_sine ? sine_of_direction : angle_in_row);
  }
  return verdict;
}

/// Checks that every direction has length 1 and lies in a texel that emits, and that sample and
/// pdf() have that texel's density.
void judge_samples(Sky sky, const Rows& rows) {
  const SkyImage image = sky_image(sky);
  const std::vector<Double3> directions = directions_in(rows);
  judge(all_unit(directions));
  std::size_t black = 0, of_sample = 0, asked = 0, at_edges = 0;
  std::size_t first_black = 0, first_sample = 0, first_asked = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const TexelPlace t = lit_texel_near(image, stands_at(directions[i]));
    const double exact = density_of(image, t.index), drawn = rows.at(i, 3);
    if (!(exact > 0)) {
      if (black++ == 0) first_black = i;
    } else if (!agree(drawn, exact, 1e-5) && !(t.near_edge && fits_a_texel(image, drawn))) {
      at_edges += t.near_edge ? 1 : 0;
      if (of_sample++ == 0) first_sample = i;
    } else if (!t.near_edge && !agree(rows.at(i, 4), exact, 1e-5)) {
      if (asked++ == 0) first_asked = i;
    }
  }
  const std::string in = fmt::format("{}: ", name_of(sky));
  const auto seen = [&](std::size_t count, std::size_t first, std::size_t column) {
    if (count == 0) return fmt::format("none of {}", directions.size());
    return fmt::format("{} of {}, such as {} at {}", count, directions.size(),
                       number_or_nan(rows.at(first, column)), text(directions[first]));
  };
  judge(holds(in + "directions in black texels", black == 0, seen(black, first_black, 3), "none"));
  judge(holds(in + "samples whose density is not their texel's", of_sample == 0,
              seen(of_sample, first_sample, 3), "none",
              of_sample == at_edges ? std::vector{neighbours_density} : std::vector<Diagnosis>{}));
  judge(holds(in + "samples whose density is another when asked for", asked == 0,
              seen(asked, first_asked, 4), "none"));
}

void judge_image_density(Sky sky) {
  const SkyImage image = sky_image(sky);
  const std::vector<Vec3> places = density_places(image);
  const Rows rows = probe("Lab 7.8 density", of(sky),
                          {.rows = places.size(), .finite = false, .of = name_of(sky)});
  judge(
      image_density_is(fmt::format("the density of {}", name_of(sky)), image, places, rows.values));
  // Nine places represent each texel of every row.
  if (density_rows(image).size() != image.height) return;
  double integral = 0;
  for (std::size_t i = 0; i < rows.values.size(); ++i)
    integral += rows.values[i] * image.solid_angle(i / 9 / image.width) / 9;
  judge(equals(fmt::format("the integral of the density of {} over the sphere", name_of(sky)),
               integral, 1, 1e-4));
}

}  // namespace

TEST_CASE("Lab 7.8: each place of the image has its direction", "[lab07][ex8]") {
  const std::vector<ImagePoint> places = image_places();
  const Rows rows = probe("Lab 7.8 directions of places", {},
                          {.rows = places.size(), .columns = 3, .finite = false});
  const std::vector<Double3> directions = directions_in(rows);
  judge(all_unit(directions));
  judge(mapping_verdict(directions, places));
}

TEST_CASE("Lab 7.8: each direction has its place, within the image", "[lab07][ex8]") {
  const std::vector<Vec3> directions = sphere_places();
  const Rows rows = probe("Lab 7.8 places of directions", {},
                          {.rows = directions.size(), .columns = 2, .finite = false});
  std::vector<ImagePoint> places;
  std::size_t outside = 0, at_ones = 0, negative = 0, wrong = 0, first = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const ImagePoint p = places.emplace_back(ImagePoint{rows.at(i, 0), rows.at(i, 1)});
    const bool within = p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1;
    outside += within ? 0 : 1;
    at_ones += !within && (p.x == 1 || p.y == 1) ? 1 : 0;
    negative += p.x < 0 ? 1 : 0;
    if (!place_fits(p, Double3(directions[i])) && wrong++ == 0) first = i;
  }
  std::vector<Diagnosis> why_outside;
  if (negative > 100) {
    why_outside = {negative_azimuth};
  } else if (outside == at_ones) {
    why_outside = {at_one};
  }
  judge(holds("places outside of [0, 1)^2", outside == 0,
              fmt::format("{} of {}", outside, places.size()), "none", why_outside));
  const Double3 w(directions[first]);
  const ImagePoint exact = stands_at(w);
  judge(holds(fmt::format("the place of the direction {}", text(w)), wrong == 0,
              fmt::format("({:.7g}, {:.7g})", places[first].x, places[first].y),
              fmt::format("({:.7g}, {:.7g}), to 1e-6", exact.x, exact.y),
              wrong == 0 ? std::vector<Diagnosis>{} : why_places_are_wrong(places, directions)));
}

TEST_CASE("Lab 7.8: the density is in proportion to the luminance, and integrates to 1",
          "[lab07][ex8]") {
  for (const Sky sky : {Sky::one_texel, Sky::spotted, Sky::half, Sky::sun_bottom, Sky::cap})
    judge_image_density(sky);
}

namespace {

/// The mistake that explains a NaN density at a pole: one division for all directions, or one
/// there.
std::vector<Diagnosis> why_no_number(Sky sky) {
  const SkyImage image = sky_image(sky);
  const std::vector<Vec3> places = density_places(image);
  const Rows rows = probe("Lab 7.8 density", of(sky),
                          {.rows = places.size(), .finite = false, .of = name_of(sky)});
  const std::vector<Double3> directions(places.begin(), places.end());
  return {divides_by_sine(image, directions, rows.values) ? sine_of_direction : sine_at_pole};
}

}  // namespace

TEST_CASE("Lab 7.8: at the poles the density is that of the texel there", "[lab07][ex8]") {
  for (const Sky sky : {Sky::one_texel, Sky::half, Sky::cap}) {
    const SkyImage image = sky_image(sky);
    const Rows rows = probe("Lab 7.8 density at the poles", of(sky),
                            {.columns = 2, .finite = false, .of = name_of(sky)});
    const std::array exact = {density_of(image, 0), density_of(image, image.luminance.size() - 1)};
    for (std::size_t pole = 0; pole < 2; ++pole) {
      judge(
          holds(fmt::format("the density of {} at {}y", name_of(sky), pole == 0 ? '+' : '-'),
                agree(rows.values[pole], exact[pole], 1e-5), number_or_nan(rows.values[pole]),
                number_or_nan(exact[pole]),
                std::isfinite(rows.values[pole]) ? std::vector<Diagnosis>{} : why_no_number(sky)));
    }
  }
}

TEST_CASE("Lab 7.8: texels are drawn by luminance times solid angle, evenly within each",
          "[lab07][ex8]") {
  constexpr std::size_t n = 100'000;
  for (const Sky sky : {Sky::spotted, Sky::one_texel}) {
    const SkyImage image = sky_image(sky);
    const Rows rows = drawn_from(sky, n);
    judge_samples(sky, rows);
    const Landed landed = land(image, rows);
    if (sky == Sky::spotted) judge(texels_verdict(sky, landed, n));
    const bool by_sine = divides_by_sine(image, directions_in(rows), column(rows, 3));
    judge(within_verdict(sky, "azimuths", landed.across, {}, by_sine));
    judge(within_verdict(sky, "heights", landed.down, landed.angles, by_sine));
  }
  const SkyImage cap = sky_image(Sky::cap);
  const Rows in_cap = drawn_from(Sky::cap, 20'000);
  const Landed landed = land(cap, in_cap);
  judge(within_verdict(Sky::cap, "heights", landed.down, landed.angles,
                       divides_by_sine(cap, directions_in(in_cap), column(in_cap, 3))));
}

TEST_CASE("Lab 7.8: a sun of one texel is hit by every u, wherever it stands", "[lab07][ex8]") {
  for (const Sky sky : {Sky::sun_top, Sky::sun_middle, Sky::sun_bottom, Sky::cap, Sky::spotted}) {
    judge_samples(
        sky,
        probe("Lab 7.8 edges", of(sky),
              {.rows = edge_numbers().size(), .columns = 5, .finite = false, .of = name_of(sky)}));
    if (sky != Sky::spotted) judge_samples(sky, drawn_from(sky, 1000));
  }
}

// Where the sun is hidden, all light comes from the sky.
TEST_CASE("Lab 7.8: texels that a sun leaves 1e-9 of the power are drawn as often",
          "[lab07][ex8]") {
  const SkyImage image = sky_image(Sky::glare);
  const std::vector<TexelNumber> numbers = numbers_of_texels(image);
  const std::size_t n = numbers.size();
  const Rows rows =
      probe("Lab 7.8 rare texels", of(Sky::glare),
            {.rows = 2 * n, .columns = 5, .finite = false, .of = name_of(Sky::glare)});
  std::size_t wrong = n, small = 0;
  // Either of the two numbers may decide the row: the second half has them exchanged.
  for (const std::size_t first : {std::size_t{0}, n}) {
    std::size_t wrong_here = 0, small_here = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = first + i;
      const Double3 w(rows.at(k, 0), rows.at(k, 1), rows.at(k, 2));
      const std::size_t texel = texel_place(image, stands_at(w)).index;
      const bool right = texel == numbers[i].texel;
      if (right && agree(rows.at(k, 3), density_of(image, texel), 1e-5)) continue;
      ++wrong_here;
      // A float is precise near 0, and less so near 1.
      small_here += numbers[i].u.x < 0.9 && numbers[i].u.y < 0.9 ? 1 : 0;
    }
    if (first > 0 && wrong_here >= wrong) continue;
    wrong = wrong_here;
    small = small_here;
  }
  judge(holds(fmt::format("the texels of {} that u is in the middle of", name_of(Sky::glare)),
              wrong == 0, fmt::format("{} of {} wrong", wrong, n), "all right",
              small == 0 ? std::vector{float_u} : std::vector<Diagnosis>{}));
}

// E = pi / 2 (1 + cos(tilt)); the variance of one direction's contribution is by quadrature.
TEST_CASE("Lab 7.8: the irradiance under half a sky, on floors that are tilted", "[lab07][ex8]") {
  constexpr std::size_t n = 20'000;
  for (const double tilt : {60.0, 120.0}) {
    const Double3 normal(std::sin(tilt * pi / 180) * 0.6, std::cos(tilt * pi / 180),
                         std::sin(tilt * pi / 180) * 0.8);
    const Rows rows = drawn_from(Sky::half, n);
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
      const Double3 w(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
      values.push_back(w.y > 0 ? std::max(0.0, glm::dot(w, normal)) / rows.at(i, 3) : 0);
    }
    double square = 0;
    over_directions({0, 1, 0}, 1, [&](Double3 w, double solid_angle) {
      const double cosine = std::max(0.0, glm::dot(w, normal));
      square += 2 * pi * cosine * cosine * solid_angle;
    });
    const double exact = pi / 2 * (1 + std::cos(tilt * pi / 180));
    judge(mean_is(fmt::format("the irradiance of a floor tilted by {:g} degrees", tilt), values,
                  {.mean = exact, .sd = std::sqrt(square - exact * exact)}));
  }
}
