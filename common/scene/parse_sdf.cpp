#include "scene/sdf.h"
#include "scene/shapes.h"
#include "scene/transforms.h"
#include "scene/values.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

double number(Properties& shape, const std::string& name, float otherwise) {
  return static_cast<double>(shape.number(name).value_or(otherwise));
}

sdf::Solid parse_ball(Properties& shape) {
  const Vec3d center = shape.point("center").value_or(Vec3d(0));
  return {sdf::Ball{number(shape, "radius", 1)}, {glm::dmat3(1), center, 1}};
}

sdf::Solid parse_torus(Properties& shape) {
  const double major = number(shape, "majorRadius", 1.0f);
  const double minor = number(shape, "minorRadius", 0.25f);
  if (!(minor < major)) {
    fail(shape.at("minorRadius"), "minorRadius must be less than majorRadius, {}, got {}", major,
         minor);
  }
  return {sdf::Torus{major, minor}, {}};
}

sdf::Solid parse_rounded_box(Properties& shape) {
  const Vec3d half = shape.point("halfSize").value_or(Vec3d(1));
  const double least = std::min({half.x, half.y, half.z});
  if (!(least > 0)) {
    fail(shape.at("halfSize"), "halfSize must be > 0 in x, y and z, got {}, {}, {}", half.x, half.y,
         half.z);
  }
  const double radius = number(shape, "radius", 0.1f);
  // A radius from the file has only float precision.
  if (!(radius >= 0 && radius <= least * (1 + 1e-6))) {
    fail(shape.at("radius"), "radius must be within [0, {}], the least half size, got {}", least,
         radius);
  }
  return {sdf::RoundedBox{half, std::min(radius, least)}, {}};
}

sdf::Solid parse_capsule(Properties& shape) {
  const Vec3d a = shape.point("p0").value_or(Vec3d(0, 0, 0));
  const Vec3d b = shape.point("p1").value_or(Vec3d(0, 0, 1));
  const double radius = number(shape, "radius", 1);
  if (!(glm::length(b - a) > 0)) fail(shape.at("p1"), "p0 and p1 are the same point");
  return {sdf::Capsule{a, b, radius}, {}};
}

sdf::Solid parse_gyroid(Properties& shape) {
  const double period = number(shape, "period", 1.0f);
  const double thickness = number(shape, "thickness", 0.1f);
  if (!(thickness < 0.25 * period)) {
    fail(shape.at("thickness"), "thickness must be less than a quarter of the period, {}, got {}",
         0.25 * period, thickness);
  }
  return {sdf::Gyroid{period, thickness}, {}};
}

sdf::Solid parse_solid(Properties& shape) {
  const std::string type = shape.type();
  if (type == "sphere") return parse_ball(shape);
  if (type == "torus") return parse_torus(shape);
  if (type == "roundedBox") return parse_rounded_box(shape);
  if (type == "capsule") return parse_capsule(shape);
  if (type == "gyroid") return parse_gyroid(shape);
  throw std::logic_error("no solid is made of the shape " + type);
}

Similarity parse_place(Properties& shape) {
  const auto place = similarity(shape.to_world());
  if (!place) fail(shape.at("toWorld"), "non-uniform scale of an sdf is not supported");
  return *place;
}

sdf::Combine parse_combine(Properties& group) {
  const XmlElement* operation = group.take("operation");
  return {operation != nullptr ? operation_value(*operation) : sdf::Operation::unite,
          number(group, "smoothing", 0)};
}

void parse_child(const XmlElement& element, const Similarity& frame, std::vector<sdf::Step>& steps,
                 SceneErrors& errors);

/// Appends the steps of all shapes inside `group`, with `frame` mapping its coordinates to those of
/// the whole sdf. At most one result waits for each enclosing sdf: fewer than sdf::most_waiting,
/// since elements of a scene file are nested at most 16 deep.
void parse_group(Properties& group, const Similarity& frame, std::vector<sdf::Step>& steps,
                 SceneErrors& errors) {
  const std::vector<const XmlElement*> children = group.objects("shape");
  sdf::Combine combine = parse_combine(group);
  combine.smoothing *= frame.scale;
  if (children.empty()) fail(group.object_at(), "an sdf needs at least one <shape> inside");
  for (const char* name : {"operation", "smoothing"}) {
    if (children.size() > 1 || !group.has(name)) continue;
    fail(group.at(name), "{} needs at least two shapes inside the sdf, got 1", name);
  }
  for (std::size_t i = 0; i < children.size(); ++i) {
    if (!children[i]->broken) {
      errors.guard([&] { parse_child(*children[i], frame, steps, errors); });
    }
    if (i > 0) steps.emplace_back(combine);
  }
}

void parse_child(const XmlElement& element, const Similarity& frame, std::vector<sdf::Step>& steps,
                 SceneErrors& errors) {
  Properties child(element);
  const Similarity place = frame * parse_place(child);
  if (child.type() == "sdf") {
    parse_group(child, place, steps, errors);
  } else {
    sdf::Solid solid = parse_solid(child);
    solid.place = place * solid.place;
    steps.emplace_back(solid);
  }
  child.finish();
}

/// True if the shapes inside `group` have no errors of their own.
bool all_good(const Properties& group) {
  const std::vector<const XmlElement*> shapes = group.objects("shape");
  return std::all_of(shapes.begin(), shapes.end(), [](const XmlElement* shape) {
    return !shape->broken && all_good(Properties(*shape));
  });
}

/// Refuses sdfs whose box float cannot represent.
void check_bounds(const Sdf& sdf, const Properties& shape) {
  const sdf::Box box = sdf::bounds(sdf, sdf.place);
  for (int i = 0; i < 3; ++i) {
    if (std::isinf(box.upper[i]) || std::isinf(box.lower[i])) {
      fail(shape.object_at(), "the sdf has no bounds: intersect the gyroid with another shape");
    }
    if (!(box.lower[i] <= box.upper[i])) {
      fail(shape.object_at(), "the sdf is empty: its shapes do not meet");
    }
  }
  const float size =
      glm::length(transform_vector(glm::dmat4(1), box.upper - box.lower, shape.at("toWorld")));
  transform_point(glm::dmat4(1), box.lower, shape.at("toWorld"));
  transform_point(glm::dmat4(1), box.upper, shape.at("toWorld"));
  if (!(size > 0) || !std::isfinite(size)) {
    fail(shape.at("toWorld"), "the sdf's size after toWorld is {}, out of float's range", size);
  }
}

}  // namespace

Sdf parse_sdf(Properties& shape, SceneErrors& errors) {
  if (const XmlElement* emitter = shape.object("emitter")) {
    errors.guard([&] {
      fail(emitter->at,
           "an sdf cannot emit: lights are sampled by area, and it has none that is known");
    });
  }
  Sdf sdf;
  sdf.place = parse_place(shape);
  sdf.flipped = shape.boolean("flipNormals").value_or(false);
  const std::size_t before = errors.count();
  parse_group(shape, {}, sdf.steps, errors);
  // If some of its shapes are wrong, nothing can be said about the rest.
  if (errors.count() == before && all_good(shape)) check_bounds(sdf, shape);
  return sdf;
}

}  // namespace carlo
