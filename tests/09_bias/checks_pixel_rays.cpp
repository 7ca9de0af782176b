// Checks of exercise 9.2: how pixels combine their rays. The rays' radiances follow from the
// probe's seed, and so does the pixel's value, once the rays' positions are known.

#include "09_bias/pixel_rays.h"
#include "grader/judge/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace lab09_pixels {

using namespace carlo::grader;

namespace {

const Diagnosis too_few_rays{"wrong-number-of-rays", "a pixel asks for `samples` rays, each once."};
const Diagnosis from_pixel_corner{"pixel-corner-for-middle",
                                  "offsets are added to the pixel's corner; its middle is at "
                                  "x + 1/2 and y + 1/2."};
const Diagnosis kept_on_film{"rays-kept-on-film",
                             "rays that should leave the film are kept on it."};
const Diagnosis miss_pixel{"filtered-rays-miss-the-pixel",
                           "rays go elsewhere: the pixel's middle and the offset are added, then "
                           "divided by width and height."};
const Diagnosis pixel_upside_down{"filtered-pixels-upside-down",
                                  "y counts from the top, and so does the film's second "
                                  "coordinate."};
const Diagnosis one_offset{"one-offset-for-all-rays",
                           "all rays go through one point: each needs its own offset."};
const Diagnosis rays_uniform{"rays-uniform-in-square",
                             "rays are uniform in the filter's square; filtered_pixel() draws them "
                             "from the filter."};
const Diagnosis rays_filtered{
    "weighted-rays-from-filter",
    "offsets that are drawn from the filter are also weighted by it: it counts twice."};
const Diagnosis in_pixel_only{"offsets-in-pixel-only",
                              "offsets stay within the pixel; the filter reaches beyond it."};
const Diagnosis rays_on_diagonal{"rays-on-diagonal",
                                 "across and down come from one random number."};
const Diagnosis weighed_twice{"filter-weighed-twice",
                              "the filter is already the rays' density; it must not be a weight "
                              "as well."};
const Diagnosis pixel_not_divided{"pixel-sum-not-mean", "the sum is returned, not the mean."};
const Diagnosis wrong_divisor{"pixel-divided-by-other-number",
                              "the sum is not divided by the number of its rays."};
const Diagnosis one_ray_only{"pixel-one-ray-only",
                             "only one ray is used, and the others are lost."};
const Diagnosis not_weighed{"rays-not-weighed",
                            "rays are not weighted by the filter: they are uniform in its square."};
const Diagnosis by_number{"weights-divided-by-number",
                          "the weighted sum is divided by the number of rays; it should be the "
                          "sum of the weights."};
const Diagnosis by_area{"weights-by-known-sum",
                        "the sum is divided by the expected sum of the weights: that is "
                        "unbiased, but another estimate. Divide by the sum of these rays' "
                        "weights."};
const Diagnosis weights_squared{"weights-squared", "the weights are squared."};
const Diagnosis weights_not_divided{"weights-not-divided",
                                    "the weighted sum is not divided by the sum of the weights."};
const Diagnosis one_axis{"weight-of-one-axis",
                         "the weight is the filter's curve along one axis; it is the product of "
                         "both."};
const Diagnosis other_weights{"weights-of-other-places",
                              "the weights are not those of the places that the rays go through."};
const Diagnosis nothing_over_nothing{"zero-over-zero",
                                     "where the weights add up to 0 the result is 0 by contract, "
                                     "and not 0/0."};

// Places ------------------------------------------------------------------------------------------

std::vector<Diagnosis> of_places(const RaysAnswer& answer) {
  if (!answer.offsets_right) return {};
  const FilterCase& filter = answer.filter;
  if (all_offsets(answer, [&](PixelPoint p) { return within(filter, {p.x + 0.5, p.y + 0.5}); }))
    return {from_pixel_corner};
  // The film's bottom is 1/2 below the middle of its last row.
  constexpr double turned = 2 * corner_y + 1 - film_height;
  if (all_offsets(answer, [&](PixelPoint p) { return within(filter, {p.x, -p.y - turned}); }))
    return {pixel_upside_down};
  return {miss_pixel};
}

/// Checks that rays stay in the filter's square and fill it, even beyond the film's edges.
void judge_square(const RaysAnswer& answer, const std::string& of) {
  const bool in_square =
      all_offsets(answer, [&](PixelPoint p) { return within(answer.filter, p); });
  judge(is_so("rays within the filter's square" + of, in_square, "some beyond it", "all",
              in_square ? std::vector<Diagnosis>{} : of_places(answer)));
  const bool on_film = all_on_film(answer);
  const bool in_pixel = on_film && all_offsets(answer, [](PixelPoint p) {
                          return p.x <= 0.5 + place_rounding && p.y >= -0.5 - place_rounding;
                        });
  judge(is_so("rays off the film, of a pixel in its corner" + of, !on_film, "none", "some",
              {one_place(answer) ? one_offset
               : in_pixel        ? in_pixel_only
                                 : kept_on_film}));
}

/// True if the mean square of the offsets is near this: to six standard deviations of a tent.
bool spread_is(const RaysAnswer& answer, double square) {
  double sum = 0;
  for (const PixelPoint p : answer.offsets)
    sum += (p.x * p.x + p.y * p.y) / (2 * static_cast<double>(answer.count()));
  return std::abs(sum - square) < 0.12 * square;
}

/// Judges the distribution of the positions, which should be that of `filter`. `others`: the
/// diagnosis if the spread is that of another.
void judge_spread(const RaysAnswer& answer, const FilterCase& filter, const std::string& of,
                  const std::vector<std::pair<double, Diagnosis>>& others) {
  std::vector<double> shares, products;
  bool diagonal = true;
  for (const PixelPoint p : answer.offsets) {
    const double x = share_before(filter, p.x), y = share_before(filter, p.y);
    shares.push_back(x);
    shares.push_back(y);
    products.push_back((2 * x - 1) * (2 * y - 1));
    diagonal = diagonal && std::abs(p.x - p.y) < 2 * place_rounding;
  }
  const bool in_square =
      all_offsets(answer, [&](PixelPoint p) { return within(answer.filter, p); });
  std::vector<Diagnosis> told;
  for (const auto& [square, diagnosis] : others) {
    if (told.empty() && in_square && spread_is(answer, square)) told = {diagnosis};
  }
  if (one_place(answer)) told = {one_offset};
  if (!answer.offsets_right) told.clear();
  Verdict places = uniform_on("the filter's share before a ray's place" + of, shares, 0, 1);
  if (!places.passed && !diagonal) places.diagnoses = told;
  judge(places);
  // The product of two independent uniform numbers of [-1, 1].
  Verdict pairs = mean_is("both shares' product" + of, products,
                          {.mean = 0, .sd = 1.0 / 3, .excess_kurtosis = 0.24});
  if (!pairs.passed && answer.offsets_right)
    pairs.diagnoses = diagonal && !one_place(answer) ? std::vector{rays_on_diagonal} : told;
  judge(pairs);
}

double filter_square(const FilterCase& filter) {
  double sum = 0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const double x = filter.radius * (2 * (i + 0.5) / steps - 1);
    sum += x * x * curve_shape(filter, x);
  }
  return sum * 2 * filter.radius / steps / shape_area(filter);
}

// Values ------------------------------------------------------------------------------------------

/// Sums over the rays, each weighted by weight(offset). Positions that rounding put beyond the
/// radius count as on it.
template <class Weight>
std::array<double, 4> weighed_sums(const RaysAnswer& answer, const Weight& weight) {
  std::array<double, 4> sums{};
  for (std::size_t i = 0; i < answer.count(); ++i) {
    PixelPoint p = answer.offsets[i];
    if (within(answer.filter, p)) {
      const double r = answer.filter.radius;
      p = {std::clamp(p.x, -r, r), std::clamp(p.y, -r, r)};
    }
    const double w = weight(p);
    sums[0] += w * answer.radiances[i].r;
    sums[1] += w * answer.radiances[i].g;
    sums[2] += w * answer.radiances[i].b;
    sums[3] += w;
  }
  return sums;
}

bool same(const std::array<double, 3>& pixel, const std::array<double, 4>& sums, double divisor) {
  for (std::size_t c = 0; c < 3; ++c) {
    const double should = sums[c] / divisor;
    if (!(std::abs(pixel[c] - should) <= 2e-4 * std::abs(should))) return false;
  }
  return true;
}

std::string rgb_text(const std::array<double, 3>& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
}

std::vector<Diagnosis> of_pixel(const RaysAnswer& answer, bool weighted) {
  const auto n = static_cast<double>(answer.count());
  const FilterCase& filter = answer.filter;
  const auto density = [&](PixelPoint p) { return filter_density(filter, p.x, p.y); };
  const auto plain = weighed_sums(answer, [](PixelPoint) { return 1.0; });
  const auto once = weighed_sums(answer, density);
  const auto twice = weighed_sums(answer, [&](PixelPoint p) { return density(p) * density(p); });
  const auto across = weighed_sums(answer, [&](PixelPoint p) { return curve_shape(filter, p.x); });
  const auto down = weighed_sums(answer, [&](PixelPoint p) { return curve_shape(filter, p.y); });
  const auto is = [&](const std::array<double, 4>& sums, double divisor) {
    return same(answer.pixel, sums, divisor);
  };
  if (is(plain, 1)) return {pixel_not_divided};
  if (is(plain, n)) return {not_weighed};
  if (n > 1 && (is(plain, n - 1) || is(plain, n + 1))) return {wrong_divisor};
  for (const std::size_t i : {std::size_t{0}, answer.count() - 1}) {
    const RayRadiance& b = answer.radiances[i];
    if (is({b.r, b.g, b.b, 1}, 1) || is({b.r, b.g, b.b, 1}, n)) return {one_ray_only};
  }
  if (!weighted) {
    if (is(once, n) || is(once, once[3]) || is(once, 1)) return {weighed_twice};
    return {};
  }
  // A wrong filter_value() is judged elsewhere.
  std::size_t next = 0;
  const auto own = weighed_sums(answer, [&](PixelPoint) { return answer.own_values[next++]; });
  if (is(own, own[3])) return {};
  // A single weight has too many explanations.
  if (n == 1) return {};
  const double square = 4 * filter.radius * filter.radius;
  if (is(once, 1)) return {weights_not_divided};
  if (is(once, n)) return {by_number};
  if (is(once, n / square)) return {by_area};
  if (is(twice, twice[3]) || is(twice, once[3])) return {weights_squared};
  if (is(across, across[3]) || is(down, down[3])) return {one_axis};
  const bool placed_right = answer.count() >= 64 && !all_on_film(answer) &&
                            all_offsets(answer, [&](PixelPoint p) { return within(filter, p); });
  if (placed_right &&
      std::abs(answer.pixel[0] - answer.radiances[0].r) < 1e-4 * answer.radiances[0].r)
    return {other_weights};
  return {};
}

/// Judges the number of rays and the pixel's value.
void judge_pixel(const RaysAnswer& answer, bool weighted, const std::string& of) {
  const auto n = static_cast<double>(answer.count());
  const bool counted_right = answer.rays == n;
  judge(holds("rays" + of, counted_right, number_in_report(answer.rays), number_in_report(n),
              {too_few_rays}));
  const auto sums = weighed_sums(answer, [&](PixelPoint p) {
    // A single ray decides, whatever its weight.
    return weighted && answer.count() > 1 ? filter_density(answer.filter, p.x, p.y) : 1.0;
  });
  const bool right = same(answer.pixel, sums, sums[3]);
  judge(holds("what the pixel makes of its rays" + of, right, rgb_text(answer.pixel),
              rgb_text({sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]}),
              right           ? std::vector<Diagnosis>{}
              : counted_right ? of_pixel(answer, weighted)
                              : std::vector{too_few_rays}));
}

constexpr std::int64_t many_rays = 2000;

}  // namespace

TEST_CASE("Lab 9.2: rays of a filtered pixel are drawn from the filter", "[lab09][ex2]") {
  for (std::size_t number = 0; number < plain_filters; ++number) {
    RaysAnswer answer = rays_answer(number, false, many_rays);
    answer.offsets_right = offsets_are_right(number);
    const std::string of = ", by " + curve_of(answer.filter);
    judge_square(answer, of);
    // A box is uniform.
    const double uniform = answer.filter.radius * answer.filter.radius / 3;
    using Spreads = std::vector<std::pair<double, Diagnosis>>;
    judge_spread(answer, answer.filter, of,
                 number == box_curve ? Spreads{} : Spreads{{uniform, rays_uniform}});
  }
}

TEST_CASE("Lab 9.2: a filtered pixel is the mean over its rays", "[lab09][ex2]") {
  for (const std::int64_t n : {1, 5, 64}) {
    const RaysAnswer answer = rays_answer(1, false, n);
    judge_pixel(answer, false, fmt::format(", of {}", counted(static_cast<double>(n), "ray")));
  }
}

TEST_CASE("Lab 9.2: rays of a weighted pixel are uniform in the filter's square", "[lab09][ex2]") {
  const RaysAnswer answer = rays_answer(1, true, many_rays);
  judge_square(answer, "");
  judge_spread(answer, {box_curve, answer.filter.radius, 1}, "",
               {{filter_square(answer.filter), rays_filtered}});
}

TEST_CASE("Lab 9.2: a weighted pixel is divided by the sum of its weights", "[lab09][ex2]") {
  for (const std::size_t filter : {std::size_t{1}, std::size_t{2}}) {
    // With fewer than 8 rays the weights of a tent may all be so small that the rounding of
    // positions shows.
    for (const std::int64_t n : {1, 8, 64}) {
      const RaysAnswer answer = rays_answer(filter, true, n);
      judge_pixel(answer, true,
                  fmt::format(", of {}, {}", counted(static_cast<double>(n), "ray"),
                              name_of(answer.filter)));
    }
  }
  const Rows rows =
      probe("Lab 9.2 nothing", {.numbers = {{"filter", 1}, {"weighted", 1}, {"x", 3}, {"y", 3}}},
            {.rows = 1, .columns = 3, .finite = false, .of = "no rays"});
  const bool zero = rows.values[0] == 0 && rows.values[1] == 0 && rows.values[2] == 0;
  judge(is_so("a weighted pixel without rays", zero, number_in_report(rows.values[0]), "0",
              {nothing_over_nothing}));
}

TEST_CASE("Lab 9.2: an edge, filtered without bias", "[lab09][ex2]") {
  constexpr int samples = 4;
  for (std::size_t number = 0; number < plain_filters; ++number) {
    const Answer rows = probe("Lab 9.2 edges",
                              {.n = 2000,
                               .numbers = {{"filter", static_cast<double>(number)},
                                           {"weighted", 0},
                                           {"samples", samples},
                                           {"x", 5},
                                           {"y", 6}}},
                              {.rows = 2000, .columns = 1, .of = "an edge, filtered"});
    const FilterCase filter = drawn_filters(rows.seed).at(number);
    const double lit = share_beyond(filter, drawn_edge(rows.seed) * filter.radius);
    judge(mean_is("an edge, by " + curve_of(filter), rows.values,
                  {.mean = lit, .sd = std::sqrt(lit * (1 - lit) / samples)}));
  }
}

TEST_CASE("Lab 9.2: an edge, weighed with the bias that one and two rays have", "[lab09][ex2]") {
  for (const int samples : {1, 2}) {
    const Answer rows = probe(
        "Lab 9.2 edges",
        {.n = 6000,
         .numbers = {{"filter", 1}, {"weighted", 1}, {"samples", samples}, {"x", 5}, {"y", 6}}},
        {.rows = 6000, .columns = 1, .of = "an edge, weighed"});
    const WeightedEdge theory = weighted_edge(drawn_edge(rows.seed), samples);
    judge(
        mean_is(fmt::format("a weighted pixel of {}", counted(samples, "ray")), rows.values,
                {.mean = theory.mean, .sd = std::sqrt(theory.square - theory.mean * theory.mean)}));
  }
}

}  // namespace lab09_pixels
