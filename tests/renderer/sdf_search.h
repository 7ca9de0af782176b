#pragma once

// Finds where rays meet sdfs from F alone: slow, and based on nothing about the tracers but the
// promises in SphereTracer's comment.

#include "geometry/sphere_tracer.h"
#include "lane_records.h"
#include "scene/sdf.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace sdf_search {

using Vec3d = glm::dvec3;

/// The points o + s d, |d| = 1, s in [0, end], in the sdf's coordinates.
struct Ray {
  const carlo::Sdf* sdf;
  Vec3d o, d;
  double t_per_s, end;
  double fine;   ///< this near 0 the sign of F is unknown
  double least;  ///< spans up to this length may be missed

  double at(double s) const { return carlo::sdf::distance(*sdf, o + s * d); }
  double slope(double s) const { return glm::dot(carlo::sdf::gradient(*sdf, o + s * d), d); }
};

inline Ray local(const carlo::Sdf& sdf, const carlo::SphereTracer& tracer,
                 const sdf_lanes::Ray& ray) {
  const Vec3d turned = glm::transpose(sdf.place.rotation) * Vec3d(ray.d);
  const double length = glm::length(turned);
  const Vec3d o = sdf.place.inverse(Vec3d(ray.o));
  // Beyond this there is no surface, nor where F is above 0 and the ray has left the box.
  const Vec3d middle = 0.5 * (tracer.box().lower + tracer.box().upper);
  const double last = glm::length(o - middle) + 1.01 * tracer.size();
  const double t_per_s = sdf.place.scale / length;
  const double fine = 0x1p-46 * (glm::length(o) + tracer.reach());
  return {&sdf,
          o,
          turned / length,
          t_per_s,
          std::min(last, static_cast<double>(ray.far) / t_per_s),
          fine,
          std::max(carlo::SphereTracer::least_step * tracer.size(), 4 * fine)};
}

/// Part of a ray where F clearly has the other sign.
struct Span {
  double begin, end;
};

/// The part of a ray, extended to both sides, that is inside a convex solid; begin > end if there
/// is none.
inline Span through_ball(const Ray& ray, double radius) {
  const double middle = -glm::dot(ray.o, ray.d);
  const double off = glm::length(ray.o + middle * ray.d);
  if (off > radius) return {1, -1};
  const double half = std::sqrt((radius - off) * (radius + off));
  return {middle - half, middle + half};
}

inline Span through_box(const Ray& ray, Vec3d half) {
  Span span{-1e300, 1e300};
  for (int k = 0; k < 3; ++k) {
    if (ray.d[k] == 0) {
      if (std::abs(ray.o[k]) > half[k]) return {1, -1};
      continue;
    }
    const double a = (-half[k] - ray.o[k]) / ray.d[k], b = (half[k] - ray.o[k]) / ray.d[k];
    span = {std::max(span.begin, std::min(a, b)), std::min(span.end, std::max(a, b))};
  }
  return span;
}

/// The whole span around s; its ends are found by small steps, the first one exactly.
inline Span span_about(const Ray& ray, double side, double s) {
  const auto other = [&](double x) { return side * ray.at(x) < -ray.fine; };
  const auto step = [&](double x) {
    return std::max(std::abs(ray.at(x)) - ray.fine, ray.least / 16);
  };
  double begin = s, end = s;
  while (end < ray.end && other(end))
    end = std::min(end + step(end), ray.end);
  double before = begin;
  while (before > 0 && other(before)) {
    begin = before;
    before = std::max(before - step(before), 0.0);
  }
  if (other(before)) return {before, end};
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (before + begin);
    (other(middle) ? begin : before) = middle;
  }
  return {begin, end};
}

struct Search {
  std::optional<Span> span;
  double searched;  ///< up to here; less than `last` if the search was abandoned
};

/// The first span before `last` longer than ray.least, by bisection: around the middle of a part,
/// nothing within a distance of |F| is on the other side, since F has the Lipschitz bound 1.
inline Search first_span(const Ray& ray, double side, double last, int most_values) {
  struct Part {
    double a, b;
  };
  std::vector<Part> parts{{0, last}};
  double measured = 0;  // shorter spans end before
  for (int n = 0; !parts.empty(); ++n) {
    const auto [a, b] = parts.back();
    if (n == most_values) return {{}, a};
    parts.pop_back();
    const double middle = 0.5 * (a + b), f = side * ray.at(middle);
    if (f >= 0.5 * (b - a)) continue;
    if (b - a > 0.5 * ray.least) {
      parts.push_back({middle, b});
      parts.push_back({a, middle});
      continue;
    }
    if (f >= -ray.fine || middle < measured) continue;
    const Span span = span_about(ray, side, middle);
    if (span.end - span.begin > ray.least) return {span, span.begin};
    measured = span.end;
  }
  return {{}, last};
}

/// The possible sides on which a ray starts: both, where rounding decides.
inline std::vector<double> sides(const Ray& ray) {
  const double f = ray.at(0);
  if (std::abs(f) > 2 * ray.fine) return {f > 0 ? 1.0 : -1.0};
  const double before = ray.slope(-4 * ray.fine), after = ray.slope(4 * ray.fine);
  const bool crease = std::abs(before - after) > 1e-3 * std::abs(after);
  if (std::abs(f) > 0.5 * ray.fine || crease || std::abs(after) * ray.least < 8 * ray.fine)
    return {1, -1};
  return {after > 0 ? 1.0 : -1.0};
}

/// The least step once a ray has reached s, if each step is as long as promised.
inline double least_step_at(const Ray& ray, double s) {
  double least = ray.least;
  int steps = 0;
  for (double x = 0; x < s;) {
    x += std::max(std::abs(ray.at(x)), least);
    if (++steps % carlo::SphereTracer::steps_to_doubling == 0) least *= 2;
  }
  return least;
}

/// The verdict of F on a ray's result.
struct Verdict {
  bool root = true;      ///< a hit is a root, within F's resolution
  bool crosses = true;   ///< F goes from this side to the other there
  bool first = true;     ///< no earlier span longer than the least step was missed
  bool excused = false;  ///< one was missed, after so many steps that the least step had grown
  bool whole = true;     ///< everything was searched
  /// Rounding decides on which side the ray starts, or it starts on the surface and is back on the
  /// other side within the least step: then it may meet any point of that span, or nothing.
  bool open = false;
};

inline bool crosses(const Ray& ray, double side, double s) {
  const int widths = std::ilogb(2 * ray.least / ray.fine);
  for (int i = 0; i <= widths; ++i) {
    const double w = std::ldexp(ray.fine, i);
    if (side * ray.at(s - w) > 0 && side * ray.at(s + w) < 0) return true;
  }
  return false;
}

inline Verdict judge(const Ray& ray, double side, double s, int most_values) {
  Verdict verdict;
  if (s >= 0) {
    verdict.root = s <= ray.end * (1 + 1e-12) + ray.fine && std::abs(ray.at(s)) <= 2 * ray.fine;
    verdict.crosses = crosses(ray, side, s);
  }
  const double last = s >= 0 ? std::min(s, ray.end) : ray.end;
  const Search search = first_span(ray, side, last, most_values);
  verdict.whole = search.searched >= last || search.span;
  if (!search.span || (s >= 0 && s <= search.span->begin + 2 * ray.fine)) return verdict;
  verdict.first = false;
  const double length = search.span->end - search.span->begin;
  verdict.excused = length <= 1.01 * least_step_at(ray, search.span->begin);
  return verdict;
}

/// Judges by the more favourable side, if there are two.
inline Verdict judge(const Ray& ray, double s, int most_values) {
  const std::vector<double> possible = sides(ray);
  const bool starts_on_it = std::abs(ray.at(0)) <= 2 * ray.fine;
  Verdict verdict;
  for (const double side : possible) {
    verdict = judge(ray, side, s, most_values);
    verdict.open =
        possible.size() > 1 || (starts_on_it && s < ray.least && side * ray.at(ray.least) < 0);
    if (verdict.open) verdict.crosses = true;
    if (verdict.root && verdict.first) return verdict;
  }
  return verdict;
}

/// True if two results are the same root: F is not clearly nonzero between them.
inline bool same_root(const Ray& ray, double s1, double s2) {
  if (s1 < 0 || s2 < 0) return s1 < 0 && s2 < 0;
  if (std::abs(s1 - s2) <= 4 * ray.fine) return true;
  for (int i = 0; i <= 16; ++i) {
    if (std::abs(ray.at(s1 + (s2 - s1) * i / 16)) > 2 * ray.fine) return false;
  }
  return true;
}

}  // namespace sdf_search
