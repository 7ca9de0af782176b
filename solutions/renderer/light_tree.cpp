#include "light_tree.h"

#include "numeric/robust.h"
#include "random/hash.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace renderer {
namespace {

using carlo::Vec3;
using Vec3d = glm::dvec3;

/// Widens a's cone of normals to the narrowest one that contains both.
void widen(LightBounds& a, const LightBounds& b) {
  const double angle_a = std::acos(std::clamp(a.cos_spread, -1.0, 1.0));
  const double angle_b = std::acos(std::clamp(b.cos_spread, -1.0, 1.0));
  const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
  if (between + angle_b <= angle_a) return;
  if (between + angle_a <= angle_b) {
    a.axis = b.axis, a.cos_spread = b.cos_spread;
    return;
  }
  const double whole = (angle_a + between + angle_b) / 2;
  const Vec3d aside = b.axis - glm::dot(a.axis, b.axis) * a.axis;
  if (whole >= carlo::pi || !(glm::dot(aside, aside) > 0)) {
    a.cos_spread = -1;
    return;
  }
  const double turn = whole - angle_a;
  a.axis = glm::normalize(std::cos(turn) * a.axis + std::sin(turn) * glm::normalize(aside));
  a.cos_spread = std::cos(whole);
}

LightBounds together(const LightBounds& a, const LightBounds& b) {
  LightBounds both = a;
  both.lower = glm::min(a.lower, b.lower);
  both.upper = glm::max(a.upper, b.upper);
  if (a.cos_spread <= -1 || b.cos_spread <= -1)
    both.cos_spread = -1;
  else
    widen(both, b);
  both.strength += b.strength;
  return both;
}

/// The cosine-weighted measure of the directions into which lights in a cone of normals shine: pi
/// for one normal, 4 pi for all of them. Source: Conty Estevez and Kulla 2018, section 4.1.
double measure_of_directions(const LightBounds& light) {
  const double spread = std::acos(std::clamp(light.cos_spread, -1.0, 1.0));
  const double end = std::min(spread + carlo::pi / 2, carlo::pi);
  const double sine = std::sin(spread), cosine = std::cos(spread);
  return 2 * carlo::pi * (1 - cosine) +
         carlo::pi / 2 * (2 * end * sine - std::cos(spread - 2 * end) - 2 * spread * sine + cosine);
}

Vec3d middle(const LightBounds& light) {
  return 0.5 * (light.lower + light.upper);
}

}  // namespace

LightTree::Node::Node(const LightBounds& light, double of_strength)
    : middle(renderer::middle(light)),
      axis(light.axis),
      cos_spread(static_cast<float>(light.cos_spread)),
      sin_spread(
          static_cast<float>(std::sqrt(std::max(0.0, 1 - light.cos_spread * light.cos_spread)))),
      strength(static_cast<float>(of_strength)) {
  const Vec3 rounded = glm::abs(middle) * 1e-7f;
  reach = static_cast<float>(0.5 * glm::length(light.upper - light.lower) * (1 + 1e-6)) +
          glm::length(rounded);
}

/// strength x cos x cos / distance^2, with the most favourable cosines of any point in the sphere
/// around the light: 0 only where the light cannot contribute. Finite inside the sphere.
inline float LightTree::Node::estimate(Vec3 p, Vec3 n) const {
  const Vec3 d = middle - p;
  const float distance2 = glm::dot(d, d);
  const float inwards = glm::dot(n, d) + reach;
  // The distance times the cosine at the light, for the normal nearest to the direction of p.
  float outwards = -glm::dot(axis, d);
  if (cos_spread < 1) {
    const float distance = std::sqrt(distance2);
    outwards = outwards >= distance * cos_spread
                   ? distance
                   : outwards * cos_spread +
                         std::sqrt(std::max(distance2 - outwards * outwards, 0.0f)) * sin_spread;
  }
  outwards += reach;
  if (!(inwards > 0) || !(outwards > 0)) return 0;
  const float per = 1 / std::max(distance2 + reach * reach, 1e-30f);
  return strength * (inwards * per) * (outwards * per);
}

double estimate_irradiance(const LightBounds& light, Vec3d p, Vec3d n) {
  return light.strength * static_cast<double>(LightTree::Node(light, 1).estimate(Vec3(p), Vec3(n)));
}

/// Splits lights in two, between bins, where the sum of strength x extent x directions is least.
struct LightTree::Builder {
  static constexpr std::size_t bins = 12;

  const std::vector<LightBounds>& lights;
  double all;  ///< strengths are divided by this, so that their products fit into floats
  LightTree& tree;

  LightBounds build(std::span<std::uint32_t> which, std::uint32_t node, std::uint32_t parent) {
    LightBounds bounds;
    std::uint32_t child = 0;
    if (which.size() == 1) {
      bounds = lights[which[0]];
      tree.leaf_of_[which[0]] = node;
    } else {
      const std::size_t left = split(which);
      child = static_cast<std::uint32_t>(tree.nodes_.size());
      tree.nodes_.resize(tree.nodes_.size() + 2);
      bounds = build(which.first(left), child, node);
      bounds = together(bounds, build(which.subspan(left), child + 1, node));
    }
    Node& built = tree.nodes_[node] = Node(bounds, all > 0 ? bounds.strength / all : 0);
    built.parent = parent, built.first_child = child, built.light = which[0];
    return bounds;
  }

  /// Sorts the lights into two parts and returns the size of the first.
  std::size_t split(std::span<std::uint32_t> which) const {
    Vec3d lower(std::numeric_limits<double>::max()), upper(-lower);
    for (const std::uint32_t i : which) {
      lower = glm::min(lower, middle(lights[i]));
      upper = glm::max(upper, middle(lights[i]));
    }
    double least = std::numeric_limits<double>::max();
    int best_axis = -1;
    std::size_t best_bin = 0;
    const double longest = std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z});
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = upper[axis] - lower[axis];
      if (!(extent > 0)) continue;
      const std::array<double, bins> costs = costs_along(which, axis, lower[axis], extent);
      for (std::size_t b = 0; b + 1 < bins; ++b) {
        // Thin slices cost more than their boxes suggest.
        const double cost = costs.at(b) * longest / extent;
        if (cost < least) least = cost, best_axis = axis, best_bin = b;
      }
    }
    if (best_axis < 0) return which.size() / 2;  // all lights are in one place
    const auto second = std::partition(which.begin(), which.end(), [&](std::uint32_t i) {
      return bin_of(i, best_axis, lower[best_axis], upper[best_axis] - lower[best_axis]) <=
             best_bin;
    });
    return static_cast<std::size_t>(second - which.begin());
  }

  std::size_t bin_of(std::uint32_t i, int axis, double lower, double extent) const {
    const double place = (middle(lights[i])[axis] - lower) / extent;
    return std::min(static_cast<std::size_t>(place * bins), bins - 1);
  }

  /// The cost of a split behind each bin; the largest number where a split leaves one side empty.
  std::array<double, bins> costs_along(std::span<const std::uint32_t> which, int axis, double lower,
                                       double extent) const {
    std::array<std::optional<LightBounds>, bins> of_bin;
    const auto add = [](std::optional<LightBounds>& sum, const LightBounds& more) {
      sum = sum ? together(*sum, more) : more;
    };
    for (const std::uint32_t i : which)
      add(of_bin.at(bin_of(i, axis, lower, extent)), lights[i]);
    std::array<double, bins> costs{};
    costs.fill(std::numeric_limits<double>::max());
    std::array<double, bins> below{};
    std::optional<LightBounds> sum;
    for (std::size_t b = 0; b < bins; ++b) {
      if (of_bin.at(b)) add(sum, *of_bin.at(b));
      below.at(b) = sum ? cost(*sum) : -1;
    }
    sum.reset();
    for (std::size_t b = bins - 1; b > 0; --b) {
      if (of_bin.at(b)) add(sum, *of_bin.at(b));
      if (sum && below.at(b - 1) >= 0) costs.at(b - 1) = below.at(b - 1) + cost(*sum);
    }
    return costs;
  }

  static double cost(const LightBounds& light) {
    const Vec3d extent = light.upper - light.lower;
    return light.strength * measure_of_directions(light) * glm::dot(extent, extent);
  }
};

LightTree::LightTree(const std::vector<LightBounds>& lights, std::optional<double> everywhere)
    : leaf_of_(lights.size() + (everywhere ? 1 : 0)) {
  nodes_.reserve(2 * leaf_of_.size() + 2);
  // Number 1 stays unused: siblings are i and i ^ 1.
  nodes_.resize(2);
  double all = everywhere.value_or(0);
  for (const LightBounds& light : lights)
    all += light.strength;
  if (everywhere) {
    const auto last = static_cast<std::uint32_t>(lights.size());
    everywhere_ = 0;
    if (!lights.empty()) {
      nodes_[0].first_child = root_ = 2;
      nodes_.resize(4);
      everywhere_ = 3;
    }
    nodes_[everywhere_].light = last;
    nodes_[everywhere_].strength = all > 0 ? static_cast<float>(*everywhere / all) : 0;
    leaf_of_[last] = everywhere_;
  }
  double shares = 0;
  for (const LightBounds& light : lights)
    floor_shares_.push_back(shares += light.floor_share);
  if (everywhere) floor_shares_.push_back(shares + 1);
  if (lights.empty()) return;
  std::vector<std::uint32_t> which(lights.size());
  std::iota(which.begin(), which.end(), 0U);
  bounds_ = Builder{lights, all, *this}.build(which, root_, 0);
}

void LightTree::collect(std::uint32_t node, std::vector<std::uint32_t>& lights) const {
  if (nodes_[node].first_child == 0) return lights.push_back(nodes_[node].light);
  collect(nodes_[node].first_child, lights);
  collect(nodes_[node].first_child + 1, lights);
}

std::vector<std::vector<std::uint32_t>> LightTree::groups(std::size_t most) const {
  std::vector<std::uint32_t> cut{root_};
  const auto worth = [&](std::uint32_t i) {
    const Node& node = nodes_[i];
    return node.first_child == 0 ? -1 : node.strength * node.reach * node.reach;
  };
  while (cut.size() < most) {
    const auto widest = std::max_element(cut.begin(), cut.end(),
                                         [&](auto a, auto b) { return worth(a) < worth(b); });
    if (worth(*widest) < 0) break;
    const std::uint32_t child = nodes_[*widest].first_child;
    *widest = child;
    cut.push_back(child + 1);
  }
  std::vector<std::vector<std::uint32_t>> groups(cut.size());
  for (std::size_t i = 0; i < cut.size(); ++i)
    collect(cut[i], groups[i]);
  return groups;
}

float LightTree::estimate(std::uint32_t node, Vec3 p, Vec3 n) const {
  return node == everywhere_ ? nodes_[node].strength : nodes_[node].estimate(p, n);
}

std::optional<double> LightTree::probability_of_left(std::uint32_t left, Vec3 p, Vec3 n) const {
  const float a = estimate(left, p, n), b = estimate(left + 1, p, n);
  if (!(a + b > 0)) return std::nullopt;
  return static_cast<double>(a) / (static_cast<double>(a) + static_cast<double>(b));
}

std::optional<LightTree::Choice> LightTree::sample(Vec3 p, Vec3 n, double u) const {
  if (leaf_of_.size() == 1) return Choice{0, 1, u};
  if (u < floor) {
    u /= floor;
    const auto light = static_cast<std::uint32_t>(pick(floor_shares_, u));
    return Choice{light, probability(light, p, n), u};
  }
  u = (u - floor) / (1 - floor);
  double by_descent = 1;
  std::uint32_t at = 0;
  while (nodes_[at].first_child != 0) {
    const std::uint32_t child = nodes_[at].first_child;
    const std::optional<double> left = probability_of_left(child, p, n);
    if (!left) return std::nullopt;
    const bool goes_left = u < *left;
    const double probability = goes_left ? *left : 1 - *left;
    u = std::min((goes_left ? u : u - *left) / probability, 1 - 0x1p-53);
    by_descent *= probability;
    at = goes_left ? child : child + 1;
  }
  const std::uint32_t light = nodes_[at].light;
  return Choice{light, (1 - floor) * by_descent + floor_probability(light), u};
}

double LightTree::probability(std::uint32_t light, Vec3 p, Vec3 n) const {
  if (leaf_of_.size() == 1) return 1;
  return (1 - floor) * probability_by_descent(light, p, n) + floor_probability(light);
}

double LightTree::floor_probability(std::uint32_t light) const {
  const double before = light == 0 ? 0 : floor_shares_[light - 1];
  return floor * (floor_shares_[light] - before) / floor_shares_.back();
}

double LightTree::probability_by_descent(std::uint32_t light, Vec3 p, Vec3 n) const {
  double probability = 1;
  for (std::uint32_t at = leaf_of_[light]; at != 0; at = nodes_[at].parent) {
    const std::optional<double> left = probability_of_left(at & ~1U, p, n);
    if (!left) return 0;
    probability *= at % 2 == 0 ? *left : 1 - *left;
  }
  return probability;
}

std::size_t pick(std::span<const double> sums, double& u) {
  const double x = u * sums.back();
  const auto it = std::upper_bound(sums.begin(), sums.end() - 1, x);
  const auto i = static_cast<std::size_t>(it - sums.begin());
  const double lower = i == 0 ? 0 : sums[i - 1];
  u = std::clamp((x - lower) / (sums[i] - lower), 0.0, 1 - 0x1p-53);
  return i;
}

double with_more_digits(float u, carlo::Vec2 others) {
  const std::uint64_t digits =
      carlo::hash(std::bit_cast<std::uint32_t>(u), std::bit_cast<std::uint32_t>(others.x),
                  std::bit_cast<std::uint32_t>(others.y));
  return static_cast<double>(u) + static_cast<double>(digits >> 35) * 0x1p-53;
}

float below_one(double u) {
  return std::min(static_cast<float>(u), 0x1.fffffep-1f);
}

}  // namespace renderer
