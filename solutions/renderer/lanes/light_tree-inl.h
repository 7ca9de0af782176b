// Chooses one of many lights for the point of each lane (LaneLightTree). Included once for each
// instruction set.

#if defined(CARLO_LIGHT_TREE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_LIGHT_TREE_INL
#undef CARLO_LIGHT_TREE_INL
#else
#define CARLO_LIGHT_TREE_INL
#endif

#include "numeric/vec.h"
#include "renderer/lanes/choice-inl.h"
#include "renderer/lanes/lane_light_tree.h"
#include "renderer/lanes/points-inl.h"
#include "renderer/lanes/vector_math-inl.h"
#include "renderer/light_tree.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The children of one node, seen from one point: running sums of their probabilities, in multiples
/// of 2^-23.
class LightNode {
 public:
  HWY_INLINE LightNode(const LaneLightTree& tree, std::uint32_t node, const V3& p, const V3& n) {
    constexpr std::size_t width = LaneLightTree::width;
    for (std::size_t c = 0; c < width; c += lanes)
      hn::Store(sums_of_four(weights(tree, node, c, p, n)), d_, upto_.data() + c);
    // Added up in the same order for all numbers of lanes.
    const float a = upto_[3], b = a + upto_[7], c = b + upto_[11], all = c + upto_[15];
    some_ = all > 0;
    // Slightly above 1, so that rounding does not shorten the last one.
    const V4 per = hn::Set(d4_, (1 + 0x1p-20f) / (some_ ? all : 1.0f)), one = hn::Set(d4_, 1);
    const std::array<float, 4> before{0, a, b, c};
    for (std::size_t k = 0; k < before.size(); ++k) {
      const V4 exact =
          hn::Mul(hn::Add(hn::Load(d4_, upto_.data() + 4 * k), hn::Set(d4_, before[k])), per);
      four_[k] = hn::Min(hn::Sub(hn::Add(exact, one), one), one);
      hn::Store(four_[k], d4_, upto_.data() + 4 * k);
    }
  }

  /// False if none of its lights can contribute.
  bool some() const { return some_; }
  float lower(std::size_t c) const { return c == 0 ? 0 : upto_[c - 1]; }
  float probability(std::size_t c) const { return upto_[c] - lower(c); }

  /// The child that u selects; u in [0, 1), a multiple of 2^-24.
  HWY_INLINE std::size_t at(float u) const {
    std::size_t below = 0;
    for (const V4& four : four_)
      below += hn::CountTrue(d4_, hn::Le(four, hn::Set(d4_, u)));
    return std::min(below, LaneLightTree::width - 1);
  }

 private:
  using D4 = hn::FixedTag<float, 4>;
  using V4 = hn::Vec<D4>;
  static constexpr D4 d4_{};

  /// Estimates of the irradiance at p; 0 where children cannot contribute.
  static HWY_INLINE V weights(const LaneLightTree& tree, std::uint32_t number, std::size_t c,
                              const V3& p, const V3& n) {
    const LaneLightTree::Node& node = tree.nodes[number];
    const auto load = [&](const auto& column) HWY_ATTR { return hn::Load(d_, column.data() + c); };
    const Emitters of{{load(node.middle_x), load(node.middle_y), load(node.middle_z)},
                      load(node.reach),
                      load(node.strength)};
    const V3 d = of.middle - p;
    const V in_front = hn::Sub(dot({load(node.nx), load(node.ny), load(node.nz)}, p), load(node.d));
    const V height = select(hn::Gt(load(node.round), set(0)),
                            hn::Sqrt(hn::Max(dot(d, d), set(1e-30f))), in_front);
    V weight = hn::Max(flat_weight(of, p, n, height), set(0));
    if (number == 0 && tree.sky < LaneLightTree::width) {
      const U child = hn::Iota(du_, static_cast<std::uint32_t>(c));
      weight = select(hn::RebindMask(d_, hn::Eq(child, set_word(tree.sky))), of.strength, weight);
    }
    return weight;
  }

  /// Running sums within every four lanes, each the previous one plus a number: in another order of
  /// additions they might decrease.
  static HWY_INLINE V sums_of_four(V v) {
    V sum = v;
    for (int k = 0; k < 3; ++k)
      sum = hn::Add(v, hn::ShiftLeftLanes<1>(d_, sum));
    return sum;
  }

  alignas(64) std::array<float, LaneLightTree::width> upto_;
  std::array<V4, LaneLightTree::width / 4> four_;  ///< the same
  bool some_;
};

/// Points and normals, for code that handles lanes one by one.
struct LanePoints {
  LanePoints() = default;
  HWY_INLINE LanePoints(const V3& p, const V3& n) { set_point(p, n); }
  HWY_INLINE void set_point(const V3& p, const V3& n) {
    hn::Store(p.x, d_, px.data()), hn::Store(p.y, d_, py.data()), hn::Store(p.z, d_, pz.data());
    hn::Store(n.x, d_, nx.data()), hn::Store(n.y, d_, ny.data()), hn::Store(n.z, d_, nz.data());
  }
  carlo::Vec3 p(std::size_t i) const { return {px[i], py[i], pz[i]}; }
  carlo::Vec3 n(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }

  alignas(64) std::array<float, lanes> px, py, pz, nx, ny, nz;
};
/// The same in all lanes.
HWY_INLINE V3 set(carlo::Vec3 v) {
  return set(v.x, v.y, v.z);
}

/// The position of x between `lower` and lower + width, as a fraction below 1.
inline double within(double x, float lower, float width) {
  if (!(width > 0)) return 0;
  return std::min((x - static_cast<double>(lower)) / static_cast<double>(width), 1 - 0x1p-53);
}

constexpr auto uniform_part = static_cast<float>(LightTree::floor);

/// The probability with which a light is chosen at a point.
HWY_INLINE float probability_in_tree(const LaneLightTree& tree, std::uint32_t light, const V3& p,
                                     const V3& n) {
  const LaneLightTree::Leaf leaf = tree.leaf_of[light];
  float probability = 1 - uniform_part;
  for (std::uint32_t node = leaf.node, place = leaf.place;;) {
    probability *= LightNode(tree, node, p, n).probability(place);
    if (node == 0 || probability == 0) break;
    place = tree.nodes[node].place;
    node = tree.nodes[node].parent;
  }
  return probability + uniform_part / static_cast<float>(tree.leaf_of.size());
}

/// The same for each of the lanes that are `active`; 0 for the others.
inline HWY_NOINLINE V probabilities_in_tree(const LaneLightTree& tree, U light, const V3& p,
                                            const V3& n, M active) {
  const LanePoints lane(p, n);
  alignas(64) std::array<std::uint32_t, lanes> number;
  alignas(64) std::array<float, lanes> probability{};
  hn::Store(light, du_, number.data());
  for (std::uint32_t left = bits(active); left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    probability[i] = probability_in_tree(tree, number[i], set(lane.p(i)), set(lane.n(i)));
  }
  return hn::Load(d_, probability.data());
}

/// Picks lights by u in [0, 1) and the random words `seed`, which extend it, and rescales u. A
/// probability of 0: no light that u selects can contribute.
inline HWY_NOINLINE Picked pick_in_tree(const LaneLightTree& tree, const V3& p, const V3& n, U seed,
                                        M active, V& u) {
  const LanePoints lane(p, n);
  alignas(64) std::array<float, lanes> digits, probability{};
  alignas(64) std::array<std::uint32_t, lanes> more, light{}, node{};
  std::array<double, lanes> x;
  hn::Store(u, d_, digits.data());
  hn::Store(mix(seed), du_, more.data());
  const auto count = static_cast<double>(tree.leaf_of.size());
  const std::uint32_t wanted = bits(active);
  std::uint32_t descends = 0;
  for (std::uint32_t left = wanted; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    x[i] = static_cast<double>(digits[i]) + more[i] * 0x1p-56;
    constexpr double uniform = LightTree::floor;
    if (x[i] < uniform) {
      x[i] *= count / uniform;
      light[i] = std::min(static_cast<std::uint32_t>(x[i]),
                          static_cast<std::uint32_t>(tree.leaf_of.size() - 1));
      x[i] -= light[i];
      probability[i] = probability_in_tree(tree, light[i], set(lane.p(i)), set(lane.n(i)));
    } else {
      x[i] = (x[i] - uniform) / (1 - uniform);
      probability[i] = 1 - uniform_part;
      descends |= 1U << i;
    }
  }
  // All lanes descend together, which hides the latency of each one's sums.
  while (descends != 0) {
    for (std::uint32_t left = descends; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const LightNode here(tree, node[i], set(lane.p(i)), set(lane.n(i)));
      const auto step = static_cast<float>(static_cast<std::int32_t>(x[i] * 0x1p24)) * 0x1p-24f;
      const std::size_t c = here.at(step);
      const float share = here.some() ? here.probability(c) : 0;
      const std::uint32_t child = tree.nodes[node[i]].child[c];
      probability[i] *= share;
      x[i] = within(x[i], here.lower(c), share);
      if (share > 0 && (child & LaneLightTree::leaf) == 0) {
        node[i] = child;
        continue;
      }
      descends &= ~(1U << i);
      light[i] = child & ~LaneLightTree::leaf;
      if (share > 0) probability[i] += uniform_part / static_cast<float>(count);
    }
  }
  for (std::size_t i = 0; i < lanes; ++i)
    digits[i] = (wanted >> i & 1) != 0 ? below_one(x[i]) : 0;
  u = hn::Load(d_, digits.data());
  return {hn::Load(du_, light.data()), hn::Load(d_, probability.data())};
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_LIGHT_TREE_INL
