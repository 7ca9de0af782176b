#pragma once

// Lab 08: a path tracer, in eight steps. The contract: what each exercise takes and returns. Do not
// edit this file; your work goes into steps/, one file per step.
//
// Directions are unit vectors that point away from the surface: wo to where the light goes, wi to
// where it comes from. Normals are on wo's side. Densities (pdfs) are per solid angle unless stated
// otherwise. Radiance and BRDFs have three channels, red, green and blue. The results of earlier
// labs (frames, directions: lab 7) are available; see hemisphere.h.

#include "given/cone.h"
#include "given/world.h"
#include "numeric/vec.h"
#include "random/rng.h"
#include "scene/camera.h"

#include <functional>
#include <optional>

namespace lab08 {

using carlo::Ray;
using carlo::Rgb;
using carlo::Rng;
using carlo::Vec2;
using carlo::Vec3;

// Step a: steps/a_camera.cpp ----------------------------------------------------------------------

/// The radiance that arrives along a ray, or an estimate of it.
using Radiance = std::function<Rgb(const Ray&)>;

/// Lab 8.1. The mean radiance of pixel (x, y), counted from the top left, of a width x height film.
/// The pixel is cut into strata x strata equal squares; each gets one ray through a uniform point
/// of it (two rng.uniform_float()), and the mean is returned. strata >= 1.
Rgb pixel_radiance(const carlo::Camera& camera, int width, int height, int x, int y, int strata,
                   const Radiance& radiance, Rng& rng);

// Step b: steps/b_direct.cpp ----------------------------------------------------------------------

/// The BRDF of one surface point for light from wi to wo; the cosine is not part of it.
using Brdf = std::function<Rgb(Vec3 wi)>;

/// Lab 8.2. One estimate of the radiance that leaves `surface` towards surface.wo after a single
/// reflection of light that comes straight from the world's lights (not from its environment). Area
/// form: one light, by world.choose(), one point of it, one shadow ray.
Rgb direct_by_area(const World& world, const Surface& surface, const Brdf& f, Rng& rng);

/// Lab 8.2. The same integral in its hemisphere form: one cosine-weighted direction (lab 7), one
/// ray, and the emission of the surface that it meets.
Rgb direct_by_hemisphere(const World& world, const Surface& surface, const Brdf& f, Rng& rng);

// Step c: steps/c_phong.cpp -----------------------------------------------------------------------

/// Lab 8.3. Lafortune's modified Phong BRDF, f = kd/pi + ks (n+2)/(2 pi) cos^n(alpha), where alpha
/// is the angle between wi and the mirror direction of wo, and the cosine counts as 0 from 90
/// degrees on. 0 for wi below the horizon. Right for n up to 1e7.
Rgb evaluate(const carlo::Phong& phong, Vec3 normal, Vec3 wo, Vec3 wi);

/// The probabilities with which sample() chooses the diffuse and the specular lobe: the largest
/// channels of kd and of ks, both divided by their sum if that is above 1. The rest is absorption.
/// So a diffuse surface multiplies no channel by more than 1. Any rule is unbiased that gives each
/// lobe that reflects a chance; the reference renderer's goes by the channels' mean.
struct LobeProbabilities {
  float diffuse = 0, specular = 0;
};
LobeProbabilities lobe_probabilities(const carlo::Phong& phong);

/// A direction and its weight: multiply the radiance from wi by `weight`.
struct BsdfSample {
  Vec3 wi{0};
  Rgb weight{0};
  float pdf = 0;  ///< of wi; 0 if there is only one direction, as for a mirror
};

/// Lab 8.3. Draws a direction: u_lobe decides between cosine-weighted directions, the lobe around
/// the mirror direction, and absorption; u makes the direction, as in lab 7. weight = f cos(theta)
/// / pdf. Returns nothing for an absorbed path, and for a direction below the horizon, which is not
/// drawn again.
std::optional<BsdfSample> sample(const carlo::Phong& phong, Vec3 normal, Vec3 wo, float u_lobe,
                                 Vec2 u);

/// Lab 8.3. The density of the directions that sample() returns, whichever lobe they come from. It
/// integrates to at most 1: the rest is absorbed, or below the horizon. 0 for wi there.
float pdf(const carlo::Phong& phong, Vec3 normal, Vec3 wo, Vec3 wi);

// Step d: steps/d_trace_path.cpp ------------------------------------------------------------------

/// Lab 8.4. The lecture's probability of choosing emission, not reflection, as a surface's
/// radiance: 0 if it does not emit towards wo, 1 if it emits and does not reflect, otherwise 0.9.
float p_emit(const Surface& surface);

/// Lab 8.4. The lecture's TracePath: one estimate of the radiance that arrives along the ray, by
/// either emission or reflection at the first surface, whose incoming light is estimated in the
/// same way. Directions come from sample(). A ray that meets no surface has the radiance
/// world.environment(). Surfaces are Phong surfaces.
Rgb trace_path_lecture(const World& world, const Ray& ray, Rng& rng);

/// Lab 8.4. The same, corrected: emission is always added, and reflection continues as long as
/// sample() does not absorb.
Rgb trace_path(const World& world, const Ray& ray, Rng& rng);

// Step e: steps/e_split.cpp -----------------------------------------------------------------------

/// The radiance that arrives from direction wi, or an estimate of it; never called for wi below the
/// horizon.
using Incoming = std::function<Rgb(Vec3 wi)>;

/// Lab 8.5. One estimate of the reflected radiance, the integral of f incoming cos(theta) over the
/// hemisphere, by two directions: a uniform one in the cone in which a light is seen, and a uniform
/// one in the hemisphere outside the cone, made by rejection. Part of the cone, or all of it, may
/// lie below the horizon; it does not cover the hemisphere.
Rgb reflect_split(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming,
                  Rng& rng);

/// Lab 8.5. The same with one direction: a fair coin decides which of the two is traced.
Rgb reflect_split_one(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming,
                      Rng& rng);

// Step f: steps/f_indirect.cpp --------------------------------------------------------------------

/// Lab 8.6. One estimate of the radiance that arrives along the ray: at every surface, light
/// directly from the lights by direct_by_area(), and light from elsewhere by sample() and
/// recursion. `with_emission`: whether the emission of the first surface is counted; light that
/// direct_by_area() has counted must not be counted again. The environment is not a light: rays
/// that meet no surface always add it. Surfaces are Phong surfaces.
Rgb trace_direct(const World& world, const Ray& ray, bool with_emission, Rng& rng);

// Step g: steps/g_specular.cpp --------------------------------------------------------------------

/// Lab 8.7. Fresnel's reflectance of a smooth boundary for unpolarised light, 1 for total internal
/// reflection. cos_i in [0, 1]; eta: the index of refraction on the side of cos_i, which is wo's,
/// over the one on the other side.
float fresnel(float cos_i, float eta);

/// Lab 8.7. The unit direction on the other side of the boundary from which light is refracted
/// towards wo, by Snell's law; nothing for total internal reflection. eta as above, for wo's side.
std::optional<Vec3> refract(Vec3 normal, Vec3 wo, float eta);

/// Lab 8.7. The one direction of a mirror, or one of glass's two: reflection where u is below
/// fresnel(), otherwise refraction. The weight is what remains of the BSDF after u's choice: the
/// mirror's reflectance; 1 for glass that reflects; and for glass that refracts the factor by which
/// radiance changes with its solid angle. pdf is 0.
BsdfSample sample_mirror(const carlo::Mirror& mirror, const Surface& surface);
BsdfSample sample_glass(const carlo::Dielectric& glass, const Surface& surface, float u);

/// Lab 8.7. trace_direct() for worlds that also contain mirrors and glass. Sampling lights is
/// useless for these: whatever their rays meet counts as if seen by the camera. Worlds have no two
/// mirrors that face each other: without absorption such paths have no end.
Rgb trace_specular(const World& world, const Ray& ray, bool with_emission, Rng& rng);

// Step h: steps/h_path_tracer.cpp -----------------------------------------------------------------

/// The random numbers of one path, a point of [0, 1)^infinity that may be stratified. Each
/// dimension must always drive the same decision: seek() goes to a dimension, next_1d() and
/// next_2d() read from there and advance by 1 and by 2.
class Dimensions {
 public:
  virtual ~Dimensions() = default;
  virtual void seek(unsigned dimension) = 0;
  virtual float next_1d() = 0;
  virtual Vec2 next_2d() = 0;
};

/// Lossless mirrors can trap a path for ever: it ends after this many segments.
constexpr int longest_path = 1 << 16;

/// Offsets of each decision within a vertex's dimensions: light, point on it, lobe (or glass's
/// choice), direction, roulette. Dimensions 0 and 1 belong to the film.
constexpr unsigned film_dimensions = 2, vertex_dimensions = 7;
constexpr unsigned light_dimension = 0, point_dimension = 1, lobe_dimension = 3,
                   direction_dimension = 4, roulette_dimension = 6;

/// Lab 8.8. The weight of a sample of density p beside another technique of density q, both >= 0
/// and not both 0: the power heuristic with exponent 2. Nothing overflows, and q may be infinite.
float power_heuristic(float p, float q);

/// Lab 8.8. The density per solid angle at surface point `from` with which direct_by_area() chooses
/// the point of surface `to`: 0 if that emits nothing towards `from`.
float light_pdf(const World& world, const Surface& from, const Surface& to);

/// Lab 8.8. One estimate of the radiance that arrives along the ray, in a loop: emission, direct
/// light by area and by sample()'s directions with their power-heuristic weights, mirrors and
/// glass, and Russian roulette. A path has at most max_depth segments (1: emission only, 2: direct
/// light); 0: as many as it takes, at most longest_path. Roulette: after its vertex a path survives
/// with a probability that depends on its throughput (the product of its weights so far) and is
/// above 0 as long as that is. min(1, 4 m), where m is its largest channel or its luminance, serves
/// well, but use at least 1/64: numbers are multiples of 2^-24, and one below 1e-9 is drawn 60
/// times too often.
Rgb path_radiance(const World& world, const Ray& ray, int max_depth, Dimensions& dimensions);

}  // namespace lab08
