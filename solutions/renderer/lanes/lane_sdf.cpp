#include "renderer/lanes/lane_sdf.h"

#include "geometry/sphere_tracer.h"
#include "numeric/robust.h"
#include "scene/match.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

namespace renderer {
namespace {

namespace sdf = carlo::sdf;
using Part = LaneSdf::Part;
using Step = LaneSdf::Step;

Step step_of(const sdf::Solid& solid) {
  Step step = carlo::match(
      solid.form, [](const sdf::Ball& f) { return Step{.part = Part::ball, .size = {f.radius}}; },
      [](const sdf::Torus& f) {
        return Step{.part = Part::torus, .size = {f.major, f.minor}};
      },
      [](const sdf::RoundedBox& f) {
        return Step{.part = Part::rounded_box, .size = {f.radius}, .a = f.half - f.radius};
      },
      [](const sdf::Capsule& f) {
        const glm::dvec3 along = f.b - f.a;
        return Step{.part = Part::capsule,
                    .size = {f.radius, 1 / glm::dot(along, along)},
                    .a = f.a,
                    .b = along};
      },
      [](const sdf::Gyroid& f) {
        const double frequency = 2 * carlo::pi / f.period;
        return Step{.part = Part::gyroid,
                    .size = {1 / f.period, 0.5 * f.thickness, 1 / (std::sqrt(3.0) * frequency)}};
      });
  step.turn = glm::transpose(solid.place.rotation) / solid.place.scale;
  step.origin = solid.place.origin;
  step.scale = solid.place.scale;
  return step;
}

Step step_of(const sdf::Combine& combine) {
  const auto of_part = [&](Part part) {
    return Step{.part = part, .smoothing = combine.smoothing};
  };
  switch (combine.operation) {
    case sdf::Operation::unite:
      return of_part(Part::unite);
    case sdf::Operation::intersect:
      return of_part(Part::intersect);
    case sdf::Operation::subtract:
      break;
  }
  return of_part(Part::subtract);
}

}  // namespace

LaneSdf lane_sdf(const carlo::Sdf& shape) {
  const carlo::SphereTracer tracer(shape);
  LaneSdf lanes{{},
                shape.place,
                shape.flipped,
                tracer.box(),
                bend_below_near(shape, tracer.size()),
                bend_above_near(shape, tracer.size()),
                tracer.size(),
                tracer.reach()};
  for (const sdf::Step& step : shape.steps) {
    const auto* solid = std::get_if<sdf::Solid>(&step);
    lanes.steps.push_back(solid != nullptr ? step_of(*solid)
                                           : step_of(std::get<sdf::Combine>(step)));
  }
  return lanes;
}

namespace {

namespace sdf = carlo::sdf;

enum class Side { below, above };
Side other(Side side) {
  return side == Side::below ? Side::above : Side::below;
}

/// The curvature of a distance's level sets at this distance from the shape.
double per(double distance) {
  return distance > 0 ? 1 / distance : std::numeric_limits<double>::infinity();
}

/// In the form's own coordinates. Distances to convex shapes are convex: their slopes never fall.
double bend_of(const sdf::Solid& solid, Side side, double reach) {
  const bool below = side == Side::below;
  return carlo::match(
      solid.form, [&](const sdf::Ball& f) { return below ? 0 : per(f.radius - reach); },
      [&](const sdf::Torus& f) {
        // Across the tube, and around the axis on the inside of the ring.
        return below ? per(f.major - f.minor - reach) : per(f.minor - reach);
      },
      [&](const sdf::RoundedBox& f) { return below ? 0 : per(f.radius - reach); },
      [&](const sdf::Capsule& f) { return below ? 0 : per(f.radius - reach); },
      [&](const sdf::Gyroid& f) {
        // Each of the three terms has second derivatives of at most 1 per (period/2 pi)^2 in any
        // direction; |g| has a crease in the middle of the wall.
        const bool creased = !below && !(reach < 0.5 * f.thickness);
        return creased ? per(0) : std::sqrt(3.0) * 2 * carlo::pi / f.period;
      });
}

/// Goes through the steps from last to first: the demands on each come from the steps that combine
/// it.
double bend(const carlo::Sdf& shape, Side root, double root_reach) {
  struct Asked {
    Side side;
    double reach;
    double more;  ///< added by combining
  };
  std::vector<Asked> waiting{{root, root_reach, 0}};
  double most = 0;
  for (auto step = shape.steps.rbegin(); step != shape.steps.rend(); ++step) {
    const Asked asked = waiting.back();
    waiting.pop_back();
    if (const auto* solid = std::get_if<sdf::Solid>(&*step)) {
      const double scale = solid->place.scale;
      most = std::max(most, asked.more + bend_of(*solid, asked.side, asked.reach / scale) / scale);
      continue;
    }
    const auto& combine = std::get<sdf::Combine>(*step);
    // The slope of a minimum falls where one part takes over from the other, over differences of
    // the smoothing k, by at most 2; there the parts are up to 5/4 k above it. The slope of a
    // maximum rises.
    const bool minimum = combine.operation == sdf::Operation::unite;
    Asked of_part = asked;
    if (minimum == (asked.side == Side::below)) {
      of_part.reach += 1.25 * combine.smoothing;
      of_part.more += 2 * per(combine.smoothing);
    }
    waiting.push_back(of_part);
    if (combine.operation == sdf::Operation::subtract) of_part.side = other(of_part.side);
    waiting.push_back(of_part);  // the second part, whose steps come last
  }
  return most;
}

/// Starting at the surface with a slope of 1/2, the next certain step is no longer than the reach
/// and than 1/bend.
Bend longest_steps(const carlo::Sdf& shape, Side side, double size) {
  // Even without a bend, steps are limited.
  const double least = 0.01 / size;
  Bend best{least, 0};
  double longest = 0;
  for (int halves = -6; halves < 40; ++halves) {  // reaches from 8 down to 1e-6 sizes
    const double reach = size * std::exp2(-0.5 * halves);
    const double most = std::max(bend(shape, side, reach), least);
    const double step = std::min({reach, size, 1 / most});
    if (!(step > longest)) continue;
    longest = step;
    best = {most, reach};
  }
  return best;
}

}  // namespace

double bend_below(const carlo::Sdf& shape, double reach) {
  return bend(shape, Side::below, reach);
}
double bend_above(const carlo::Sdf& shape, double reach) {
  return bend(shape, Side::above, reach);
}
Bend bend_below_near(const carlo::Sdf& shape, double size) {
  return longest_steps(shape, Side::below, size);
}
Bend bend_above_near(const carlo::Sdf& shape, double size) {
  return longest_steps(shape, Side::above, size);
}

}  // namespace renderer
