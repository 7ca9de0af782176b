// Bounds of second derivatives along lines, against second differences of F and closed forms.

#include "geometry/sphere_tracer.h"
#include "random/rng.h"
#include "renderer/lanes/lane_sdf.h"
#include "scene/sdf.h"
#include "sdf_cases.h"
#include "sdf_places.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace {

using namespace carlo;
using namespace carlo::sdf;
using glm::dvec3;
using sdf_places::random_direction;

constexpr double unbounded = std::numeric_limits<double>::infinity();

Similarity random_place(Rng& rng, double move) {
  const dvec3 x = random_direction(rng), y = glm::normalize(glm::cross(x, random_direction(rng)));
  return {glm::dmat3(x, y, glm::cross(x, y)), move * random_direction(rng),
          std::exp2(2 * rng.uniform() - 1)};
}

Solid random_solid(Rng& rng) {
  const auto between = [&](double a, double b) { return a + (b - a) * rng.uniform(); };
  const Similarity place = random_place(rng, 0.4);
  switch (rng.next_u32() % 5) {
    case 0:
      return {Ball{between(0.05, 0.8)}, place};
    case 1:
      return {Torus{between(0.4, 0.8), between(0.05, 0.35)}, place};
    case 2: {
      const double radius = rng.next_u32() % 4 == 0 ? 0 : between(0.01, 0.2);
      return {RoundedBox{radius + between(0.1, 0.5) * dvec3(1, 0.5, 2), radius}, place};
    }
    case 3:
      return {Capsule{0.5 * random_direction(rng), 0.5 * random_direction(rng), between(0.05, 0.3)},
              place};
    default: {
      const double period = between(0.3, 1);
      return {Gyroid{period, period * between(0.02, 0.2)}, place};
    }
  }
}

/// One to four parts, combined in any way.
Sdf random_sdf(Rng& rng) {
  Sdf shape;
  shape.steps.emplace_back(random_solid(rng));
  for (std::uint32_t parts = rng.next_u32() % 4; parts > 0; --parts) {
    shape.steps.emplace_back(random_solid(rng));
    const double smoothing = rng.next_u32() % 4 == 0 ? 0 : std::exp2(-1 - 6 * rng.uniform());
    shape.steps.emplace_back(Combine{static_cast<Operation>(rng.next_u32() % 3), smoothing});
  }
  return shape;
}

Sdf one_of(decltype(Solid::form) form) {
  return {{Solid{form, {}}}, {}, false};
}

}  // namespace

TEST_CASE("Bounds of second derivatives hold along lines, on creases too") {
  Rng rng(1);
  int below = 0, above = 0, over = 0;
  for (int n = 0; n < 4000; ++n) {
    const Sdf shape = random_sdf(rng);
    const double reach = std::exp2(-8 * rng.uniform());
    const double least = -renderer::bend_below(shape, reach),
                 most = renderer::bend_above(shape, reach);
    for (int i = 0; i < 500; ++i) {
      // A second difference is a mean of F'' over a segment of length 2 h.
      const double h = std::exp2(-2 - 10 * rng.uniform());
      const dvec3 p = 1.2 * rng.uniform() * random_direction(rng), step = h * random_direction(rng);
      const double f = distance(shape, p);
      const double second =
          (distance(shape, p + step) - 2 * f + distance(shape, p - step)) / (h * h);
      const double rounding = 1e-14 / (h * h);
      if (f + h < reach && least > -unbounded) {
        ++below;
        if (!(second >= least * (1 + 1e-9) - rounding)) ++over;
      }
      if (f - h > -reach && most < unbounded) {
        ++above;
        if (!(second <= most * (1 + 1e-9) + rounding)) ++over;
      }
    }
  }
  CHECK(over == 0);
  CHECK(below > 300000);
  CHECK(above > 300000);
}

TEST_CASE("Bounds of second derivatives are those of closed forms") {
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(b); };
  const Sdf ball = one_of(Ball{2});
  CHECK(renderer::bend_below(ball, 1) == 0);
  CHECK(near(renderer::bend_above(ball, 0.5), 1 / 1.5));
  CHECK(renderer::bend_above(ball, 2) == unbounded);  // its centre
  const Sdf torus = one_of(Torus{3, 1});
  CHECK(near(renderer::bend_below(torus, 0.5), 1 / 1.5));
  CHECK(near(renderer::bend_above(torus, 0.5), 2));
  CHECK(renderer::bend_below(torus, 2) == unbounded);  // its axis
  CHECK(renderer::bend_above(one_of(RoundedBox{dvec3(1), 0}), 1e-9) == unbounded);
  CHECK(renderer::bend_below(one_of(RoundedBox{dvec3(1), 0}), 9) == 0);
  // At a minimum's seam, between planes that fall towards each other: 2/k. The parts of a sharp
  // one meet in a crease.
  const Solid left{Ball{1}, {glm::dmat3(1), {-1, 0, 0}, 1}},
      right{Ball{1}, {glm::dmat3(1), {1, 0, 0}, 1}};
  const auto both = [&](Operation operation, double smoothing) {
    return Sdf{{left, right, Combine{operation, smoothing}}, {}, false};
  };
  CHECK(near(renderer::bend_below(both(Operation::unite, 0.1), 1), 20));
  CHECK(renderer::bend_below(both(Operation::unite, 0), 1) == unbounded);
  CHECK(renderer::bend_below(both(Operation::intersect, 0), 1) == 0);
  CHECK(near(renderer::bend_above(both(Operation::intersect, 0.1), 0.1), 20 + 1 / (1 - 0.225)));
  CHECK(near(renderer::bend_below(both(Operation::subtract, 0.1), 0.1), 1 / (1 - 0.1)));
}

TEST_CASE("Bounds of second derivatives scale with the sdf") {
  Rng rng(2);
  int compared = 0;
  for (int n = 0; n < 200; ++n) {
    const Sdf shape = random_sdf(rng);
    for (const double scale : {1e-4, 1e6}) {
      const Sdf scaled = sdf_cases::grown(shape, scale);
      const double size = SphereTracer(shape).size();
      if (!std::isfinite(size)) continue;  // empty, or an uncut gyroid
      ++compared;
      for (const auto near : {renderer::bend_below_near, renderer::bend_above_near}) {
        const renderer::Bend one = near(shape, size), other = near(scaled, scale * size);
        CHECK(std::abs(other.most * scale / one.most - 1) < 1e-9);
        CHECK(std::abs(other.reach - scale * one.reach) <= 1e-9 * scale * one.reach);
      }
    }
  }
  CHECK(compared > 200);
}
