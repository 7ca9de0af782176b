#include "renderer/lanes/lane_sdf.h"

#include "geometry/sphere_tracer.h"
#include "numeric/robust.h"
#include "scene/match.h"

#include <cmath>
#include <variant>

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

}  // namespace renderer
