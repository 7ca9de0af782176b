// Checks of exercise 9.5: radiance from photons at one point. The photons follow from the probe's
// seed, so the right result is known, and so are those of the usual mistakes.

#include "09_bias/density_checks.h"

#include <functional>
#include <numbers>

namespace lab09_density {

using namespace carlo::grader;

namespace {

const Diagnosis cosine_multiplied{"cosine-multiplied",
                                  "the sum includes a cosine: the density of photons already has "
                                  "it, since a slanted beam spreads over more surface."};
const Diagnosis cosine_divided{"cosine-divided",
                               "photons are divided by their cosine, but the irradiance needs no "
                               "correction."};
const Diagnosis other_side{"other-side-counted",
                           "photons that arrived on the surface's other side are counted, too."};
const Diagnosis wrong_side{"wrong-side",
                           "the photons of the surface's other side are counted instead of its "
                           "own: wi points to where the light came from."};
const Diagnosis brdf_missing{"brdf-missing", "the BRDF is missing: this is the irradiance."};
const Diagnosis brdf_of_wo{"brdf-of-wo",
                           "the BRDF is called with wo; it already has wo and needs the photon's "
                           "wi."};
const Diagnosis brdf_reversed{
    "brdf-of-minus-wi", "the BRDF is called with -wi; wi points to where the photon came from."};
const Diagnosis flux_missing{"flux-missing",
                             "photons are only counted; each contributes its flux, in three "
                             "channels."};
const Diagnosis area_missing{"area-missing",
                             "this is reflected flux: for radiance divide by the area on which "
                             "the photons arrived."};
const Diagnosis pi_missing{"pi-missing", "the disc's area lacks the factor pi."};
const Diagnosis not_squared{"radius-not-squared",
                            "the disc's area needs the square of the radius."};
const Diagnosis ball_volume{"volume-of-a-ball",
                            "photons are divided by a ball's volume; they lie on a surface, a "
                            "disc."};
const Diagnosis ball_surface{"surface-of-a-ball",
                             "photons are divided by a ball's surface; they lie on a disc."};
const Diagnosis mean_taken{"mean-of-the-photons",
                           "the sum is divided by the number of photons: more photons are more "
                           "light."};
const Diagnosis map_size{"divided-by-map-size",
                         "the sum is divided by the number of photons in the map: each flux is "
                         "already its share of the total."};
const Diagnosis squared_search{"searched-within-radius-squared",
                               "within() wants the radius, not its square."};
const Diagnosis emission_added{"emission-added",
                               "the surface's emission is added: it is not reflected light."};
const Diagnosis some_left_out{"photons-left-out",
                              "photons are left out because of the surfaces they met before; all "
                              "photons of the map count."};
const Diagnosis kth_counted{"k-th-photon-counted",
                            "k photons are summed: the k-th only determines the size of the "
                            "disc; including it makes the mean k/(k - 1) times too large."};
const Diagnosis smaller_disc{"disc-of-k-minus-1",
                             "the disc ends at the last photon of the sum: it should end at the "
                             "k-th, which is not in the sum."};
const Diagnosis k_rescaled{"scaled-by-k",
                           "the sum of k - 1 photons is scaled up to k: it is unbiased without "
                           "that."};
const Diagnosis fewer_counted{"fewer-than-k-counted",
                              "fewer than k photons give a radiance: they do not determine the "
                              "size of the disc, and the contract requires 0 then."};
const Diagnosis nothing_is_nan{"nothing-is-not-0", "where no photon lies the radiance is 0."};

/// The term that is summed for each photon, and the divisor of the sum.
struct Recipe {
  Diagnosis diagnosis;
  std::function<DensityVec(const DensityPhoton&, double cosine)> term;
  std::function<double(double radius, double photons)> divisor;
};

DensityVec flux_of(const DensityPhoton& photon) {
  return {photon.flux};
}

DensityVec term_of(const DensityPhoton& photon, double cosine) {
  return cosine > 0 ? DensityVec(density_brdf(photon.wi)) * flux_of(photon) : DensityVec(0);
}

double area_of(double radius, double) {
  return std::numbers::pi * radius * radius;
}

const Recipe right_recipe{{}, term_of, area_of};

std::vector<Recipe> wrong_terms() {
  const auto brdf = [](Vec3 wi) { return DensityVec(density_brdf(wi)); };
  const auto with_term = [](const Diagnosis& diagnosis, auto term) {
    return Recipe{diagnosis,
                  [term](const DensityPhoton& photon, double cosine) {
                    return cosine > 0 ? term(photon, cosine) : DensityVec(0);
                  },
                  area_of};
  };
  return {
      with_term(cosine_multiplied,
                [](const DensityPhoton& p, double c) { return term_of(p, c) * c; }),
      with_term(cosine_divided, [](const DensityPhoton& p, double c) { return term_of(p, c) / c; }),
      with_term(brdf_missing, [](const DensityPhoton& p, double) { return flux_of(p); }),
      with_term(brdf_of_wo,
                [=](const DensityPhoton& p, double) { return brdf(density_wo) * flux_of(p); }),
      with_term(brdf_reversed,
                [=](const DensityPhoton& p, double) { return brdf(-p.wi) * flux_of(p); }),
      with_term(flux_missing, [=](const DensityPhoton& p, double) { return brdf(p.wi); }),
      with_term(some_left_out,
                [](const DensityPhoton& p, double c) {
                  return p.phong == 0 && p.specular > 0 ? term_of(p, c) : DensityVec(0);
                }),
      with_term(some_left_out,
                [](const DensityPhoton& p, double c) {
                  return p.phong > 0 ? term_of(p, c) : DensityVec(0);
                }),
      {other_side, [](const DensityPhoton& p, double) { return term_of(p, 1); }, area_of},
      {wrong_side, [](const DensityPhoton& p, double c) { return term_of(p, -c); }, area_of}};
}

std::vector<Recipe> recipes() {
  std::vector<Recipe> all = wrong_terms();
  const auto with_divisor = [&](const Diagnosis& diagnosis, auto divisor) {
    all.push_back({diagnosis, term_of, divisor});
  };
  const double pi = std::numbers::pi;
  with_divisor(area_missing, [](double, double) { return 1.0; });
  with_divisor(pi_missing, [](double r, double) { return r * r; });
  with_divisor(not_squared, [pi](double r, double) { return pi * r; });
  with_divisor(ball_volume, [pi](double r, double) { return 4 / 3.0 * pi * r * r * r; });
  with_divisor(ball_surface, [pi](double r, double) { return 4 * pi * r * r; });
  with_divisor(mean_taken, [pi](double r, double photons) { return pi * r * r * photons; });
  with_divisor(mean_taken, [](double, double photons) { return photons; });
  with_divisor(map_size, [pi](double r, double) { return pi * r * r * density_photons; });
  return all;
}

double distance_of(const DensityPhoton& photon, const DensityPlace& place) {
  return glm::length(DensityVec(photon.p) - DensityVec(place.at));
}

/// Sums the photons nearer than `radius`, over the disc of this or another radius.
DensityVec estimate(const Recipe& recipe, const std::vector<DensityPhoton>& photons,
                    double disc_radius) {
  DensityVec sum(0);
  double counted = 0;
  for (const DensityPhoton& photon : photons) {
    const double cosine = cosine_of(photon, DensityVec(density_normal));
    counted += cosine > 0 ? 1 : 0;
    sum += recipe.term(photon, cosine);
  }
  return sum / recipe.divisor(disc_radius, counted);
}

std::vector<DensityPhoton> nearer_than(const std::vector<DensityPhoton>& photons,
                                       const DensityPlace& place, double radius) {
  std::vector<DensityPhoton> some;
  for (const DensityPhoton& photon : photons) {
    if (distance_of(photon, place) < radius) some.push_back(photon);
  }
  return some;
}

/// The photons of all places, nearest first.
std::vector<std::vector<DensityPhoton>> photons_of_places(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<std::vector<DensityPhoton>> all;
  for (const DensityPlace& place : density_places) {
    all.push_back(drawn_photons(rng, density_photons, place.at, density_normal, place.radius));
    std::sort(all.back().begin(), all.back().end(),
              [&](const DensityPhoton& a, const DensityPhoton& b) {
                return distance_of(a, place) < distance_of(b, place);
              });
  }
  return all;
}

/// The results of `value(place, photons)` for all places.
std::vector<DensityVec> at_places(
    std::uint64_t seed, const std::function<void(const DensityPlace&, std::vector<DensityPhoton>,
                                                 std::vector<DensityVec>&)>& add) {
  const auto photons = photons_of_places(seed);
  std::vector<DensityVec> values;
  for (std::size_t i = 0; i < photons.size(); ++i)
    add(density_places[i], photons[i], values);
  return values;
}

constexpr const char* density_place_names[] = {"far from the origin", "within a radius of 1e-9",
                                               "within a radius of 5000"};

}  // namespace

TEST_CASE("Lab 9.5: radiance from the photons within a radius", "[lab09][ex5]") {
  const Answer rows = probe("Lab 9.5 within", {},
                            {.rows = density_places.size() + 2,
                             .columns = 3,
                             .finite = false,
                             .of = "photons around a point"});
  const auto by = [&](const Recipe& recipe, double searched_power) {
    return at_places(rows.seed, [&](const DensityPlace& place, const auto& photons, auto& values) {
      const auto r = static_cast<double>(place.radius);
      values.push_back(
          estimate(recipe, nearer_than(photons, place, std::pow(r, searched_power)), r));
    });
  };
  std::vector<DensityVec> are = radiances(rows);
  const DensityVec none = are[density_places.size()], far = are[density_places.size() + 1];
  are.resize(density_places.size());
  std::vector<Reading> readings;
  for (const Recipe& recipe : recipes())
    readings.push_back({recipe.diagnosis, by(recipe, 1)});
  readings.push_back({squared_search, by(right_recipe, 2)});
  std::vector<DensityVec> glowing = by(right_recipe, 1);
  for (DensityVec& value : glowing)
    value += DensityVec(density_glow);
  readings.push_back({emission_added, glowing});
  judge_radiances(are, by(right_recipe, 1),
                  {density_place_names, density_place_names + std::size(density_place_names)},
                  readings);
  const auto nothing = [&](const std::string& what, DensityVec is) {
    std::vector<Diagnosis> found = {nothing_is_nan};
    if (same_radiance(is, DensityVec(density_glow))) found = {emission_added};
    judge(holds(what, is == DensityVec(0), radiance_text(is), "0", found));
  };
  nothing("the radiance from an empty map", none);
  nothing("the radiance where all photons are beyond the radius", far);
}

TEST_CASE("Lab 9.5: radiance from the nearest photons", "[lab09][ex5]") {
  const std::size_t asked = density_places.size() * density_counts.size();
  const Answer rows =
      probe("Lab 9.5 nearest", {},
            {.rows = asked + 2, .columns = 3, .finite = false, .of = "the nearest photons of 60"});
  // `counted` photons of k, and the disc that ends at number `last` of them.
  const auto by = [&](const Recipe& recipe, std::size_t uncounted, std::size_t before,
                      double scale_power = 0) {
    return at_places(rows.seed, [&](const DensityPlace& place, const auto& photons, auto& values) {
      for (const int count : density_counts) {
        const auto k = static_cast<std::size_t>(count);
        const std::vector<DensityPhoton> some(
            photons.begin(), photons.begin() + static_cast<std::ptrdiff_t>(k - uncounted));
        const double scale = std::pow(count / (count - 1.0), scale_power);
        values.push_back(scale *
                         estimate(recipe, some, distance_of(photons[k - 1 - before], place)));
      }
    });
  };
  std::vector<std::string> names;
  for (const char* place : density_place_names) {
    for (const int k : density_counts)
      names.push_back(fmt::format("{}, k = {}", place, k));
  }
  std::vector<DensityVec> are = radiances(rows);
  const DensityVec fewer = are[asked], none = are[asked + 1];
  are.resize(asked);
  std::vector<Reading> readings = {{kth_counted, by(right_recipe, 0, 0)},
                                   {smaller_disc, by(right_recipe, 1, 1)},
                                   {k_rescaled, by(right_recipe, 1, 0, 1)},
                                   {k_rescaled, by(right_recipe, 0, 0, 1)}};
  for (const Recipe& recipe : recipes())
    readings.push_back({recipe.diagnosis, by(recipe, 1, 0)});
  std::vector<DensityVec> glowing = by(right_recipe, 1, 0);
  for (DensityVec& value : glowing)
    value += DensityVec(density_glow);
  readings.push_back({emission_added, glowing});
  judge_radiances(are, by(right_recipe, 1, 0), names, readings);
  const auto nothing = [&](const std::string& what, DensityVec is, const Diagnosis& otherwise) {
    judge(holds(what, is == DensityVec(0), radiance_text(is), "0",
                {std::isnan(is.r) ? nothing_is_nan : otherwise}));
  };
  nothing("the radiance from 61 of 60 photons", fewer, fewer_counted);
  nothing("the radiance from 2 of no photons", none, nothing_is_nan);
}

TEST_CASE("Lab 9.5: both are unbiased where photons lie uniformly", "[lab09][ex5]") {
  constexpr std::size_t maps = 3'000;
  const Rows rows = probe("Lab 9.5 uniform", {.n = maps},
                          {.rows = maps, .columns = 2, .finite = true, .of = "uniform photons"});
  constexpr double k = uniform_nearest, n = uniform_photons;
  // The fraction of the disc up to the k-th photon has the density Beta(k, n - k + 1).
  judge(mean_is("the radiance from the 12 nearest of 60 uniform photons", column(rows, 0),
                {1, std::sqrt((n - k + 1) / (n * (k - 2)))},
                {{k / (k - 1), kth_counted},
                 {k / (k - 1), k_rescaled},
                 {k / (k - 1) * k / (k - 1), k_rescaled},
                 {(k - 1) / (k - 2), smaller_disc}}));
  const auto r = static_cast<double>(uniform_radius);
  judge(mean_is("the radiance from uniform photons within a radius", column(rows, 1),
                {1, std::sqrt((1 - r * r) / (n * r * r))}));
}

}  // namespace lab09_density
