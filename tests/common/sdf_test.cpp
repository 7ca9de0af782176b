// Signed distance functions: each form against its closed form, gradients, Lipschitz bounds, boxes,
// and the hits of sphere tracing.

#include "geometry/analytic.h"
#include "geometry/intersector.h"
#include "geometry/sphere_tracer.h"
#include "numeric/robust.h"
#include "random/rng.h"
#include "sdf_places.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace carlo;
using namespace carlo::sdf;
using sdf_places::random_direction, sdf_places::turned;
using Vec3d = glm::dvec3;

constexpr float infinity = std::numeric_limits<float>::infinity();

Sdf only(decltype(Solid::form) form, const Similarity& place = {}) {
  return {{Solid{form, place}}, {}, false};
}

struct Named {
  std::string name;
  Sdf sdf;
};

/// One of each form and operation, all of size about 1; some rotated and moved inside.
std::vector<Named> examples() {
  const Similarity aside = turned(0.7, {0.2, -0.1, 0.3}, 0.8);
  const Solid ball{Ball{0.8}, {}}, torus{Torus{0.7, 0.2}, aside}, gyroid{Gyroid{0.6, 0.06}, aside},
      box{RoundedBox{{0.5, 0.7, 0.4}, 0.1}, turned(0.3)},
      capsule{Capsule{{-0.3, 0, 0.1}, {0.5, 0.6, 0}, 0.3}, aside};
  const auto made = [](std::vector<Step> steps) { return Sdf{std::move(steps), {}, false}; };
  return {{"ball", made({ball})},
          {"torus", made({torus})},
          {"rounded box", made({box})},
          {"sharp box", only(RoundedBox{{0.5, 0.7, 0.4}, 0})},
          {"capsule", made({capsule})},
          {"union", made({ball, torus, Combine{Operation::unite}})},
          {"blend", made({ball, torus, Combine{Operation::unite, 0.3}, capsule,
                          Combine{Operation::unite, 0.2}})},
          {"difference", made({box, capsule, Combine{Operation::subtract, 0.1}})},
          {"sharp difference", made({ball, capsule, Combine{Operation::subtract}})},
          {"intersection", made({ball, box, Combine{Operation::intersect}})},
          {"gyroid", made({ball, gyroid, Combine{Operation::intersect, 0.05}})}};
}

/// The same with a placement in the world.
Sdf placed(Sdf sdf, const Similarity& place) {
  sdf.place = place;
  return sdf;
}

Scene scene_of(Shape shape) {
  Scene scene;
  scene.materials.emplace_back();
  scene.shapes.push_back(std::move(shape));
  return scene;
}

/// Rays from a sphere of radius 4 about the sdf into it, in world space.
Ray aimed(const Similarity& place, Rng& rng) {
  const Vec3d from = place(4.0 * random_direction(rng));
  const Vec3d to = place(0.9 * rng.uniform() * random_direction(rng));
  return {Vec3(from), Vec3(glm::normalize(to - from))};
}

}  // namespace

TEST_CASE("distances keep the Lipschitz bound 1, gradients are their slopes", "[sdf]") {
  constexpr double h = 1e-6;
  for (const Named& example : examples()) {
    INFO(example.name);
    Rng rng(1);
    double steepest = 0, quotient = 0;
    int off = 0;
    constexpr int points = 100000;
    for (int i = 0; i < points; ++i) {
      const Vec3d p = 1.5 * rng.uniform() * random_direction(rng);
      const Vec3d q = p + rng.uniform() * random_direction(rng);
      const Vec3d gradient = sdf::gradient(example.sdf, p);
      const double f = sdf::distance(example.sdf, p);
      steepest = std::max(steepest, glm::length(gradient));
      quotient = std::max(quotient, std::abs(sdf::distance(example.sdf, q) - f) /
                                        std::max(glm::length(q - p), 1e-9));
      Vec3d slope;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3d step(0);
        step[axis] = h;
        slope[axis] =
            (sdf::distance(example.sdf, p + step) - sdf::distance(example.sdf, p - step)) / (2 * h);
      }
      if (!(glm::length(slope - gradient) <= 1e-4)) ++off;
    }
    CHECK(steepest <= 1 + 1e-12);
    CHECK(quotient <= 1 + 1e-7);
    // On creases differences see both sides. A point is within 1e-6 of a crease about once in 1e5;
    // it is within 1e-2 of a form's axis, where curvature costs 1e-4, less than once in 1e3.
    CHECK(off <= points / 1000);
  }
}

TEST_CASE("distances of the forms agree with their closed forms", "[sdf]") {
  Rng rng(2);
  double worst = 0;
  for (int i = 0; i < 10000; ++i) {
    const Similarity place = turned(6 * rng.uniform(), random_direction(rng), 0.5);
    const double a = 2 * pi * rng.uniform(), b = 2 * pi * rng.uniform();
    const double away = 0.2 * rng.uniform() - 0.1;
    // Torus: out from the point at the angles a, b, along the tube's radius.
    const double r = 0.3 + away;
    const Vec3d p((0.7 + r * std::cos(b)) * std::cos(a), (0.7 + r * std::cos(b)) * std::sin(a),
                  r * std::sin(b));
    const auto error = [&](const decltype(Solid::form)& form, Vec3d q, double exact) {
      const double f = sdf::distance(only(form, place), place(q));
      worst = std::max(worst, std::abs(f - 0.5 * exact));
    };
    error(Torus{0.7, 0.3}, p, away);
    const Vec3d w = random_direction(rng);
    error(Ball{0.4}, (0.4 + away) * w, away);
    // Box: out from a face, and from the middle of a rounded corner.
    error(RoundedBox{{0.5, 0.6, 0.7}, 0.2}, {0.5 + away, 0.3 * w.y, 0.3 * w.z}, away);
    error(
        RoundedBox{{0.5, 0.6, 0.7}, 0.2},
        Vec3d(0.3, -0.4, 0.5) + (0.2 + away) * Vec3d(std::abs(w.x), -std::abs(w.y), std::abs(w.z)),
        away);
    // Capsule along z: its side, and its lower cap.
    const double z = rng.uniform();
    error(Capsule{{0, 0, 0}, {0, 0, 1}, 0.3},
          {(0.3 + away) * std::cos(a), (0.3 + away) * std::sin(a), z}, away);
    error(Capsule{{0, 0, 0}, {0, 0, 1}, 0.3}, (0.3 + away) * Vec3d(w.x, w.y, -std::abs(w.z)), away);
  }
  CHECK(worst <= 1e-14);
}

TEST_CASE("a smooth union lies k/4 inside where its parts are equally near", "[sdf]") {
  const Sdf blend{{Solid{Ball{1}, {glm::dmat3(1), {-1.2, 0, 0}}},
                   Solid{Ball{1}, {glm::dmat3(1), {1.2, 0, 0}}}, Combine{Operation::unite, 0.4}},
                  {},
                  false};
  CHECK(std::abs(sdf::distance(blend, {0, 0, 0}) - (0.2 - 0.1)) <= 1e-15);
  CHECK(std::abs(sdf::distance(blend, {-3, 0, 0}) - 0.8) <= 1e-15);
}

TEST_CASE("no point of a solid is outside its box", "[sdf]") {
  for (const Named& example : examples()) {
    INFO(example.name);
    const Similarity frame = turned(1.1, {3, -2, 1}, 2.5);
    const Box box = sdf::bounds(example.sdf, frame);
    Rng rng(3);
    int inside = 0, outside_box = 0;
    Vec3d lower(1e9), upper(-1e9);
    for (int i = 0; i < 200000; ++i) {
      const Vec3d p = 2 * std::cbrt(rng.uniform()) * random_direction(rng);
      if (sdf::distance(example.sdf, p) > 0) continue;
      const Vec3d world = frame(p);
      lower = glm::min(lower, world);
      upper = glm::max(upper, world);
      ++inside;
      for (int axis = 0; axis < 3; ++axis) {
        if (world[axis] < box.lower[axis] || world[axis] > box.upper[axis]) ++outside_box;
      }
    }
    CHECK(inside >= 500);
    CHECK(outside_box == 0);
    // Nor far too large: no side is more than twice the solid's extent.
    const Vec3d slack = (box.upper - box.lower) / (upper - lower);
    CHECK(std::max({slack.x, slack.y, slack.z}) <= 2);
  }
}

TEST_CASE("a ball by sphere tracing is the sphere, at every scale and place", "[sdf]") {
  for (const double s : {1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
    for (const double far : {0.0, 1.0, 100.0}) {
      const auto radius = static_cast<float>(s);
      const Vec3 center(s * far * Vec3d(1, 0.7, -0.4));
      const Sphere sphere{center, radius};
      const Similarity place{glm::dmat3(1), Vec3d(center), static_cast<double>(radius)};
      const SphereTracer tracer(placed(only(Ball{1}), place));
      Rng rng(4);
      double worst_t = 0, worst_n = 0;
      int differ = 0;
      for (int i = 0; i < 5000; ++i) {
        Ray ray = aimed(place, rng);
        if (i % 3 == 0) ray.o = Vec3(place(0.9 * rng.uniform() * random_direction(rng)));
        if (i % 3 == 1) {  // past the rim, by 1e-2 to 1e-6 radii on either side
          const Vec3d n = random_direction(rng), to = glm::cross(n, random_direction(rng));
          const double by = std::pow(10, -2 - 4 * rng.uniform()) * (i % 2 == 0 ? 1 : -1);
          ray = {Vec3(place((1 + by) * n - 3.0 * glm::normalize(to))), Vec3(glm::normalize(to))};
        }
        const double t = intersect_sphere(sphere, ray.o, ray.d, 0, infinity);
        const double found = tracer.intersect(ray.o, ray.d, 0, infinity);
        if ((t > 0) != (found > 0)) {
          ++differ;
        } else if (t > 0) {
          // intersect_sphere measures in units of the direction normalized to exactly 1.
          const double length = glm::length(Vec3d(ray.d));
          worst_t = std::max(worst_t, std::abs(found * length - t) / (s * (4 + far)));
          const Vec3 n = tracer.point(ray.o, ray.d, found).n;
          const Vec3d exact = (Vec3d(ray.o) - Vec3d(center) + found * Vec3d(ray.d)) / s;
          worst_n = std::max(worst_n, glm::length(Vec3d(n) - exact));
        }
      }
      INFO("scale " << s << ", place " << far);
      CHECK(differ == 0);
      // At grazing angles the distance is a square root: an accuracy of 1e-15 leaves about 1e-11.
      CHECK(worst_t <= 1e-10);
      CHECK(worst_n <= 1e-6);
    }
  }
}

TEST_CASE("rays to known points of a torus hit them, down to grazing", "[sdf]") {
  const Torus torus{0.7, 0.25};
  const SphereTracer tracer(only(torus));
  Rng rng(5);
  double worst = 0, worst_n = 0;
  for (int i = 0; i < 20000; ++i) {
    const double a = 2 * pi * rng.uniform();
    const double b = pi * rng.uniform() - pi / 2;  // the outer half, which is convex
    const Vec3d n(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
    const Vec3d p = Vec3d(0.7 * std::cos(a), 0.7 * std::sin(a), 0) + 0.25 * n;
    const Vec3d along = glm::normalize(glm::cross(n, random_direction(rng)));
    const double cosine = std::pow(10, -3 * rng.uniform());  // 1 to 1e-3
    const Vec3d d = -cosine * n + std::sqrt(1 - cosine * cosine) * along;
    const Vec3 o(p - 2.0 * d), direction(d);
    const double t = tracer.intersect(o, direction, 0, infinity);
    REQUIRE(t > 0);
    const SphereTracer::Point point = tracer.point(o, direction, t);
    // Rounding o and d to float moves the ray by 3e-7, which 1/cosine magnifies.
    worst = std::max(worst, glm::length(Vec3d(point.p) - p) * cosine);
    worst_n = std::max(worst_n, glm::length(Vec3d(point.n) - n) * cosine);
  }
  CHECK(worst <= 1e-6);
  CHECK(worst_n <= 5e-6);
}

TEST_CASE("hits lie on the surface to within the stated error, at every scale and place", "[sdf]") {
  for (const Named& example : examples()) {
    for (const double s : {1e-4, 1.0, 1e6}) {
      for (const double far : {0.0, 100.0}) {
        const Similarity place = turned(0.4, s * far * Vec3d(0.3, -1, 0.5), s);
        const Sdf sdf = placed(example.sdf, place);
        const Scene scene = scene_of({sdf});
        const Intersector geometry(scene);
        Rng rng(6);
        int hits = 0, off = 0, not_first = 0;
        for (int i = 0; i < 1000; ++i) {
          const Ray ray = aimed(place, rng);
          Hit hit;
          if (!geometry.intersect(ray, hit)) continue;
          ++hits;
          const double f = s * sdf::distance(sdf, place.inverse(Vec3d(hit.p)));
          const auto error = static_cast<double>(glm::length(hit.p_error));
          if (!(std::abs(f) <= error)) ++off;
          if (!geometry.occluded(ray, hit.t * (1 + 1e-6f))) ++not_first;
          if (geometry.occluded(ray, hit.t * (1 - 1e-6f))) ++not_first;
        }
        INFO(example.name << ", scale " << s << ", place " << far);
        CHECK(hits >= 200);
        CHECK(off == 0);
        CHECK(not_first == 0);
      }
    }
  }
}

TEST_CASE("the first hit is not behind the surface, as small steps find it", "[sdf]") {
  // Steps of 1e-3 along the ray against sphere tracing: no change of sign before the hit.
  for (const Named& example : examples()) {
    const SphereTracer tracer(example.sdf);
    Rng rng(7);
    int passed = 0, missed = 0;
    for (int i = 0; i < 1000; ++i) {
      const Ray ray = aimed({}, rng);
      const double t = tracer.intersect(ray.o, ray.d, 0, infinity);
      for (int k = 0; k < 4000; ++k) {
        const double step = 2 + 1e-3 * k;
        const bool inside = sdf::distance(example.sdf, Vec3d(ray.o) + step * Vec3d(ray.d)) < -1e-6;
        if (inside && t < 0) ++missed;
        if (inside && t > step) ++passed;
        if (inside) break;
      }
    }
    INFO(example.name);
    CHECK(passed == 0);
    CHECK(missed == 0);
  }
}

TEST_CASE("rays that leave a surface do not meet it where they start", "[sdf]") {
  for (const Named& example : examples()) {
    const bool convex = example.name == "ball" || example.name == "rounded box" ||
                        example.name == "sharp box" || example.name == "capsule" ||
                        example.name == "intersection";
    for (const double s : {1e-4, 1.0, 1e6}) {
      const Similarity place = turned(0.4, s * Vec3d(3, -10, 5), s);
      const Scene scene = scene_of({placed(example.sdf, place)});
      const Intersector geometry(scene);
      Rng rng(8);
      int tried = 0, again = 0, lost = 0;
      while (tried < 4000) {  // 1.3e5 in all
        Hit hit, next;
        if (!geometry.intersect(aimed(place, rng), hit)) continue;
        Vec3 d(random_direction(rng));
        if (glm::dot(d, hit.n) < 0) d = -d;
        const float cosine = glm::dot(d, hit.n);
        ++tried;
        const Ray out{offset_origin(hit.p, hit.p_error, hit.n, d), d};
        // A shape that is not convex may be hit again, but a steep ray not near its start.
        if (geometry.intersect(out, next) &&
            (convex || (cosine > 0.1f && next.t < 1e-3f * static_cast<float>(s)))) {
          ++again;
        }
        // Every inward ray must come out, through the back of the surface.
        const Ray in{offset_origin(hit.p, hit.p_error, hit.n, -d), -d};
        if (!geometry.intersect(in, next) || glm::dot(next.n, in.d) < 0) ++lost;
      }
      INFO(example.name << ", scale " << s);
      // A ray that starts within rounding of a sharp inner edge may begin on its other side.
      CHECK(again <= (convex ? 0 : 1));
      CHECK(lost <= 4);
    }
  }
}

TEST_CASE("a ray that starts on the surface does not meet it at its start", "[sdf]") {
  const SphereTracer tracer(only(Ball{1}));
  const float tnear = std::numeric_limits<float>::min();
  CHECK(tracer.intersect({0, 0, 1}, {0, 0, 1}, tnear, infinity) < 0);
  CHECK(tracer.intersect({0, 0, 1}, {1, 0, 0}, tnear, infinity) < 0);
  CHECK(std::abs(tracer.intersect({0, 0, 1}, {0, 0, -1}, tnear, infinity) - 2) <= 1e-13);
  CHECK(tracer.intersect({0, 0, 3}, {0, 0, -1}, tnear, 1.999f) < 0);
  CHECK(std::abs(tracer.intersect({0, 0, 3}, {0, 0, -1}, tnear, 2.001f) - 2) <= 1e-13);
  CHECK(std::abs(tracer.intersect({0, 0, 3}, {0, 0, -1}, 2.5f, infinity) - 4) <= 1e-13);
}

TEST_CASE("a ray along a flat face comes to an end", "[sdf]") {
  const SphereTracer tracer(only(RoundedBox{{1, 1, 1}, 0.1}));
  for (const float height : {1e-3f, 1e-6f, 1.2e-7f}) {
    CHECK(tracer.intersect({-3, 1 + height, 0}, {1, 0, 0}, 0, infinity) < 0);
    CHECK(tracer.intersect({-3, 1 - height, 0}, {1, 0, 0}, 0, infinity) > 0);
  }
}

TEST_CASE("normals of an sdf point outwards, inwards when flipped", "[sdf]") {
  Sdf ball = only(Ball{1});
  CHECK(SphereTracer(ball).point({0, 0, 3}, {0, 0, -1}, 2).n == Vec3(0, 0, 1));
  ball.flipped = true;
  CHECK(SphereTracer(ball).point({0, 0, 3}, {0, 0, -1}, 2).n == Vec3(0, 0, -1));
  Sdf mirrored = placed(only(Torus{0.7, 0.2}), {glm::dmat3(-1), {0, 0, 0}, 1});
  CHECK(SphereTracer(mirrored).point({3, 0, 0}, {-1, 0, 0}, 2.1).n.x >= 1 - 1e-6f);
}
