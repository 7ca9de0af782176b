#include "renderer/lanes/lane_sdf.h"

#include "geometry/sphere_tracer.h"
#include "numeric/robust.h"
#include "scene/match.h"

#include <cmath>

namespace renderer {
namespace {

namespace sdf = carlo::sdf;
using Kind = LaneSdf::Kind;
using Step = LaneSdf::Step;

Step step_of(const sdf::Solid& solid) {
  Step step = carlo::match(
      solid.form, [](const sdf::Ball& f) { return Step{.kind = Kind::ball, .size = {f.radius}}; },
      [](const sdf::Torus& f) {
        return Step{.kind = Kind::torus, .size = {f.major, f.minor}};
      },
      [](const sdf::RoundedBox& f) {
        return Step{.kind = Kind::rounded_box, .size = {f.radius}, .a = f.half - f.radius};
      },
      [](const sdf::Capsule& f) {
        const glm::dvec3 along = f.b - f.a;
        return Step{.kind = Kind::capsule,
                    .size = {f.radius, 1 / glm::dot(along, along)},
                    .a = f.a,
                    .b = along};
      },
      [](const sdf::Gyroid& f) {
        const double frequency = 2 * carlo::pi / f.period;
        return Step{.kind = Kind::gyroid,
                    .size = {frequency, 0.5 * f.thickness, std::sqrt(3.0) * frequency}};
      });
  step.turn = glm::transpose(solid.place.rotation) / solid.place.scale;
  step.origin = solid.place.origin;
  step.scale = solid.place.scale;
  return step;
}

Step step_of(const sdf::Combine& combine) {
  const auto of_kind = [&](Kind kind) {
    return Step{.kind = kind, .smoothing = combine.smoothing};
  };
  switch (combine.operation) {
    case sdf::Operation::unite:
      return of_kind(Kind::unite);
    case sdf::Operation::intersect:
      return of_kind(Kind::intersect);
    case sdf::Operation::subtract:
      break;
  }
  return of_kind(Kind::subtract);
}

}  // namespace

LaneSdf lane_sdf(const carlo::Sdf& shape) {
  const carlo::SphereTracer tracer(shape);
  LaneSdf lanes{{}, shape.place, shape.flipped, tracer.box(), tracer.size(), tracer.reach()};
  for (const sdf::Step& step : shape.steps)
    lanes.steps.push_back(carlo::match(
        step, [](const sdf::Solid& solid) { return step_of(solid); },
        [](const sdf::Combine& combine) { return step_of(combine); }));
  return lanes;
}

}  // namespace renderer
