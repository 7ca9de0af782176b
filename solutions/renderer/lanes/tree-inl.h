// Traverses a hierarchy of shapes (LaneTree), one ray per lane. Included once for each instruction
// set.

#if defined(CARLO_TREE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_TREE_INL
#undef CARLO_TREE_INL
#else
#define CARLO_TREE_INL
#endif

#include "renderer/lanes/lane_tree.h"
#include "renderer/lanes/rays-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Intervals along one axis that hold the origins, the directions and their inverses of all rays of
/// a register.
struct Beam {
  V low, high;    ///< of the origins
  V from, to;     ///< of the directions
  V least, most;  ///< of the inverses, if all directions have the same sign
  bool up, down;  ///< all components of directions are > 0, or < 0
};

/// The `wanted` rays of a register as one beam. Testing a box against it is less work than testing
/// each ray, if the rays have similar directions.
class Beams {
 public:
  HWY_INLINE Beams(const V3& o, const V3& d, const V3& inverse, M wanted) {
    const V blur =
        hn::MaxOfLanes(d_, hn::IfThenElseZero(wanted, hn::Mul(set(0x1p-19f), coordinates(o))));
    axes_[0] = beam(o.x, d.x, inverse.x, wanted, blur);
    axes_[1] = beam(o.y, d.y, inverse.y, wanted, blur);
    axes_[2] = beam(o.z, d.z, inverse.z, wanted, blur);
  }

  /// The children of a node that some ray may hit before the distance `far`: one bit for each.
  HWY_INLINE std::uint32_t may_intersect(const LaneTree::Node& node, V far) const {
    std::uint32_t met = 0;
    for (std::size_t c = 0; c < LaneTree::width; c += lanes)
      met |= bits(may_intersect(node, c, far)) << c;
    return met;
  }

 private:
  static HWY_INLINE Beam beam(V o, V d, V inverse, M wanted, V blur) {
    const V large = set(3e38f), small = set(-3e38f);
    const V from = hn::MinOfLanes(d_, select(wanted, d, large)),
            to = hn::MaxOfLanes(d_, select(wanted, d, small));
    return {hn::Sub(hn::MinOfLanes(d_, select(wanted, o, large)), blur),
            hn::Add(hn::MaxOfLanes(d_, select(wanted, o, small)), blur),
            from,
            to,
            hn::MinOfLanes(d_, select(wanted, inverse, large)),
            hn::MaxOfLanes(d_, select(wanted, inverse, small)),
            hn::GetLane(from) > 0,
            hn::GetLane(to) < 0};
  }

  HWY_INLINE M may_intersect(const LaneTree::Node& node, std::size_t c, V far) const {
    constexpr float slack = 0x1p-20f;  // for the rounding of products
    V enters = set(0), leaves = far;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const Beam& axis = axes_[k];
      if (!axis.up && !axis.down) continue;
      const V lower = hn::Load(d_, node.lower[k].data() + c),
              upper = hn::Load(d_, node.upper[k].data() + c);
      const V near = axis.up ? hn::Sub(lower, axis.high) : hn::Sub(upper, axis.low);
      const V end = axis.up ? hn::Sub(upper, axis.low) : hn::Sub(lower, axis.high);
      enters = hn::Max(enters, hn::Min(hn::Mul(near, axis.least), hn::Mul(near, axis.most)));
      leaves = hn::Min(leaves, hn::Max(hn::Mul(end, axis.least), hn::Mul(end, axis.most)));
    }
    enters = hn::Mul(enters, set(1 - slack)), leaves = hn::Mul(leaves, set(1 + slack));
    M met = hn::Le(enters, leaves);
    // Where directions have both signs: the interval that rays reach until then.
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const Beam& axis = axes_[k];
      if (axis.up || axis.down) continue;
      const V lower = hn::Load(d_, node.lower[k].data() + c),
              upper = hn::Load(d_, node.upper[k].data() + c);
      const V least = mul_add(hn::Mul(axis.from, set(1 + slack)), leaves, axis.low),
              most = mul_add(hn::Mul(axis.to, set(1 + slack)), leaves, axis.high);
      met = hn::And(met, hn::And(hn::Le(lower, most), hn::Ge(upper, least)));
    }
    return met;
  }

  std::array<Beam, 3> axes_;
};

/// The rays of a register, prepared for tests of all of them against one box, or of one of them
/// against all children of a node.
class TreeRays {
 public:
  HWY_INLINE TreeRays(const V3& o, const V3& d) {
    const V tiny = set(0x1p-63f);  // replaces 0
    inverse_ = {hn::Div(set(1), hn::Or(d.x, tiny)), hn::Div(set(1), hn::Or(d.y, tiny)),
                hn::Div(set(1), hn::Or(d.z, tiny))};
    const V blur = hn::Mul(set(0x1p-19f), coordinates(o));
    offset_ = o * inverse_;
    wider_ = blur * V3{hn::Abs(inverse_.x), hn::Abs(inverse_.y), hn::Abs(inverse_.z)};
    const std::array<V, 9> all{inverse_.x, inverse_.y, inverse_.z, offset_.x, offset_.y,
                               offset_.z,  wider_.x,   wider_.y,   wider_.z};
    for (std::size_t k = 0; k < all.size(); ++k)
      hn::Store(all[k], d_, lane_[k].data());
  }

  V3 inverse() const { return inverse_; }

  /// The rays that hit child c of a node before the distance `far`: one bit for each.
  HWY_INLINE std::uint32_t entering(const LaneTree::Node& node, std::size_t c, V far) const {
    V from = set(0), to = far;
    slab(set(node.lower[0][c]), set(node.upper[0][c]), inverse_.x, offset_.x, wider_.x, from, to);
    slab(set(node.lower[1][c]), set(node.upper[1][c]), inverse_.y, offset_.y, wider_.y, from, to);
    slab(set(node.lower[2][c]), set(node.upper[2][c]), inverse_.z, offset_.z, wider_.z, from, to);
    return bits(overlap(from, to));
  }

  /// The children of a node that one ray hits: one bit for each.
  HWY_INLINE std::uint32_t entered(const LaneTree::Node& node, std::size_t ray, float far) const {
    std::uint32_t met = 0;
    for (std::size_t c = 0; c < LaneTree::width; c += lanes) {
      V from = set(0), to = set(far);
      for (std::size_t k = 0; k < 3; ++k) {
        slab(hn::Load(d_, node.lower[k].data() + c), hn::Load(d_, node.upper[k].data() + c),
             set(lane_[k][ray]), set(lane_[3 + k][ray]), set(lane_[6 + k][ray]), from, to);
      }
      met |= bits(overlap(from, to)) << c;
    }
    return met;
  }

 private:
  static HWY_INLINE void slab(V lower, V upper, V per, V offset, V wider, V& from, V& to) {
    const V a = mul_sub(lower, per, offset), b = mul_sub(upper, per, offset);
    from = hn::Max(from, hn::Sub(hn::Min(a, b), wider));
    to = hn::Min(to, hn::Add(hn::Max(a, b), wider));
  }
  static HWY_INLINE M overlap(V from, V to) { return hn::Le(hn::Mul(from, set(1 - 0x1p-20f)), to); }

  V3 inverse_, offset_, wider_;
  alignas(64) std::array<std::array<float, lanes>, 9> lane_;
};

/// A node, and its children still to be visited.
struct TreeVisit {
  std::uint32_t node, children;
  std::uint32_t rays;  ///< that meet the node
  bool one_by_one;     ///< which ray meets which child is known:
  std::array<std::uint32_t, lanes> children_of_ray;

  /// Finds the children that some of the rays hit, by the cheaper of two tests.
  HWY_INLINE void start(const LaneTree& tree, std::uint32_t number, std::uint32_t by,
                        const TreeRays& each, const Beams& together, V far) {
    node = number, rays = by;
    children = ~0U;
    constexpr int few = 3;  // not worth a test of all together
    if (std::popcount(rays) > few) {
      children = together.may_intersect(tree.nodes[node], hn::MaxOfLanes(d_, far));
      one_by_one = std::popcount(children) > std::popcount(rays);
      if (!one_by_one) return;
    }
    one_by_one = true;
    alignas(64) std::array<float, lanes> far_of_ray;
    hn::Store(far, d_, far_of_ray.data());
    std::uint32_t met = 0;
    for (std::uint32_t left = rays; left != 0; left &= left - 1) {
      const auto ray = static_cast<std::size_t>(std::countr_zero(left));
      children_of_ray[ray] = each.entered(tree.nodes[node], ray, far_of_ray[ray]);
      met |= children_of_ray[ray];
    }
    children &= met;
  }

  /// The rays that hit child c.
  HWY_INLINE std::uint32_t entering(const LaneTree& tree, std::size_t c, const TreeRays& each,
                                    V far) const {
    if (!one_by_one) return rays & each.entering(tree.nodes[node], c, far);
    if (std::has_single_bit(rays)) return rays;
    std::uint32_t result = 0;
    for (std::uint32_t left = rays; left != 0; left &= left - 1) {
      const auto ray = static_cast<std::size_t>(std::countr_zero(left));
      result |= (children_of_ray[ray] >> c & 1) << ray;
    }
    return result;
  }
};

/// Rays prepared for the traversal of a scene's trees.
struct TreeSearch {
  HWY_INLINE TreeSearch(const V3& o, const V3& d, M wanted)
      : each(o, d), together(o, d, each.inverse(), wanted) {}

  TreeRays each;
  Beams together;
};

/// Calls `meet` with the number of each shape in a child whose box one of the `wanted` rays hits,
/// and with the mask of those that do, in the order of the numbers. The shapes found for a ray do
/// not depend on the other rays of its register. `far`: returns the distances up to which rays are
/// followed. Ends early when `meet` returns false.
template <class Far, class Meet>
HWY_INLINE void for_shapes_near(const LaneTree& tree, const TreeSearch& search, M wanted,
                                const Far& far, const Meet& meet) {
  if (tree.nodes.empty() || hn::AllFalse(d_, wanted)) return;
  const TreeRays& each = search.each;
  const Beams& together = search.together;
  const auto reach = [&]() HWY_ATTR { return hn::IfThenElseZero(wanted, far()); };
  std::array<TreeVisit, LaneTree::deepest> visits;
  std::size_t depth = 0;
  visits[0].start(tree, 0, bits(wanted), each, together, reach());
  for (;;) {
    TreeVisit& visit = visits[depth];
    if (visit.children == 0) {
      if (depth == 0) return;
      --depth;
      continue;
    }
    const auto c = static_cast<std::size_t>(std::countr_zero(visit.children));
    visit.children &= visit.children - 1;
    const std::uint32_t child = tree.nodes[visit.node].child[c];
    const std::uint32_t rays = visit.entering(tree, c, each, far());
    if (rays == 0) continue;
    if ((child & LaneTree::leaf) != 0) {
      const auto [first, count] = LaneTree::Shapes::of(child);
      for (std::uint32_t i = first; i < first + count; ++i) {
        if (!meet(i, mask_of(rays))) return;
      }
    } else {
      visits[++depth].start(tree, child, rays, each, together, reach());
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_TREE_INL
