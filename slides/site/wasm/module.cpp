// The functions that JavaScript sees. Results stay valid until the next call.

#include "call.h"
#include "tool/figure.h"

namespace {
site::Numbers results;
std::string svg;
}  // namespace

extern "C" {

/// Calls a function of call.h; returns how many numbers it gives.
int site_call(const char* name, const double* arguments, int count) {
  results = site::Function::call(name, {arguments, static_cast<std::size_t>(count)});
  return static_cast<int>(results.size());
}

const double* site_results() {
  return results.data();
}

/// Draws a plot (tool/figure.h) as SVG.
const char* site_plot(const char* json) {
  svg = carlo::figure_svg(json);
  return svg.c_str();
}
}

// The module has no triangles: Embree's part of them (embree4/rtcore.h) is left out.
#include "geometry/embree.h"
#include "geometry/mesh_tracer.h"
#include "support/error.h"

namespace carlo {

RTCGeometry embree_triangles(RTCDevice, const Mesh&) {
  throw Error("the site has no triangles");
}
TrianglePoint triangle_point(const Mesh&, std::uint32_t, float, float) {
  throw Error("the site has no triangles");
}
TriangleHit triangle_hit(const Mesh&, std::uint32_t, Vec3, Vec3, const TriangleHit&) {
  throw Error("the site has no triangles");
}
Vec3 shading_normal(const Mesh&, std::uint32_t, float, float, Vec3, Vec3) {
  throw Error("the site has no triangles");
}

}  // namespace carlo
