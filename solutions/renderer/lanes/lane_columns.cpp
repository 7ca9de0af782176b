#include "renderer/lanes/lane_columns.h"

#include "numeric/robust.h"
#include "scene/match.h"

#include <cmath>

namespace renderer {

using carlo::Parallelogram;
using carlo::Rgb;
using carlo::Vec3;
using Vec3d = glm::dvec3;

Reflectances reflectances(const carlo::Material& material) {
  return carlo::match(
      material.model, [](const carlo::Diffuse& m) { return Reflectances{m.reflectance}; },
      [](const carlo::Phong& m) {
        return Reflectances{m.kd, m.ks, m.exponent};
      },
      [](const carlo::Mirror& m) {
        return Reflectances{Rgb(0), m.reflectance, 0, true};
      },
      [](const carlo::Dielectric& m) {
        return Reflectances{Rgb(0), Rgb(0), 0, true, m.int_ior / m.ext_ior};
      });
}

double sum(Rgb c) {
  return static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b);
}

void add_plane(LaneScene& lanes, std::size_t i, const Parallelogram& quad) {
  const Vec3d o(quad.origin), u(quad.u), v(quad.v), n = glm::normalize(glm::cross(u, v));
  // The dual vectors: a . u = 2, a . v = 0, and vice versa for b.
  const Vec3d across = glm::cross(v, n), a = 2.0 * across / glm::dot(across, u);
  const Vec3d along = glm::cross(n, u), b = 2.0 * along / glm::dot(along, v);
  lanes.nx[i] = rounded(n.x), lanes.ny[i] = rounded(n.y), lanes.nz[i] = rounded(n.z);
  lanes.d[i] = rounded(glm::dot(n, o));
  lanes.ax[i] = rounded(a.x), lanes.ay[i] = rounded(a.y), lanes.az[i] = rounded(a.z);
  lanes.a0[i] = rounded(glm::dot(a, o) + 1);
  lanes.bx[i] = rounded(b.x), lanes.by[i] = rounded(b.y), lanes.bz[i] = rounded(b.z);
  lanes.b0[i] = rounded(glm::dot(b, o) + 1);
}

void add_material(LaneScene& lanes, const carlo::Material& material) {
  const std::size_t i = lanes.materials++;
  const Reflectances r = reflectances(material);
  const double lobe = r.specular ? 1 : (static_cast<double>(r.exponent) + 2) / (2 * carlo::pi);
  const Vec3d kd = Vec3d(r.kd) / carlo::pi, ks = Vec3d(r.ks) * lobe;
  lanes.kd_r[i] = rounded(kd.r), lanes.kd_g[i] = rounded(kd.g), lanes.kd_b[i] = rounded(kd.b);
  lanes.ks_r[i] = rounded(ks.r), lanes.ks_g[i] = rounded(ks.g), lanes.ks_b[i] = rounded(ks.b);
  lanes.exponent[i] = r.exponent;
  const double d = sum(r.kd), s = sum(r.ks);
  lanes.diffuse[i] = d + s > 0 ? rounded(d / (d + s)) : 1;
  lanes.specular[i] = r.specular ? 1 : 0;
  lanes.ior[i] = r.ior;
  lanes.two_sided[i] = material.two_sided || r.ior > 0 ? 1 : 0;
}

double area(const Parallelogram& quad) {
  return glm::length(glm::cross(Vec3d(quad.u), Vec3d(quad.v)));
}
double area(const carlo::Disk& disk) {
  const double r = disk.radius;
  return carlo::pi * r * r;
}
double area(const carlo::Sphere& sphere) {
  const double r = sphere.radius;
  return 4 * carlo::pi * r * r;
}

void add_edges(LaneScene& lanes, std::size_t l, Vec3 o, Vec3 u, Vec3 v) {
  lanes.lx[l] = o.x, lanes.ly[l] = o.y, lanes.lz[l] = o.z;
  lanes.lux[l] = u.x, lanes.luy[l] = u.y, lanes.luz[l] = u.z;
  lanes.lvx[l] = v.x, lanes.lvy[l] = v.y, lanes.lvz[l] = v.z;
}

}  // namespace renderer
