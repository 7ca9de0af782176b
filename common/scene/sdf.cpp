#include "scene/sdf.h"

#include "numeric/robust.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carlo::sdf {
namespace {

using Vec3d = glm::dvec3;

Vec3d direction_of(Vec3d v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : Vec3d(0);
}

// Distance and gradient of each form, in its own coordinates
// ---------------------------------------

double distance(const Ball& ball, Vec3d q) {
  return glm::length(q) - ball.radius;
}
Vec3d gradient(const Ball&, Vec3d q) {
  return direction_of(q);
}

double distance(const Torus& torus, Vec3d q) {
  const double from_circle = std::sqrt(q.x * q.x + q.y * q.y) - torus.major;
  return std::sqrt(from_circle * from_circle + q.z * q.z) - torus.minor;
}
Vec3d gradient(const Torus& torus, Vec3d q) {
  const Vec3d on_circle = torus.major * direction_of({q.x, q.y, 0});
  return direction_of(q - on_circle);
}

double distance(const RoundedBox& box, Vec3d q) {
  const Vec3d beyond = glm::abs(q) - (box.half - box.radius);
  const double inside = std::min(std::max({beyond.x, beyond.y, beyond.z}), 0.0);
  return glm::length(glm::max(beyond, 0.0)) + inside - box.radius;
}
Vec3d gradient(const RoundedBox& box, Vec3d q) {
  const Vec3d beyond = glm::abs(q) - (box.half - box.radius);
  const double most = std::max({beyond.x, beyond.y, beyond.z});
  Vec3d outwards = glm::max(beyond, 0.0);
  if (most <= 0) {
    outwards = Vec3d(0);
    for (int i = 0; i < 3 && outwards == Vec3d(0); ++i)
      outwards[i] = beyond[i] == most ? 1 : 0;
  }
  for (int i = 0; i < 3; ++i)
    outwards[i] = std::copysign(outwards[i], q[i]);
  return direction_of(outwards);
}

Vec3d from_segment(const Capsule& capsule, Vec3d q) {
  const Vec3d along = capsule.b - capsule.a;
  const double place = glm::dot(q - capsule.a, along) / glm::dot(along, along);
  return q - capsule.a - std::clamp(place, 0.0, 1.0) * along;
}
double distance(const Capsule& capsule, Vec3d q) {
  return glm::length(from_segment(capsule, q)) - capsule.radius;
}
Vec3d gradient(const Capsule& capsule, Vec3d q) {
  return direction_of(from_segment(capsule, q));
}

constexpr double sqrt3 = 1.7320508075688772;

double distance(const Gyroid& gyroid, Vec3d q) {
  const double frequency = 2 * pi / gyroid.period;
  const Vec3d s = glm::sin(frequency * q), c = glm::cos(frequency * q);
  const double g = s.x * c.y + s.y * c.z + s.z * c.x;
  return std::abs(g) / (sqrt3 * frequency) - 0.5 * gyroid.thickness;
}
Vec3d gradient(const Gyroid& gyroid, Vec3d q) {
  const double frequency = 2 * pi / gyroid.period;
  const Vec3d s = glm::sin(frequency * q), c = glm::cos(frequency * q);
  const double g = s.x * c.y + s.y * c.z + s.z * c.x;
  const Vec3d slope(c.x * c.y - s.z * s.x, c.y * c.z - s.x * s.y, c.z * c.x - s.y * s.z);
  return std::copysign(1 / sqrt3, g) * slope;
}

// The support function: how far the form reaches in the direction u, |u| = 1
// -----------------------

double reach(const Ball& ball, Vec3d) {
  return ball.radius;
}
double reach(const Torus& torus, Vec3d u) {
  return torus.major * std::sqrt(u.x * u.x + u.y * u.y) + torus.minor;
}
double reach(const RoundedBox& box, Vec3d u) {
  return glm::dot(box.half - box.radius, glm::abs(u)) + box.radius;
}
double reach(const Capsule& capsule, Vec3d u) {
  return std::max(glm::dot(capsule.a, u), glm::dot(capsule.b, u)) + capsule.radius;
}
double reach(const Gyroid&, Vec3d) {
  return std::numeric_limits<double>::infinity();
}

// Values and gradients run through the same steps
// --------------------------------------------------

struct Jet {
  double value;
  Vec3d gradient;
};

void evaluate(const Solid& solid, Vec3d p, double& out) {
  const Vec3d q = solid.place.inverse(p);
  out = solid.place.scale * std::visit([&](const auto& f) { return distance(f, q); }, solid.form);
}
void evaluate(const Solid& solid, Vec3d p, Jet& out) {
  evaluate(solid, p, out.value);
  const Vec3d q = solid.place.inverse(p);
  out.gradient =
      solid.place.rotation * std::visit([&](const auto& f) { return gradient(f, q); }, solid.form);
}

double negated(double a) {
  return -a;
}
Jet negated(const Jet& a) {
  return {-a.value, -a.gradient};
}

/// How far smoothing extends the minimum into its zone, as a fraction of that zone: 1 where a = b.
double overlap(double a, double b, double k) {
  return k > 0 ? std::max(1 - std::abs(a - b) / k, 0.0) : 0.0;
}
double minimum(double a, double b, double k) {
  const double h = overlap(a, b, k);
  return std::min(a, b) - 0.25 * k * h * h;
}
Jet minimum(const Jet& a, const Jet& b, double k) {
  const double other = 0.5 * overlap(a.value, b.value, k);
  const double weight = a.value < b.value ? other : 1 - other;
  return {minimum(a.value, b.value, k), (1 - weight) * a.gradient + weight * b.gradient};
}

template <class Value>
Value combined(const Combine& combine, const Value& a, const Value& b) {
  switch (combine.operation) {
    case Operation::unite:
      return minimum(a, b, combine.smoothing);
    case Operation::intersect:
      return negated(minimum(negated(a), negated(b), combine.smoothing));
    case Operation::subtract:
      return negated(minimum(negated(a), b, combine.smoothing));
  }
  return a;
}

template <class Value>
Value evaluate(const Sdf& sdf, Vec3d p) {
  std::array<Value, most_waiting> stack;
  Value* end = stack.data();
  for (const Step& step : sdf.steps) {
    if (const auto* solid = std::get_if<Solid>(&step)) {
      evaluate(*solid, p, *end++);
    } else {
      --end;
      end[-1] = combined(std::get<Combine>(step), end[-1], *end);
    }
  }
  return stack[0];
}

/// A box around the points with value <= level of the part that ends before `end`; moves `end` to
/// where that part begins.
Box bounds(const std::vector<Step>& steps, std::size_t& end, double level,
           const Similarity& frame) {
  const Step& step = steps[--end];
  if (const auto* solid = std::get_if<Solid>(&step)) {
    const Similarity place = frame * solid->place;
    const auto reach_along = [&](Vec3d axis) {
      const Vec3d u = glm::transpose(place.rotation) * axis;
      return place.scale * std::visit([&](const auto& f) { return reach(f, u); }, solid->form) +
             frame.scale * level;
    };
    Box box{place.origin, place.origin};
    for (int i = 0; i < 3; ++i) {
      Vec3d axis(0);
      axis[i] = 1;
      box.upper[i] += reach_along(axis);
      box.lower[i] -= reach_along(-axis);
    }
    return box;
  }
  const Combine& combine = std::get<Combine>(step);
  // A smooth minimum is at most k/4 below the minimum, a smooth maximum not below the maximum.
  if (combine.operation == Operation::unite) level += 0.25 * combine.smoothing;
  const Box b = bounds(steps, end, level, frame), a = bounds(steps, end, level, frame);
  switch (combine.operation) {
    case Operation::unite:
      return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
    case Operation::intersect:
      return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
    case Operation::subtract:
      return a;
  }
  return a;
}

}  // namespace

double distance(const Sdf& sdf, Vec3d p) {
  return evaluate<double>(sdf, p);
}

Vec3d gradient(const Sdf& sdf, Vec3d p) {
  return evaluate<Jet>(sdf, p).gradient;
}

Box bounds(const Sdf& sdf, const Similarity& frame) {
  std::size_t end = sdf.steps.size();
  return bounds(sdf.steps, end, 0, frame);
}

}  // namespace carlo::sdf
