#include "given/sampled.h"
#include "photon_run.h"
#include "practice.h"

#include <utility>

namespace lab09 {
namespace practice {
namespace {

/// The settings of the methods; lengths are for rooms of side 2.
constexpr int photons_a_pass = 20000, caustic_photons_a_pass = 5000;
constexpr float photon_radius = 0.03f, caustic_radius = 0.02f, first_radius = 0.06f;
constexpr double radius_alpha = 2.0 / 3;
constexpr double cache_error = 0.25, nearest_reach = 0.05, farthest_reach = 1;
constexpr int cache_strata = 8;

/// The image whose pixels are value(x, y).
template <class Value>
carlo::Image image_of(const PracticeScene& s, const Value& value) {
  carlo::Image image(s.reference.width, s.reference.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = value(x, y);
  }
  return image;
}

/// An image of one ray per pixel; radiance(ray, rng) is the radiance along it.
template <class RayRadiance>
carlo::Image one_ray_each(const PracticeScene& s, Rng rng, const RayRadiance& radiance) {
  return image_of(s, [&](int x, int y) {
    const float across = rng.uniform_float();
    const float down = rng.uniform_float();
    return radiance(s.ray(x, y, {across, down}), rng);
  });
}

/// Passes with their own random numbers; pass(rng) makes the image of one.
template <class Pass>
PracticeMethod by_passes(std::string name, Trend trend, const Pass& pass) {
  return {std::move(name), trend, [pass](int passes, std::uint64_t seed) {
            return mean_of_passes(passes, [&](int number) {
              return pass(Rng(seed, static_cast<std::uint64_t>(number)));
            });
          }};
}

/// Sample `index` of `samples` of lab 8's path tracer.
template <class Sampler>
Rgb path_sample(const PracticeScene& s, int x, int y, std::uint64_t seed, int index, int samples) {
  lab08::Sampled<Sampler> numbers({seed, static_cast<std::uint32_t>(y * s.reference.width + x),
                                   static_cast<std::uint32_t>(index),
                                   static_cast<std::uint32_t>(samples)});
  const Vec2 jitter = numbers.next_2d();
  return lab08::path_radiance(s.world, s.ray(x, y, jitter), 0, numbers);
}

template <class Sampler>
PracticeMethod path_tracing(const PracticeScene& s, std::string name, Trend trend) {
  return {std::move(name), trend, [&s](int passes, std::uint64_t seed) {
            return mean_of_passes(passes, [&](int pass) {
              return image_of(s, [&](int x, int y) {
                return path_sample<Sampler>(s, x, y, seed, pass, passes);
              });
            });
          }};
}

PracticeMethod paths_by_area(const PracticeScene& s) {
  return by_passes("paths, lights by area (8.7)", Trend::unbiased, [&s](Rng rng) {
    return one_ray_each(s, rng, [&](const Ray& ray, Rng& own) {
      return lab08::trace_specular(s.world, ray, true, own);
    });
  });
}

/// One pass, with its own photons.
carlo::Image photon_pass(const PracticeScene& s, Rng rng, float radius) {
  const PhotonMap map = photon_map(s.world, photons_a_pass, Kept::all, rng);
  return one_ray_each(s, rng, [&](const Ray& ray, Rng& own) {
    return photon_radiance(s.world, ray, map, radius, own);
  });
}

PracticeMethod photons(const PracticeScene& s) {
  return by_passes("photon map, one radius", Trend::biased,
                   [&s](const Rng& rng) { return photon_pass(s, rng, photon_radius); });
}

PracticeMethod progressive(const PracticeScene& s) {
  return {"photon map, progressive", Trend::consistent, [&s](int passes, std::uint64_t seed) {
            std::vector<float> radii;
            float radius = first_radius;
            for (int pass = 1; pass <= passes; ++pass) {
              radii.push_back(radius);
              radius =
                  static_cast<float>(next_radius(static_cast<double>(radius), pass, radius_alpha));
            }
            return mean_of_passes(passes, [&](int pass) {
              return photon_pass(s, Rng(seed, static_cast<std::uint64_t>(pass)),
                                 radii[static_cast<std::size_t>(pass)]);
            });
          }};
}

PracticeMethod caustics(const PracticeScene& s) {
  return by_passes("paths and caustic photons", Trend::biased, [&s](Rng rng) {
    const PhotonMap map = photon_map(s.world, caustic_photons_a_pass, Kept::caustics, rng);
    return one_ray_each(s, rng, [&](const Ray& ray, Rng& own) {
      return caustic_radiance(s.world, ray, map, caustic_radius, own);
    });
  });
}

/// The first Phong surface along a ray, behind mirrors and glass.
struct FirstPhong {
  std::optional<Surface> surface;
  Rgb beta{1};
};

FirstPhong first_phong(const World& world, Ray ray, Rng& rng) {
  FirstPhong first;
  for (int i = 0; i < lab08::longest_path; ++i) {
    first.surface = world.intersect(ray);
    if (!first.surface) return first;
    const lab08::Material& material = *first.surface->material;
    lab08::BsdfSample next;
    if (const auto* mirror = std::get_if<carlo::Mirror>(&material)) {
      next = lab08::sample_mirror(*mirror, *first.surface);
    } else if (const auto* glass = std::get_if<carlo::Dielectric>(&material)) {
      next = lab08::sample_glass(*glass, *first.surface, rng.uniform_float());
    } else {
      return first;
    }
    first.beta *= next.weight;
    ray = world.leave(*first.surface, next.wi);
  }
  first.surface.reset();
  return first;
}

/// Direct light by points of the lights, indirect light from the cache; surfaces are diffuse.
Rgb cached_radiance(const World& world, const Ray& ray, Cache& cache, Rng& rng) {
  const FirstPhong first = first_phong(world, ray, rng);
  if (!first.surface) return first.beta * world.environment();
  const Surface& surface = *first.surface;
  const Rgb f = surface.phong().kd / carlo::pi_f;
  const Rgb direct = lab08::direct_by_area(
      world, surface, [&](Vec3) { return f; }, rng);
  if (f == Rgb(0)) return first.beta * surface.Le;
  const Rgb E = cached_irradiance(cache, surface.p, surface.n, cache_error, [&] {
    return make_record(
        surface.p, surface.n, cache_strata,
        [&](Vec3 wi) { return indirect_arrival(world, world.leave(surface, wi), rng); }, rng);
  });
  return first.beta * (surface.Le + direct + f * E);
}

PracticeMethod irradiance_cache(const PracticeScene& s) {
  return by_passes("irradiance cache", Trend::biased, [&s](const Rng& rng) {
    Cache cache(cache_error, nearest_reach, farthest_reach);
    return one_ray_each(s, rng, [&](const Ray& ray, Rng& own) {
      return cached_radiance(s.world, ray, cache, own);
    });
  });
}

PracticeMethod filtered(const PracticeScene& s) {
  return {"paths, filtered", Trend::consistent, [&s](int passes, std::uint64_t seed) {
            return filtered_image(noisy_image(s, passes, seed), {});
          }};
}

}  // namespace
}  // namespace practice

std::vector<PracticeMethod> practice_methods(const PracticeScene& s) {
  using namespace practice;
  return {path_tracing<carlo::IndependentSampler>(s, "path tracing", Trend::unbiased),
          path_tracing<carlo::SobolSampler>(s, "path tracing, Sobol'", Trend::unbiased),
          filtered(s),
          photons(s),
          progressive(s),
          paths_by_area(s),
          caustics(s),
          irradiance_cache(s)};
}

}  // namespace lab09
