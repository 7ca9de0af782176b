#include "geometry/sphere_tracer.h"

#include "numeric/robust.h"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

/// Clips [begin, end] to the part in which the ray o + s d is inside the box.
void clip(const sdf::Box& box, Vec3d o, Vec3d d, double& begin, double& end) {
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0) {
      if (o[i] < box.lower[i] || o[i] > box.upper[i]) end = -1;
      continue;
    }
    const double a = (box.lower[i] - o[i]) / d[i], b = (box.upper[i] - o[i]) / d[i];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
}

}  // namespace

/// The points o + s d, |d| = 1, in the sdf's coordinates; t = s * t_per_s.
struct SphereTracer::LocalRay {
  Vec3d o, d;
  double t_per_s;
  Vec3d at(double s) const { return o + s * d; }
};

SphereTracer::SphereTracer(const Sdf& sdf) : sdf_(sdf), box_(sdf::bounds(sdf, {})) {
  size_ = 0.5 * glm::length(box_.upper - box_.lower);
  // Room for rounding, so that a ray is outside before it meets the surface.
  box_.lower -= least_step * size_;
  box_.upper += least_step * size_;
  reach_ = glm::length(glm::max(glm::abs(box_.lower), glm::abs(box_.upper)));
  const sdf::Box world = sdf::bounds(sdf, sdf.place);
  const Vec3d margin =
      Vec3d(2 * least_step * size_ * sdf.place.scale) +
      static_cast<double>(rounding_bound(4)) * (glm::abs(world.lower) + glm::abs(world.upper));
  lower_ = Vec3(world.lower - margin);
  upper_ = Vec3(world.upper + margin);
}

SphereTracer::LocalRay SphereTracer::to_local(Vec3 o, Vec3 d) const {
  const Vec3d turned = glm::transpose(sdf_.place.rotation) * Vec3d(d);
  const double length = glm::length(turned);
  return {sdf_.place.inverse(Vec3d(o)), turned / length, sdf_.place.scale / length};
}

/// The precision with which a point of a ray from o can be known to lie on the surface: 64
/// roundings of the largest number involved.
double SphereTracer::resolution(Vec3d o) const {
  return 0x1p-46 * (glm::length(o) + reach_);
}

double SphereTracer::intersect(Vec3 o, Vec3 d, float tnear, float tfar) const {
  const LocalRay ray = to_local(o, d);
  const double start = static_cast<double>(tnear) / ray.t_per_s;
  double begin = start, end = static_cast<double>(tfar) / ray.t_per_s;
  clip(box_, ray.o, ray.d, begin, end);
  if (!(begin < end)) return -1;
  const double s = first_root(ray, begin, end, begin > start);
  const double t = s * ray.t_per_s;
  return t > static_cast<double>(tnear) && t < static_cast<double>(tfar) ? t : -1;
}

double SphereTracer::first_root(const LocalRay& ray, double begin, double end,
                                bool starts_outside) const {
  const double fine = resolution(ray.o);
  double least = std::max(least_step * size_, 4 * fine);
  double s = begin, f = sdf::distance(sdf_, ray.at(s));
  double side = starts_outside || f > 0 ? 1 : -1;
  if (!starts_outside && std::abs(f) <= fine) {
    // On the surface: the side is the one that the ray heads for.
    side = glm::dot(sdf::gradient(sdf_, ray.at(s)), ray.d) >= 0 ? 1 : -1;
    f = side * fine;
  }
  for (int n = 1; s < end; ++n) {
    const double next = std::min(s + std::max(std::abs(f), least), end);
    const double f_next = sdf::distance(sdf_, ray.at(next));
    if (f_next * side < 0) return narrowed(ray, s, next, f, f_next);
    s = next;
    f = f_next;
    if (n % steps_to_doubling == 0) least *= 2;
  }
  return -1;
}

/// The root between a and b, where F has different signs.
/// Source: Alefeld, Potra, Shi, "Algorithm 748: enclosing zeros of continuous functions", 1995.
double SphereTracer::narrowed(const LocalRay& ray, double a, double b, double f_a,
                              double f_b) const {
  const auto field = [&](double s) { return sdf::distance(sdf_, ray.at(s)); };
  const double fine = resolution(ray.o);
  const auto close = [fine](double l, double r) { return r - l <= fine; };
  std::uintmax_t evaluations = 100;
  const auto bracket = boost::math::tools::toms748_solve(field, a, b, f_a, f_b, close, evaluations);
  return 0.5 * (bracket.first + bracket.second);
}

SphereTracer::Point SphereTracer::point(Vec3 o, Vec3 d, double t) const {
  const LocalRay ray = to_local(o, d);
  const Vec3d exact = Vec3d(o) + t * Vec3d(d);
  const Vec3 p(exact);
  // Rounded to float once, plus the uncertainty of the search.
  const auto open = static_cast<float>(2 * sdf_.place.scale * resolution(ray.o));
  const Vec3 p_error = rounding_bound(3) * glm::abs(p) + Vec3(open);
  const Vec3d gradient = sdf_.place.rotation * sdf::gradient(sdf_, ray.at(t / ray.t_per_s));
  const double length = glm::length(gradient);
  // Where two surfaces just touch there is no normal: use one that faces the ray.
  const Vec3d outwards = length > 0 ? gradient / length : -Vec3d(d);
  return {p, p_error, Vec3(sdf_.flipped ? -outwards : outwards)};
}

}  // namespace carlo
