// Lab 9: bias and noise of photons, discs that shrink, and irradiance records.

#include "bias.h"
#include "given/sampled.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace site {
namespace {

using namespace lab09;

/// The photons of a point light of intensity 1 at height 1 that land on the floor near its foot,
/// where the irradiance is 1.
PhotonMap map_below(std::int64_t emitted, Rng& rng) {
  std::vector<Photon> photons;
  for (std::int64_t i = 0; i < emitted; ++i) {
    const Emission emission = emit_from_point({0, 0, 1}, Rgb(1), rng);
    const Vec3 d = emission.ray.d;
    if (d.z < -0.1f) photons.push_back({{-d.x / d.z, -d.y / d.z, 0}, -d, emission.flux});
  }
  return {std::move(photons), 1 / static_cast<float>(emitted)};
}

/// The irradiance at the foot from the photons within a radius.
double irradiance_at_foot(const PhotonMap& map, double radius) {
  static const lab08::Material white = carlo::Phong{Rgb(1), Rgb(0), 0};
  const Surface foot{Vec3(0), {0, 0, 1}, {0, 0, 1}, Rgb(0), &white, true, {}};
  const auto one = [](Vec3) { return Rgb(1); };
  return static_cast<double>(radiance_within(map, foot, one, static_cast<float>(radius)).g);
}

/// radius, photons emitted, maps, seed: bias^2 and variance of the irradiance at the foot; both in
/// closed form: the light of a cone, and a binomial number of photons.
Numbers density(const Arguments& given) {
  Rng rng = given.rng(3, 1);
  std::vector<double> estimates;
  for (std::int64_t i = 0; i < given.whole(2); ++i)
    estimates.push_back(irradiance_at_foot(map_below(given.whole(1), rng), given[0]));
  const ErrorParts parts = split_error(estimates, 1);
  const double share = (1 - 1 / std::hypot(1, given[0])) / 2;
  const double mean = 4 * share / (given[0] * given[0]);
  return {parts.bias2, parts.variance, (mean - 1) * (mean - 1),
          mean * mean * (1 - share) / (share * given[1])};
}

/// first radius, alpha (0: the radius stays), passes, photons a pass, runs, seed: bias^2 and
/// variance of the mean over the passes.
Numbers progressive(const Arguments& given) {
  Rng rng = given.rng(5, 2);
  std::vector<double> estimates;
  for (std::int64_t run = 0; run < given.whole(4); ++run) {
    const auto estimate = [&](int, double radius) {
      const double at = given[1] == 0 ? given[0] : radius;
      return Rgb(static_cast<float>(irradiance_at_foot(map_below(given.whole(3), rng), at)));
    };
    const double alpha = given[1] == 0 ? 0.5 : given[1];
    estimates.push_back(static_cast<double>(
        progressive_mean(static_cast<int>(given[2]), given[0], alpha, estimate).g));
  }
  const ErrorParts parts = split_error(estimates, 1);
  return {parts.bias2, parts.variance};
}

/// An image by photons, pass by pass: each with a map of its own and one ray a pixel.
struct PhotonImage {
  World world;
  int size;
  std::uint64_t seed;
  std::int64_t photons;
  double radius, alpha;
  int passes = 0;
  std::vector<glm::dvec3> sums;

  /// From the scene's number, then size, seed, photons a pass, first radius, alpha (0: it stays).
  explicit PhotonImage(const Arguments& given)
      : world(scene_with_film(given.index(0), static_cast<int>(given[1]))),
        size(static_cast<int>(given[1])),
        seed(static_cast<std::uint64_t>(given[2])),
        photons(given.whole(3)),
        radius(given[4]),
        alpha(given[5]),
        sums(given.index(1) * given.index(1)) {}

  void pass() {
    Rng rng(seed, static_cast<std::uint64_t>(++passes));
    std::vector<Photon> stored;
    for (std::int64_t i = 0; i < photons; ++i)
      trace_photon(world, emit_photon(world, rng), rng,
                   [&](const Photon& photon) { stored.push_back(photon); });
    const PhotonMap map(std::move(stored), 1 / static_cast<float>(photons));
    const auto side = static_cast<float>(size);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const float x = rng.uniform_float();
      const float y = rng.uniform_float();
      const std::size_t row = i / static_cast<std::size_t>(size),
                        column = i % static_cast<std::size_t>(size);
      const Ray ray = world.scene().camera.ray(
          {(static_cast<float>(column) + x) / side, (static_cast<float>(row) + y) / side});
      sums[i] += glm::dvec3(photon_radiance(world, ray, map, static_cast<float>(radius), rng));
    }
    if (alpha > 0) radius = next_radius(radius, passes, alpha);
  }
};

std::vector<std::unique_ptr<PhotonImage>> images;

/// scene, size, seed, photons a pass, first radius, alpha, number of the image (it replaces the one
/// of that number).
Numbers start(const Arguments& given) {
  images.resize(std::max(images.size(), given.index(6) + 1));
  images[given.index(6)] = std::make_unique<PhotonImage>(given);
  return {};
}

/// image: one more pass; the radius of the next.
Numbers pass(const Arguments& given) {
  PhotonImage& image = *images.at(given.index(0));
  image.pass();
  return {image.radius};
}

/// image: the mean of its passes, row by row.
Numbers pixels(const Arguments& given) {
  const PhotonImage& image = *images.at(given.index(0));
  Numbers rgb;
  for (const glm::dvec3& sum : image.sums)
    for (int k = 0; k < 3; ++k)
      rgb.push_back(sum[k] / std::max(1, image.passes));
  return rgb;
}

/// The camera's hits of a scene, and the records placed so far.
struct Cached {
  World world;
  int size;
  double most;
  int strata;
  Cache cache;
  Rng rng;
  std::vector<std::optional<Surface>> surfaces;
  std::vector<double> irradiance;  ///< green; black where there is no estimate yet

  /// From the scene's number, then size, the largest error, strata, seed.
  explicit Cached(const Arguments& given)
      : world(scene_with_film(given.index(0), static_cast<int>(given[1]))),
        size(static_cast<int>(given[1])),
        most(given[2]),
        strata(static_cast<int>(given[3])),
        cache(given[2], 0, std::numeric_limits<double>::infinity()),
        rng(given.rng(4, 3)),
        irradiance(given.index(1) * given.index(1)) {
    for (std::size_t i = 0; i < irradiance.size(); ++i)
      surfaces.push_back(world.intersect(ray(i)));
  }

  Ray ray(std::size_t i) const {
    const auto side = static_cast<std::size_t>(size);
    const std::size_t row = i / side, column = i % side;
    return world.scene().camera.ray({(static_cast<float>(column) + 0.5f) / static_cast<float>(size),
                                     (static_cast<float>(row) + 0.5f) / static_cast<float>(size)});
  }

  /// The record of a pixel's surface by `side` squared directions, of indirect light alone.
  Record record(const Surface& surface, int side) {
    return make_record(
        surface.p, surface.n, side,
        [&](Vec3 wi) {
          const Ray ray = world.leave(surface, wi);
          const auto met = world.intersect(ray);
          return Arrival{lab08::trace_specular(world, ray, false, rng),
                         met ? static_cast<double>(glm::length(met->p - ray.o))
                             : std::numeric_limits<double>::infinity()};
        },
        rng);
  }
};

std::vector<std::unique_ptr<Cached>> caches;

/// scene, size, largest error, strata, seed, number of the cache.
Numbers cache_start(const Arguments& given) {
  caches.resize(std::max(caches.size(), given.index(5) + 1));
  caches[given.index(5)] = std::make_unique<Cached>(given);
  return {};
}

/// cache, first pixel, pixels: their irradiance, from records or new ones; the number of records,
/// then the pixels at which one was placed.
Numbers cache_pixels(const Arguments& given) {
  Cached& c = *caches.at(given.index(0));
  Numbers results(1);
  for (std::size_t i = given.index(1); i < given.index(1) + given.index(2); ++i) {
    const auto& surface = c.surfaces[i];
    if (!surface) continue;
    const std::size_t before = c.cache.records().size();
    c.irradiance[i] =
        static_cast<double>(cached_irradiance(c.cache, surface->p, surface->n, c.most, [&] {
                              return c.record(*surface, c.strata);
                            }).g);
    if (c.cache.records().size() > before) results.push_back(static_cast<double>(i));
  }
  results[0] = static_cast<double>(c.cache.records().size());
  return results;
}

Numbers cache_image(const Arguments& given) {
  return caches.at(given.index(0))->irradiance;
}

/// cache, pixel, strata: the irradiance by strata squared directions, without the cache.
Numbers cache_exact(const Arguments& given) {
  Cached& c = *caches.at(given.index(0));
  const auto& surface = c.surfaces.at(given.index(1));
  if (!surface) return {0};
  return {static_cast<double>(c.record(*surface, static_cast<int>(given[2])).E.g)};
}

const Function functions[] = {{"9.density", density},
                              {"9.progressive", progressive},
                              {"9.start", start},
                              {"9.pass", pass},
                              {"9.pixels", pixels},
                              {"9.cache_start", cache_start},
                              {"9.cache_pixels", cache_pixels},
                              {"9.cache_image", cache_image},
                              {"9.cache_exact", cache_exact}};

}  // namespace
}  // namespace site
