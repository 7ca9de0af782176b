#include "hemisphere.h"

#include "course/not_implemented.h"

// Lab 07: directions. This is your file. hemisphere.h says what each function takes and returns;
// README.md says why. Your code takes the place of the not_implemented lines.

namespace lab07 {

// Lab 7.1 -----------------------------------------------------------------------------------------

Frame::Frame(Vec3 normal) : s(0), t(0), n(normal) {
  // 1. Find one unit vector s at a right angle to n. Whatever you divide by must never come near 0.
  // 2. Find t so that s, t, n are right-handed.
  carlo::not_implemented("Lab 7.1", "Reflected Ray Sampling");
}

Vec3 Frame::to_world(Vec3 local) const {
  // 1. Walk local.x along s, local.y along t, local.z along n.
  carlo::not_implemented("Lab 7.1", "Reflected Ray Sampling");
}

Vec3 Frame::to_local(Vec3 world) const {
  // 1. How far does `world` reach along each of the three axes?
  carlo::not_implemented("Lab 7.1", "Reflected Ray Sampling");
}

// Lab 7.2 -----------------------------------------------------------------------------------------

Accepted sample_uniform_by_rejection(Vec3 normal, carlo::Rng& rng) {
  // 1. Throw a dart into the cube: x, y, z in this order, a statement each.
  // 2. Throw again unless it is in the ball, and not its centre. Count every dart.
  // 3. Make a direction of it, on the normal's side.
  carlo::not_implemented("Lab 7.2", "Reflected Ray Sampling, option 1");
}

// Lab 7.3 -----------------------------------------------------------------------------------------

Vec3 sample_uniform_hemisphere(Vec2 u) {
  // 1. Find cos(theta) > 0 from one number, by inversion: how much of the hemisphere is above it?
  // 2. Find sin(theta) without the angle itself, and phi from the other number.
  // 3. Put the direction together.
  carlo::not_implemented("Lab 7.3", "Reflected Ray Sampling, option 2");
}

float uniform_hemisphere_pdf(Vec3 w) {
  // 1. Below the horizon: 0.
  // 2. The same for all others; the hemisphere's solid angle decides.
  carlo::not_implemented("Lab 7.3", "Reflected Ray Sampling, option 2");
}

// Lab 7.4 -----------------------------------------------------------------------------------------

Vec3 sample_cosine_hemisphere(Vec2 u) {
  // 1. Find cos(theta) > 0 and sin(theta) from one number, phi from the other; or lift a uniform
  //    point of the unit disc up to the hemisphere.
  carlo::not_implemented("Lab 7.4", "Reflected Ray Sampling, cosine-weighted");
}

float cosine_hemisphere_pdf(Vec3 w) {
  // 1. Below the horizon: 0.
  // 2. Proportional to the cosine, with the factor that makes its integral 1.
  carlo::not_implemented("Lab 7.4", "Reflected Ray Sampling, cosine-weighted");
}

// Lab 7.5 -----------------------------------------------------------------------------------------

Vec3 sample_lobe(Vec2 u, float n) {
  // 1. Find log(cos(alpha)) from one number, by inversion. The number 0 must stay within the lobe.
  // 2. From it find cos(alpha), and sin(alpha) without a difference of two nearly equal numbers.
  // 3. phi from the other number; put the direction together.
  carlo::not_implemented("Lab 7.5", "Reflected Ray Sampling, Phong BRDF");
}

float lobe_pdf(Vec3 w, float n) {
  // 1. Outside the lobe: 0.
  // 2. cos^n(alpha): w.z alone is not accurate enough for small angles; w.x and w.y are.
  // 3. Normalise over the lobe.
  carlo::not_implemented("Lab 7.5", "Reflected Ray Sampling, Phong BRDF");
}

// Lab 7.6 -----------------------------------------------------------------------------------------

Vec3 mirror_direction(Vec3 wo) {
  // 1. Both wo and the mirror direction point away from the surface: which coordinates change sign?
  carlo::not_implemented("Lab 7.6", "Reflected Ray Sampling, Phong BRDF");
}

Vec3 sample_mirror_lobe(Vec2 u, Vec3 wo, float n) {
  // 1. Draw from the lobe around z.
  // 2. Turn it so that z becomes the mirror direction.
  carlo::not_implemented("Lab 7.6", "Reflected Ray Sampling, Phong BRDF");
}

float mirror_lobe_pdf(Vec3 wi, Vec3 wo, float n) {
  // 1. Seen from the mirror direction's own frame, it is the density of Lab 7.5.
  carlo::not_implemented("Lab 7.6", "Reflected Ray Sampling, Phong BRDF");
}

// Lab 7.7 -----------------------------------------------------------------------------------------

double irradiance(const Radiance& radiance, Vec3 normal, const Sampling& sampling,
                  std::int64_t count, carlo::Rng& rng) {
  // 1. Draw a direction by the technique asked for. Write this part as a function of its own.
  // 2. Below the horizon: contribute 0 and do not ask for radiance.
  // 3. Else contribute radiance times cosine over pdf. Where the two cancel, cancel them by hand.
  // 4. Average in double.
  carlo::not_implemented("Lab 7.7", "Importance Sampling");
}

double ambient_occlusion(const Visible& visible, Vec3 normal, const Sampling& sampling,
                         std::int64_t count, carlo::Rng& rng) {
  // 1. This is the irradiance under a sky of which radiance?
  carlo::not_implemented("Lab 7.7", "Importance Sampling");
}

// Lab 7.8 -----------------------------------------------------------------------------------------

Vec3 direction_at(Point place) {
  // 1. Two angles, then the direction; here y is up, and the azimuth begins at -z. Use double.
  carlo::not_implemented("Lab 7.8", "Importance Sampling");
}

Point place_of(Vec3 w) {
  // 1. The inverse, by std::atan2 twice: acos(w.y) loses small angles.
  // 2. x must be at least 0, and both must stay below 1 when all has rounded.
  carlo::not_implemented("Lab 7.8", "Importance Sampling");
}

ImageLight::ImageLight(std::span<const double> luminances, std::size_t width, std::size_t height)
    : table_(luminances, width, height) {
  // 1. The table's weights are not the luminances alone: assign table_ anew with the right ones.
  carlo::not_implemented("Lab 7.8", "Importance Sampling");
}

ImageLight::Sample ImageLight::sample(glm::dvec2 u) const {
  // 1. A point of the table; its row (bin_of in lab 5's bins.h), and how far down that row it is.
  // 2. Within the row the direction's height w.y is uniform, not the angle.
  carlo::not_implemented("Lab 7.8", "Importance Sampling");
}

float ImageLight::pdf(Vec3 wi) const {
  // 1. The table's density is per area of the image. Which solid angle does that area cover?
  carlo::not_implemented("Lab 7.8", "Importance Sampling");
}

}  // namespace lab07
