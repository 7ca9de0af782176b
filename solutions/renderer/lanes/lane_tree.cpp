#include "renderer/lanes/lane_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace renderer {
namespace {

using Vec3d = glm::dvec3;
using Items = std::span<std::size_t>;

constexpr double infinite = std::numeric_limits<double>::infinity();

Extent around(const std::vector<Extent>& extents, std::span<const std::size_t> items) {
  Extent all{Vec3d(infinite), Vec3d(-infinite)};
  for (const std::size_t i : items) {
    all.lower = glm::min(all.lower, extents[i].lower);
    all.upper = glm::max(all.upper, extents[i].upper);
  }
  return all;
}

double half_area(const Extent& e) {
  const Vec3d d = e.upper - e.lower;
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

Vec3d middle(const Extent& e) {
  return 0.5 * (e.lower + e.upper);
}

/// Sorts items along the longest extent of their middles and returns the size of the first part:
/// half, or by the split with the least sum of area times number (MacDonald and Booth, "Heuristics
/// for ray tracing using space subdivision", 1990).
std::size_t split(const std::vector<Extent>& extents, Items items, bool equal) {
  Extent middles{Vec3d(infinite), Vec3d(-infinite)};
  for (const std::size_t i : items) {
    middles.lower = glm::min(middles.lower, middle(extents[i]));
    middles.upper = glm::max(middles.upper, middle(extents[i]));
  }
  const Vec3d d = middles.upper - middles.lower;
  const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
  std::sort(items.begin(), items.end(), [&](std::size_t a, std::size_t b) {
    const double x = middle(extents[a])[axis], y = middle(extents[b])[axis];
    return x != y ? x < y : a < b;
  });
  if (equal) return items.size() / 2;
  std::vector<double> after(items.size());
  Extent sum{Vec3d(infinite), Vec3d(-infinite)};
  const auto add = [&](std::size_t i) {
    sum.lower = glm::min(sum.lower, extents[i].lower);
    sum.upper = glm::max(sum.upper, extents[i].upper);
  };
  for (std::size_t k = items.size(); k-- > 1;) {
    add(items[k]);
    after[k] = half_area(sum) * static_cast<double>(items.size() - k);
  }
  sum = {Vec3d(infinite), Vec3d(-infinite)};
  std::size_t best = items.size() / 2;
  double least = infinite;
  for (std::size_t k = 1; k < items.size(); ++k) {
    add(items[k - 1]);
    const double cost = half_area(sum) * static_cast<double>(k) + after[k];
    if (cost < least) least = cost, best = k;
  }
  return best;
}

struct BoxBuilder {
  const std::vector<Extent>& extents;
  std::uint32_t first;
  LaneTree& tree;
  std::vector<std::size_t>& order;

  struct Part {
    Items items;
    double cost;  ///< of leaving it whole; below 0 if it cannot be split
  };

  std::uint32_t build(Items items, std::size_t depth) {
    const std::vector<Part> parts = divide(items, depth > LaneTree::deepest / 2);
    const auto node = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.push_back(empty());
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const Items part = parts[c].items;
      bound(tree.nodes[node], c, around(extents, part));
      std::uint32_t child = 0;
      if (part.size() <= LaneTree::most_shapes) {
        child = LaneTree::Shapes{first + static_cast<std::uint32_t>(order.size()),
                                 static_cast<std::uint32_t>(part.size())}
                    .child();
        order.insert(order.end(), part.begin(), part.end());
      } else {
        child = build(part, depth + 1);
      }
      tree.nodes[node].child.at(c) = child;
    }
    return node;
  }

  /// Divides items into up to LaneTree::width parts, the costliest first; or into `equal` ones,
  /// which ends soon for all arrangements.
  std::vector<Part> divide(Items items, bool equal) const {
    std::vector<Part> parts{part(items, equal)};
    const std::size_t most = most_parts(items.size());
    while (parts.size() < most) {
      const auto costliest = std::max_element(
          parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.cost < b.cost; });
      if (costliest->cost < 0) break;
      const Items whole = costliest->items;
      const std::size_t left = split(extents, whole, equal);
      *costliest = part(whole.first(left), equal);
      parts.insert(costliest + 1, part(whole.subspan(left), equal));
    }
    return parts;
  }

  /// So many that nodes below are full: there are as few levels as children of two shapes allow, so
  /// that parts with a few more than `width` need no node more; what is left over makes the upper
  /// nodes narrower.
  static std::size_t most_parts(std::size_t items) {
    constexpr std::size_t width = LaneTree::width;
    std::size_t of_child = 1;  // shapes of a child whose nodes are full of single shapes
    while (items > 2 * width * of_child)
      of_child *= width;
    return std::min((items + of_child - 1) / of_child, width);
  }

  Part part(Items items, bool equal) const {
    if (items.size() == 1) return {items, -1};
    const auto number = static_cast<double>(items.size());
    return {items, equal ? number : number * half_area(around(extents, items))};
  }

  /// Boxes at infinity, which no ray meets.
  static LaneTree::Node empty() {
    LaneTree::Node node{};
    for (auto* bounds : {&node.lower, &node.upper}) {
      for (auto& along_axis : *bounds)
        along_axis.fill(std::numeric_limits<float>::infinity());
    }
    return node;
  }

  /// Wider than the shape by more than the rounding of planes and spheres there, which is relative
  /// to all of its coordinates.
  static void bound(LaneTree::Node& node, std::size_t c, const Extent& e) {
    const Vec3d size = glm::max(glm::abs(e.lower), glm::abs(e.upper));
    const double wider = 0x1p-18 * (size.x + size.y + size.z);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      node.lower.at(axis).at(c) = static_cast<float>(e.lower[k] - wider);
      node.upper.at(axis).at(c) = static_cast<float>(e.upper[k] + wider);
    }
  }
};

}  // namespace

LaneTree::LaneTree(const std::vector<Extent>& extents, std::uint32_t first,
                   std::vector<std::size_t>& order) {
  order.clear();
  if (extents.empty()) return;
  std::vector<std::size_t> items(extents.size());
  std::iota(items.begin(), items.end(), std::size_t{0});
  BoxBuilder{extents, first, *this, order}.build(items, 0);
}

}  // namespace renderer
