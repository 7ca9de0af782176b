#include "renderer/lanes/lane_lights.h"

#include "renderer/lanes/lane_kernel.h"
#include "renderer/light_tree.h"

#include <algorithm>
#include <cmath>

namespace renderer {
namespace {

using Vec3d = glm::dvec3;
using Light = LaneLights::Light;
using Members = std::vector<std::uint32_t>;

float as_float(double x) {
  return static_cast<float>(x);
}

/// The plane that all of them share, if there is one.
std::optional<Light::Plane> plane_of(const std::vector<Light>& lights, const Members& members) {
  const auto& first = lights[members[0]].plane;
  const bool shared = std::all_of(members.begin(), members.end(), [&](std::uint32_t i) {
    const auto& plane = lights[i].plane;
    return first && plane && plane->normal == first->normal && plane->d == first->d;
  });
  return shared ? first : std::nullopt;
}

/// All 0 if all weights are 0.
std::vector<double> shares(std::vector<double> weights) {
  double all = 0;
  for (const double w : weights)
    all += w;
  for (double& w : weights)
    w = all > 0 ? w / all : 0;
  return weights;
}

/// Reserves one sixteenth, divided equally among those that have a share.
std::vector<double> none_left_out(std::vector<double> shares) {
  const auto some = std::count_if(shares.begin(), shares.end(), [](double s) { return s > 0; });
  for (double& s : shares) {
    if (s > 0) s = (1 - LightTree::floor) * s + LightTree::floor / static_cast<double>(some);
  }
  return shares;
}

/// Running sums up to 1, in multiples of 2^-24.
std::vector<double> running(const std::vector<double>& shares) {
  std::vector<double> result;
  double sum = 0;
  for (const double share : shares) {
    sum += share;
    result.push_back(std::min(std::round(sum * 0x1p24) * 0x1p-24, 1.0));
  }
  return result;
}

}  // namespace

LaneLights::LaneLights(const std::vector<Light>& lights) {
  if (lights.empty()) return;
  share_out_starts(lights);
  if (lights.size() > few) {
    tree = LaneLightTree(lights);
    return;
  }
  // Groups by kind, with the lights of one plane together, so that it is known what lies in front
  // of it.
  std::vector<LightBounds> placed;
  Members placed_as;
  std::vector<Members> groups_of;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (lights[i].everywhere) {
      groups_of.push_back({i});
      continue;
    }
    placed.push_back(bounds_of(lights[i]));
    placed_as.push_back(i);
  }
  if (!placed.empty()) {
    for (Members& group : LightTree(placed).groups(most_groups - groups_of.size())) {
      for (std::uint32_t& i : group)
        i = placed_as[i];
      groups_of.push_back(std::move(group));
    }
  }
  const auto round = std::stable_partition(groups_of.begin(), groups_of.end(), [&](auto& group) {
    return plane_of(lights, group).has_value();
  });
  first_round = static_cast<std::uint32_t>(round - groups_of.begin());
  double brightest = 0;
  for (const Light& light : lights)
    brightest = std::max(brightest, light.strength);
  for (const Members& group : groups_of)
    add_group(lights, group, brightest);
}

void LaneLights::add_group(const std::vector<Light>& lights, const Members& members,
                           double brightest) {
  const std::uint32_t g = groups++;
  first[g] = g == 0 ? 0 : first[g - 1] + size[g - 1];
  size[g] = static_cast<std::uint32_t>(members.size());
  largest = std::max(largest, size[g]);
  Vec3d lower(lights[members[0]].middle), upper(lower);
  std::vector<double> strengths;
  double all = 0;
  for (const std::uint32_t i : members) {
    lower = glm::min(lower, lights[i].middle);
    upper = glm::max(upper, lights[i].middle);
    strengths.push_back(lights[i].strength);
    all += lights[i].strength;
    group[i] = g;
  }
  const Vec3d middle = 0.5 * (lower + upper);
  double furthest = 0;
  for (const std::uint32_t i : members)
    furthest = std::max(furthest, glm::length(lights[i].middle - middle) + lights[i].reach);
  middle_x[g] = as_float(middle.x), middle_y[g] = as_float(middle.y),
  middle_z[g] = as_float(middle.z);
  // Rounding must not push lights out of their sphere.
  reach[g] = as_float(furthest * (1 + 1e-6));
  strength[g] = as_float(all / brightest);
  if (lights[members[0]].everywhere) sky = g;
  if (const auto plane = plane_of(lights, members)) {
    nx[g] = as_float(plane->normal.x), ny[g] = as_float(plane->normal.y),
    nz[g] = as_float(plane->normal.z);
    d[g] = as_float(plane->d);
  }
  const std::vector<double> sums = running(shares(strengths));
  for (std::size_t k = 0; k < members.size(); ++k) {
    member[first[g] + k] = members[k];
    upto[first[g] + k] = k + 1 == members.size() ? 1.0f : as_float(sums[k]);
    share[members[k]] = upto[first[g] + k] - (k == 0 ? 0 : upto[first[g] + k - 1]);
  }
}

void LaneLights::share_out_starts(const std::vector<Light>& lights) {
  std::vector<double> powers;
  for (const Light& light : lights)
    powers.push_back(light.power);
  const std::vector<double> sums = running(none_left_out(shares(powers)));
  start_upto = start_probability = Column<float>(sums.size());
  for (std::size_t l = 0; l < sums.size(); ++l) {
    start_upto[l] = as_float(sums[l]);
    start_probability[l] = start_upto[l] - (l == 0 ? 0 : start_upto[l - 1]);
  }
}

namespace {

/// Holds all pixels of the film that may see light i, a parallelogram.
FilmRectangle on_film(const LaneScene& s, std::uint32_t i, const carlo::Camera& camera, int columns,
                      int rows) {
  const Vec3d o(camera.origin), corner(s.lx[i], s.ly[i], s.lz[i]), u(s.lux[i], s.luy[i], s.luz[i]),
      v(s.lvx[i], s.lvy[i], s.lvz[i]);
  const double width = columns, height = rows;
  Vec3d lower(width, height, 0), upper(0);
  int behind = 0;
  for (const Vec3d& p : {corner, corner + u, corner + v, corner + u + v}) {
    const Vec3d d = p - o;
    const double z = glm::dot(d, Vec3d(camera.forward));
    if (!(z > 1e-3 * glm::length(d))) {
      ++behind;
      continue;
    }
    const double per_x = 0.5 * width / (z * static_cast<double>(camera.tan_half_x)),
                 per_y = 0.5 * height / (z * static_cast<double>(camera.tan_half_y));
    const Vec3d at(0.5 * width + per_x * glm::dot(d, Vec3d(camera.right)),
                   0.5 * height - per_y * glm::dot(d, Vec3d(camera.up)), 0);
    // Rays meet it by coordinates in float.
    const double error = 1e-5 * (glm::length(p) + glm::length(o));
    const Vec3d margin(0.01 + per_x * error, 0.01 + per_y * error, 0);
    lower = glm::min(lower, at - margin), upper = glm::max(upper, at + margin);
  }
  if (behind == 4) return {0, 0, 0, 0};
  if (behind > 0) return {0, 0, columns, rows};
  lower = glm::clamp(lower, Vec3d(0), Vec3d(width, height, 0));
  upper = glm::clamp(upper, Vec3d(0), Vec3d(width, height, 0));
  return {static_cast<int>(lower.x), static_cast<int>(lower.y),
          static_cast<int>(std::ceil(upper.x)), static_cast<int>(std::ceil(upper.y))};
}

}  // namespace

std::vector<FilmRectangle> seen_lights(const LaneScene& scene, const carlo::Camera& camera,
                                       int width, int height) {
  if (!scene.flat_lights || !scene.straight()) return {};
  std::vector<FilmRectangle> found;
  double pixels = 0;
  for (std::uint32_t i = 0; i < scene.first_point; ++i) {
    const FilmRectangle at = on_film(scene, i, camera, width, height);
    found.push_back(at);
    pixels += static_cast<double>(at.x1 - at.x0) * (at.y1 - at.y0);
  }
  const double all = static_cast<double>(width) * height;
  return pixels > 0 && 16 * pixels <= all ? found : std::vector<FilmRectangle>();
}

}  // namespace renderer
