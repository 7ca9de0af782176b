#include "scenes.h"

#include "numeric/robust.h"

#include <cmath>

namespace lab07 {
namespace {

using carlo::pi;

bool hits_ball(Vec3 centre, float radius, Vec3 p, Vec3 wi) {
  const Vec3 to_centre = centre - p;
  const float along = glm::dot(to_centre, wi);
  const Vec3 off = to_centre - along * wi;
  return along > 0 && glm::dot(off, off) < radius * radius;
}

bool hits_disk(Vec3 centre, float radius, Vec3 p, Vec3 wi) {
  if (!(wi.z > 0)) return false;
  const Vec3 at = p + (centre.z - p.z) / wi.z * wi - centre;
  return at.x * at.x + at.y * at.y < radius * radius;
}

/// True if the ray meets the wall x = -1, of height 1, that runs from y = -1 to 1.
bool hits_wall(Vec3 p, Vec3 wi) {
  if (!(wi.x < 0)) return false;
  const float t = (-1 - p.x) / wi.x;
  return p.z + t * wi.z < 1 && std::abs(p.y + t * wi.y) < 1;
}

Vec3 swapped(Vec3 v) {
  return {v.y, v.x, v.z};
}

/// The irradiance from a ball of radiance 1, entirely above the horizon: pi cos(theta) / H^2, with
/// H its distance in radii.
double ball_irradiance(Vec3 centre, double radius, Vec3 p) {
  const glm::dvec3 d = glm::dvec3(centre) - glm::dvec3(p);
  const double distance = glm::length(d);
  return pi * d.z / distance * (radius / distance) * (radius / distance);
}

/// The irradiance from a parallel disk.
double disk_irradiance(Vec3 centre, double radius, Vec3 p) {
  const glm::dvec3 d = glm::dvec3(centre) - glm::dvec3(p);
  const double offset2 = d.x * d.x + d.y * d.y, r2 = radius * radius, a = offset2 + d.z * d.z;
  return pi / 2 * (1 - (a - r2) / std::sqrt((a + r2) * (a + r2) - 4 * r2 * offset2));
}

/// The irradiance from a wall of height 1 and this width, at this distance from a point in front of
/// its edge.
double wall_irradiance(double distance, double width) {
  const double x = 1 / width, y = distance / width, r = std::hypot(x, y);
  return 0.5 * (std::atan(1 / y) - y / r * std::atan(1 / r));
}

double two_walls_irradiance(Vec3 p) {
  const double x = p.x, y = p.y;
  return wall_irradiance(x + 1, 1 + y) + wall_irradiance(x + 1, 1 - y) +
         wall_irradiance(y + 1, 1 + x) + wall_irradiance(y + 1, 1 - x);
}

}  // namespace

std::vector<Scene> scenes() {
  const Vec3 light(0, 0, 1), ball(0.2f, -0.2f, 1), stone(0, 0, 0.5f);
  constexpr float light_radius = 0.6f, ball_radius = 0.25f, stone_radius = 0.5f;
  return {
      {"Round light", "Irradiance under a disk of radius 0.6 at height 1", true, 2,
       [=](Vec3 p, Vec3 wi) { return hits_disk(light, light_radius, p, wi); },
       [=](Vec3 p) { return disk_irradiance(light, light_radius, p); }, light, light_radius},
      {"Glowing ball", "Irradiance under a ball of radius 0.25 at height 1", true, 2,
       [=](Vec3 p, Vec3 wi) { return hits_ball(ball, ball_radius, p, wi); },
       [=](Vec3 p) { return ball_irradiance(ball, ball_radius, p); }, ball, ball_radius},
      {"Ball on the floor", "Ambient occlusion by a ball of radius 0.5 that touches the floor",
       false, 1.5f, [=](Vec3 p, Vec3 wi) { return hits_ball(stone, stone_radius, p, wi); },
       [=](Vec3 p) { return 1 - ball_irradiance(stone, stone_radius, p) / pi; }, stone,
       stone_radius},
      {"Two walls",
       "Ambient occlusion in a corner, walls of height 1",
       false,
       1,
       [](Vec3 p, Vec3 wi) { return hits_wall(p, wi) || hits_wall(swapped(p), swapped(wi)); },
       [](Vec3 p) { return 1 - two_walls_irradiance(p) / pi; },
       {},
       0},
  };
}

}  // namespace lab07
