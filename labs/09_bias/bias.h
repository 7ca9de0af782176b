#pragma once

// Lab 09: bias for noise, in seven steps. The contract: what each exercise takes and returns. Do
// not edit this file; your work goes into steps/, one file per step.
//
// Directions, surfaces and BRDFs are lab 8's: see path_tracer.h. Radiance, irradiance and flux
// have three channels, red, green and blue.

#include "given/feature_image.h"
#include "given/photon_map.h"
#include "given/records.h"
#include "numeric/robust.h"
#include "path_tracer.h"

#include <functional>
#include <optional>
#include <span>

namespace lab09 {

using carlo::Ray;
using carlo::Rgb;
using carlo::Rng;
using carlo::Vec2;
using carlo::Vec3;
using lab08::Brdf;
using lab08::Light;
using lab08::Radiance;
using lab08::Surface;
using lab08::World;

// Step a: steps/a_error.cpp -----------------------------------------------------------------------

/// The parts of the mean square error of an estimate: error^2 = bias^2 + variance.
struct ErrorParts {
  double bias2 = 0;     ///< square of (expected value - exact value)
  double variance = 0;  ///< of one estimate about its expected value
};

/// Lab 9.1. Both parts from at least two independent estimates of a known value, in any order.
/// Neither result may itself be biased, so bias2 can come out below 0 where there is no bias. Right
/// even for values far from 0 that differ little.
ErrorParts split_error(std::span<const double> estimates, double exact);

/// Lab 9.1. The slope of log(error) against log(n), by least squares. At least two different n; all
/// numbers > 0.
double fitted_slope(std::span<const double> n, std::span<const double> error);

/// Lab 9.1. The number of seconds after which an unbiased method overtakes a biased one, if the
/// square error of the first is a/t after t seconds, and that of the second bias2 + b/t. a, b > 0.
/// 0: it is ahead from the start; infinity: never (bias2 <= 0 counts as no bias).
double overtakes_after(double a, double b, double bias2);

// Step b: steps/b_pixel_filter.cpp ----------------------------------------------------------------

/// A filter around a pixel's middle: the product of the same curve in x and in y. All curves are 0
/// beyond `radius` pixels in either direction.
struct PixelFilter {
  enum class Curve { box, tent, gaussian };
  Curve curve = Curve::box;
  double radius = 0.5;  ///< in pixels, > 0
  double sigma = 0.5;   ///< of the Gaussian, in pixels, > 0; radius is at most 6 sigma
};

/// Lab 9.2. The filter at an offset from the pixel's middle, in pixels: it integrates to 1, and is
/// the density of sample_filter().
double filter_value(const PixelFilter& filter, double x, double y);

/// An offset from the pixel's middle, in pixels.
struct Offset {
  double x = 0, y = 0;
};

/// Lab 9.2. An offset with the filter as its density, by inversion: x grows with u.x, and y with
/// u.y. u in [0, 1)^2. Right to a millionth of the radius.
Offset sample_filter(const PixelFilter& filter, Vec2 u);

/// Lab 9.2. An estimate of the filtered radiance of pixel (x, y), as in Lab 8.1, from `samples`
/// rays through offsets that are drawn from the filter. Rays may leave the film.
Rgb filtered_pixel(const carlo::Camera& camera, int width, int height, int x, int y,
                   const PixelFilter& filter, int samples, const Radiance& radiance, Rng& rng);

/// Lab 9.2. The same by uniform offsets in the filter's square, weighted by the filter and divided
/// by the sum of the weights: biased for few samples. 0 if that sum is 0, as without samples.
Rgb weighted_pixel(const carlo::Camera& camera, int width, int height, int x, int y,
                   const PixelFilter& filter, int samples, const Radiance& radiance, Rng& rng);

// Step c: steps/c_feature_filter.cpp --------------------------------------------------------------

/// How different two pixels may be before they are no longer mixed.
struct FilterStrength {
  int radius = 7;       ///< of the square window, in pixels
  double color = 1;     ///< k, in standard errors
  double albedo = 0.1;  ///< each > 0
  double normal = 0.1;
  double depth = 0.05;  ///< as a fraction of the larger depth
};

/// Lab 9.3. The weight exp(-d) of one pixel in the other's mean, in [0, 1], symmetric; 1 for a
/// pixel with itself. d is the sum of
///   |albedo - albedo'|^2 / (2 albedo^2), |normal - normal'|^2 / (2 normal^2),
///   ((depth - depth') / larger depth)^2 / (2 depth^2), 0 where both depths are 0,
///   and the mean over the channels of max(0, (c - c')^2 - v) / (k^2 v), v = variance + variance':
///   where v is 0 a channel counts 0 if the colours are equal, and otherwise makes the weight 0.
double feature_weight(const FeaturePixel& one, const FeaturePixel& other,
                      const FilterStrength& strength);

/// Lab 9.3. The weighted mean of the colours in the window around pixel (x, y), clipped to the
/// image, and the variance that this mean would have if the weights were given.
struct Filtered {
  Rgb color{0};
  Rgb variance{0};
};
Filtered filter_pixel(const FeatureImage& image, int x, int y, const FilterStrength& strength);

// Step d: steps/d_photons.cpp ---------------------------------------------------------------------

/// A photon in flight: flux is the power that it carries.
struct Emission {
  Ray ray;
  Rgb flux{0};
};

/// Given, for Lab 9.4: the ray that leaves a point of a light in direction d, on the emitting side:
/// as in World::leave(), it starts off the light by as much as rounding demands.
inline Ray leave(const lab08::LightPoint& point, Vec3 d) {
  return {carlo::offset_origin(point.p, point.p_error, point.n, d), d};
}

/// Lab 9.4. Emits a photon from a point light of radiant intensity I, the same in all directions.
/// If n are emitted, each stands for 1/n of its flux: that division is not done here, nor below.
Emission emit_from_point(Vec3 p, Rgb intensity, Rng& rng);

/// Lab 9.4. Emits a photon from a light: a uniform point of it and a direction for which all
/// photons carry the same flux, the light's power. It starts beside the light, by leave().
Emission emit_from_light(const Light& light, Rng& rng);

/// Lab 9.4. Emits a photon from all lights together: one of them is chosen by world.choose(), which
/// leaves none without photons, however weak it is beside the others. The world has lights.
Emission emit_photon(const World& world, Rng& rng);

/// Lab 9.4. Follows a photon until it leaves the world or is absorbed, and stores it at every Phong
/// surface that it meets, including the first, as it arrives: the flux that it still carries, and
/// everything that it has met before. Directions, mirrors and glass are those of lab 8; but flux
/// is not radiance. At most lab08::longest_path segments.
void trace_photon(const World& world, const Emission& emission, Rng& rng,
                  const std::function<void(const Photon&)>& store);

// Step e: steps/e_density.cpp ---------------------------------------------------------------------

/// Lab 9.5. The radiance that `surface` reflects towards its wo, from all photons within `radius` >
/// 0, whose flux is taken to lie on a disc. Photons that arrived on the surface's other side do not
/// count.
Rgb radiance_within(const PhotonMap& map, const Surface& surface, const Brdf& f, float radius);

/// Lab 9.5. The same from the photons nearer than the k-th nearest, which only determines the size
/// of the disc: so it is unbiased where photons are uniform. Those on the surface's other side are
/// among the k, but contribute nothing. k >= 2; 0 if there are fewer photons.
Rgb radiance_nearest(const PhotonMap& map, const Surface& surface, const Brdf& f, int k);

/// Lab 9.5. The radiance that arrives along a ray, with all reflected light from a map of all
/// photons: mirrors and glass are followed as in Lab 8.7 to the first Phong surface, where it is
/// the emission plus radiance_within(). The emission of mirrors and glass themselves is added on
/// the way. The environment if the ray meets nothing. At most lab08::longest_path segments, here
/// and below.
Rgb photon_radiance(const World& world, const Ray& ray, const PhotonMap& all, float radius,
                    Rng& rng);

/// Lab 9.5. The same with lab 8's paths for all light but caustics, which come from a map of
/// caustic photons, at every Phong surface of the path. All light must come by exactly one of the
/// two ways.
Rgb caustic_radiance(const World& world, const Ray& ray, const PhotonMap& caustics, float radius,
                     Rng& rng);

// Step f: steps/f_progressive.cpp -----------------------------------------------------------------

/// Lab 9.6. The radius of the pass after pass number `pass` (from 1), which had `radius`: its
/// square shrinks by (pass + alpha)/(pass + 1), 0 < alpha < 1.
double next_radius(double radius, int pass, double alpha);

/// Lab 9.6. The mean over passes with their own photons: calls estimate(pass, radius) once for each
/// pass 1, 2, ... `passes`, in this order, the first with first_radius. passes >= 1, and may be so
/// many that floats do not hold their sum.
Rgb progressive_mean(int passes, double first_radius, double alpha,
                     const std::function<Rgb(int pass, double radius)>& estimate);

// Step g: steps/g_irradiance_cache.cpp ------------------------------------------------------------

/// The radiance that arrives along a ray from a surface, and the distance to what it hits; infinite
/// if it hits nothing.
struct Arrival {
  Rgb radiance{0};
  double distance = 0;  ///< > 0
};
using LookAround = std::function<Arrival(Vec3 wi)>;

/// Lab 9.7. The irradiance at a point and the harmonic mean of the distances, from strata x strata
/// cosine-weighted directions, one in each stratum of [0, 1)^2. The distance may be infinite.
Record make_record(Vec3 p, Vec3 n, int strata, const LookAround& look, Rng& rng);

/// Lab 9.7. Ward's estimate of the error of a record's irradiance at another point with another
/// normal: |p - p'| / distance + sqrt(1 - n . n'). Right even for normals that differ by 1e-6.
double record_error(const Record& record, Vec3 p, Vec3 n);

/// Lab 9.7. The irradiance at a point from records whose error there is below `most`, each weighted
/// by 1/error; a record with error 0 decides alone. A record does not serve points in front of
/// which it lies by more than a hundredth of its distance, measured along (n + n')/2: they do not
/// see what it sees. Nothing if no record remains.
std::optional<Rgb> interpolate(std::span<const Record> records, Vec3 p, Vec3 n, double most);

/// Lab 9.7. interpolate() from the records of a cache near p; or, if none remains, a new record by
/// make(), which is added to the cache.
Rgb cached_irradiance(Cache& cache, Vec3 p, Vec3 n, double most,
                      const std::function<Record()>& make);

}  // namespace lab09
