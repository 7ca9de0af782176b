#include "given/sampled.h"
#include "noisy_image.h"
#include "practice.h"

#include <cmath>
#include <utility>

namespace lab09 {
namespace practice {
namespace {

/// What the methods are set to; lengths are for rooms of side 2.
constexpr int photons_a_pass = 20000, caustic_photons_a_pass = 5000;
constexpr float photon_radius = 0.03f, caustic_radius = 0.02f, first_radius = 0.06f;
constexpr double radius_alpha = 2.0 / 3;
constexpr double cache_error = 0.25, nearest_reach = 0.05, farthest_reach = 1;
constexpr int cache_strata = 8;

const carlo::Scene& scene_of(const PracticeScene& s) {
  return s.world.scene();
}

Ray film_ray(const PracticeScene& s, int x, int y, Vec2 jitter) {
  const carlo::Scene& scene = scene_of(s);
  return scene.camera.ray({(static_cast<float>(x) + jitter.x) / static_cast<float>(scene.width),
                           (static_cast<float>(y) + jitter.y) / static_cast<float>(scene.height)});
}

Ray film_ray(const PracticeScene& s, int x, int y, Rng& rng) {
  const float across = rng.uniform_float();
  const float down = rng.uniform_float();
  return film_ray(s, x, y, {across, down});
}

using PixelValue = std::function<Rgb(int x, int y, Rng& rng)>;

/// An image of one ray a pixel.
carlo::Image one_ray_each(const PracticeScene& s, Rng rng, const PixelValue& value) {
  carlo::Image image(s.reference.width, s.reference.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = value(x, y, rng);
  }
  return image;
}

/// Sample `index` of `samples` of lab 08's path tracer.
template <class Sampler>
Rgb path_sample(const PracticeScene& s, int x, int y, std::uint64_t seed, int index, int samples) {
  lab08::Sampled<Sampler> numbers({seed, static_cast<std::uint32_t>(y * s.reference.width + x),
                                   static_cast<std::uint32_t>(index),
                                   static_cast<std::uint32_t>(samples)});
  const Vec2 jitter = numbers.next_2d();
  return lab08::path_radiance(s.world, film_ray(s, x, y, jitter), 0, numbers);
}

template <class Sampler>
PracticeMethod path_tracing(const PracticeScene& s, std::string name, Trend trend) {
  return {std::move(name), trend, [&s](int passes, std::uint64_t seed) {
            return mean_of_passes(passes, [&](int pass) {
              return one_ray_each(s, Rng(seed), [&](int x, int y, Rng&) {
                return path_sample<Sampler>(s, x, y, seed, pass, passes);
              });
            });
          }};
}

PracticeMethod paths_by_area(const PracticeScene& s) {
  return {"paths, lights by area (8.7)", Trend::unbiased, [&s](int passes, std::uint64_t seed) {
            return mean_of_passes(passes, [&](int pass) {
              return one_ray_each(s, Rng(seed, static_cast<std::uint64_t>(pass)),
                                  [&](int x, int y, Rng& own) {
                                    const Ray ray = film_ray(s, x, y, own);
                                    return lab08::trace_specular(s.world, ray, true, own);
                                  });
            });
          }};
}

/// A map of all photons, or of caustic ones alone; so many are emitted.
PhotonMap photon_map(const PracticeScene& s, bool caustics, int emitted, Rng& rng) {
  std::vector<Photon> photons;
  for (int i = 0; i < emitted; ++i) {
    trace_photon(s.world, emit_photon(s.world, rng), rng, [&](const Photon& photon) {
      if (!caustics || photon.caustic()) photons.push_back(photon);
    });
  }
  return {std::move(photons), 1.0f / static_cast<float>(emitted)};
}

/// A pass has photons of its own.
carlo::Image photon_pass(const PracticeScene& s, std::uint64_t seed, int pass, float radius) {
  Rng rng(seed, static_cast<std::uint64_t>(pass));
  const PhotonMap map = photon_map(s, false, photons_a_pass, rng);
  return one_ray_each(s, rng, [&](int x, int y, Rng& own) {
    const Ray ray = film_ray(s, x, y, own);
    return photon_radiance(s.world, ray, map, radius, own);
  });
}

PracticeMethod photons(const PracticeScene& s) {
  return {"photon map, one radius", Trend::biased, [&s](int passes, std::uint64_t seed) {
            return mean_of_passes(
                passes, [&](int pass) { return photon_pass(s, seed, pass, photon_radius); });
          }};
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
              return photon_pass(s, seed, pass, radii[static_cast<std::size_t>(pass)]);
            });
          }};
}

PracticeMethod caustics(const PracticeScene& s) {
  return {"paths and caustic photons", Trend::biased, [&s](int passes, std::uint64_t seed) {
            return mean_of_passes(passes, [&](int pass) {
              Rng rng(seed, static_cast<std::uint64_t>(pass));
              const PhotonMap map = photon_map(s, true, caustic_photons_a_pass, rng);
              return one_ray_each(s, rng, [&](int x, int y, Rng& own) {
                const Ray ray = film_ray(s, x, y, own);
                return caustic_radiance(s.world, ray, map, caustic_radius, own);
              });
            });
          }};
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

/// Light that has been reflected before it arrives, or has come through mirrors or glass.
Arrival indirect_arrival(const World& world, const Ray& ray, Rng& rng) {
  const auto met = world.intersect(ray);
  const double distance = met ? static_cast<double>(glm::length(met->p - ray.o)) : INFINITY;
  return {lab08::trace_specular(world, ray, false, rng), distance};
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
  return {"irradiance cache", Trend::biased, [&s](int passes, std::uint64_t seed) {
            return mean_of_passes(passes, [&](int pass) {
              Cache cache(cache_error, nearest_reach, farthest_reach);
              return one_ray_each(s, Rng(seed, static_cast<std::uint64_t>(pass)),
                                  [&](int x, int y, Rng& own) {
                                    const Ray ray = film_ray(s, x, y, own);
                                    return cached_radiance(s.world, ray, cache, own);
                                  });
            });
          }};
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
