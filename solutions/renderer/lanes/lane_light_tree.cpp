#include "renderer/lanes/lane_light_tree.h"

#include <algorithm>
#include <numeric>

namespace renderer {
namespace {

using Vec3d = glm::dvec3;
using Members = std::vector<std::uint32_t>;

struct LightBuilder {
  const std::vector<LaneLight>& lights;
  double all;  ///< strengths are divided by this, so that their products fit into floats
  LaneLightTree& tree;

  void build(const std::vector<Members>& parts, std::uint32_t parent, std::uint32_t place) {
    const auto node = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.emplace_back();
    tree.nodes[node].round.fill(1);
    tree.nodes[node].parent = parent, tree.nodes[node].place = place;
    for (std::uint32_t c = 0; c < parts.size(); ++c) {
      describe(tree.nodes[node], c, parts[c]);
      if (parts[c].size() == 1) {
        tree.nodes[node].child.at(c) = LaneLightTree::leaf | parts[c][0];
        tree.leaf_of[parts[c][0]] = {node, c};
        continue;
      }
      tree.nodes[node].child.at(c) = static_cast<std::uint32_t>(tree.nodes.size());
      build(divide(parts[c], LaneLightTree::width), node, c);
    }
  }

  std::vector<Members> divide(const Members& members, std::size_t most) const {
    std::vector<LightBounds> placed;
    for (const std::uint32_t i : members)
      placed.push_back(bounds_of(lights[i]));
    std::vector<Members> parts = LightTree(placed).groups(most);
    for (Members& part : parts) {
      for (std::uint32_t& i : part)
        i = members[i];
    }
    return parts;
  }

  void describe(LaneLightTree::Node& node, std::size_t c, const Members& members) const {
    const auto as_float = [](double x) { return static_cast<float>(x); };
    Vec3d lower(lights[members[0]].middle), upper(lower);
    double strength = 0;
    for (const std::uint32_t i : members) {
      lower = glm::min(lower, lights[i].middle);
      upper = glm::max(upper, lights[i].middle);
      strength += lights[i].strength;
    }
    const Vec3d middle = 0.5 * (lower + upper);
    double reach = 0;
    for (const std::uint32_t i : members)
      reach = std::max(reach, glm::length(lights[i].middle - middle) + lights[i].reach);
    node.middle_x.at(c) = as_float(middle.x), node.middle_y.at(c) = as_float(middle.y);
    node.middle_z.at(c) = as_float(middle.z);
    const Vec3d size = glm::abs(middle);
    // Rounding must not push lights out of their sphere.
    node.reach.at(c) = as_float(reach * (1 + 1e-6) + 2e-7 * (size.x + size.y + size.z));
    node.strength.at(c) = as_float(strength / all);
    face_one_way(node, c, members);
  }

  /// Describes what lies in front of lights that face the same way.
  void face_one_way(LaneLightTree::Node& node, std::size_t c, const Members& members) const {
    const auto& first = lights[members[0]].plane;
    if (!first) return;
    double d = first->d;
    for (const std::uint32_t i : members) {
      const auto& plane = lights[i].plane;
      if (!plane || plane->normal != first->normal) return;
      d = std::min(d, plane->d);
    }
    node.round.at(c) = 0;
    node.nx.at(c) = static_cast<float>(first->normal.x);
    node.ny.at(c) = static_cast<float>(first->normal.y);
    node.nz.at(c) = static_cast<float>(first->normal.z);
    node.d.at(c) = static_cast<float>(d);
  }
};

}  // namespace

LightBounds bounds_of(const LaneLight& light) {
  const Vec3d half(light.reach);
  const Vec3d axis = light.plane ? light.plane->normal : Vec3d(0);
  return {light.middle - half, light.middle + half, axis, light.plane ? 1.0 : -1.0, light.strength};
}

LaneLightTree::LaneLightTree(const std::vector<LaneLight>& lights) : leaf_of(lights.size()) {
  Members placed;
  std::optional<std::uint32_t> around;
  double all = 0;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    all += lights[i].strength;
    if (lights[i].everywhere)
      around = i;
    else
      placed.push_back(i);
  }
  const LightBuilder builder{lights, all > 0 ? all : 1, *this};
  std::vector<Members> parts = builder.divide(placed, around ? width - 1 : width);
  if (around) {
    sky = static_cast<std::uint32_t>(parts.size());
    parts.push_back({*around});
  }
  LightBuilder{builder}.build(parts, 0, 0);
}

}  // namespace renderer
