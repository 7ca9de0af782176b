#include "renderer/flat/flat_scene.h"

#include "numeric/robust.h"

#include <algorithm>
#include <cmath>

namespace renderer {
namespace {

using carlo::Parallelogram;
using carlo::Rgb;
using carlo::Vec3;
using Vec3d = glm::dvec3;

struct Reflectances {
  Rgb kd{0}, ks{0};
  float exponent = 0;
};

Reflectances reflectances(const carlo::Material& material) {
  if (const auto* diffuse = std::get_if<carlo::Diffuse>(&material.model)) {
    return {diffuse->reflectance, Rgb(0), 0};
  }
  const auto& phong = std::get<carlo::Phong>(material.model);
  return {phong.kd, phong.ks, phong.exponent};
}

double sum(Rgb c) {
  return static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b);
}

void add_plane(FlatScene& flat, std::size_t i, const Parallelogram& quad) {
  const Vec3d o(quad.origin), u(quad.u), v(quad.v), n = glm::normalize(glm::cross(u, v));
  // The dual vectors: a . u = 2, a . v = 0, and the other way round.
  const Vec3d across = glm::cross(v, n), a = 2.0 * across / glm::dot(across, u);
  const Vec3d along = glm::cross(n, u), b = 2.0 * along / glm::dot(along, v);
  const auto f = [](double x) { return static_cast<float>(x); };
  flat.nx[i] = f(n.x), flat.ny[i] = f(n.y), flat.nz[i] = f(n.z);
  flat.d[i] = f(glm::dot(n, o));
  flat.ax[i] = f(a.x), flat.ay[i] = f(a.y), flat.az[i] = f(a.z);
  flat.a0[i] = f(glm::dot(a, o) + 1);
  flat.bx[i] = f(b.x), flat.by[i] = f(b.y), flat.bz[i] = f(b.z);
  flat.b0[i] = f(glm::dot(b, o) + 1);
}

void add_material(FlatScene& flat, std::size_t i, const carlo::Material& material) {
  const Reflectances r = reflectances(material);
  flat.kd_r[i] = r.kd.r, flat.kd_g[i] = r.kd.g, flat.kd_b[i] = r.kd.b;
  flat.ks_r[i] = r.ks.r, flat.ks_g[i] = r.ks.g, flat.ks_b[i] = r.ks.b;
  flat.exponent[i] = r.exponent;
  const double d = sum(r.kd), s = sum(r.ks);
  flat.diffuse[i] = d + s > 0 ? static_cast<float>(d / (d + s)) : 1;
  flat.two_sided[i] = material.two_sided ? 1 : 0;
  flat.phong = flat.phong || r.ks != Rgb(0);
  flat.one_sided = flat.one_sided || !material.two_sided;
}

double area(const Parallelogram& quad) {
  return glm::length(glm::cross(Vec3d(quad.u), Vec3d(quad.v)));
}

void add_light(FlatScene& flat, std::size_t i, const Parallelogram& quad, double running,
               double chance) {
  const std::size_t l = flat.lights++;
  flat.lx[l] = quad.origin.x, flat.ly[l] = quad.origin.y, flat.lz[l] = quad.origin.z;
  flat.lux[l] = quad.u.x, flat.luy[l] = quad.u.y, flat.luz[l] = quad.u.z;
  flat.lvx[l] = quad.v.x, flat.lvy[l] = quad.v.y, flat.lvz[l] = quad.v.z;
  flat.light_quad[l] = static_cast<std::uint32_t>(i);
  flat.light_cdf[l] = static_cast<float>(running);
  flat.light_density[i] = static_cast<float>(chance / area(quad));
}

}  // namespace

bool FlatScene::suits(const carlo::Needs& needs) {
  return needs.parallelograms == needs.primitives() && needs.parallelograms <= most &&
         needs.point_lights == 0 && !needs.mirror && !needs.dielectric;
}

FlatScene::FlatScene(const carlo::Scene& scene) {
  double power = 0;
  float reach = 0;
  for (const carlo::Shape& shape : scene.shapes) {
    const auto& quad = std::get<Parallelogram>(shape.geometry);
    power += area(quad) * sum(shape.radiance);
    const Vec3 far = glm::abs(quad.origin) + glm::abs(quad.u) + glm::abs(quad.v);
    reach = std::max({reach, far.x, far.y, far.z});
  }
  slack = carlo::rounding_bound(8) * reach;
  environment[0] = scene.environment.r;
  environment[1] = scene.environment.g;
  environment[2] = scene.environment.b;
  double running = 0;
  for (const carlo::Shape& shape : scene.shapes) {
    const auto& quad = std::get<Parallelogram>(shape.geometry);
    const std::size_t i = quads++;
    add_plane(*this, i, quad);
    add_material(*this, i, scene.materials[shape.material]);
    le_r[i] = shape.radiance.r, le_g[i] = shape.radiance.g, le_b[i] = shape.radiance.b;
    if (!shape.emits()) continue;
    const double chance = area(quad) * sum(shape.radiance) / power;
    running += chance;
    add_light(*this, i, quad, running, chance);
  }
}

}  // namespace renderer
