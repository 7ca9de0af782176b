// Chooses the light that a path samples, one point per lane. Included once for each instruction
// set.

#if defined(CARLO_CHOICE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_CHOICE_INL
#undef CARLO_CHOICE_INL
#else
#define CARLO_CHOICE_INL
#endif

#include "renderer/lanes/lane_lights.h"
#include "renderer/lanes/lookup-inl.h"
#include "renderer/lanes/points-inl.h"
#include "renderer/lanes/rays-inl.h"
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

// A group of lights (LaneLights) is chosen in proportion to its `weight`, an estimate of its
// unoccluded irradiance. One sixteenth of the choices is shared equally by all lights that can
// contribute, so that none is missed where the weights are wrong. (LightTree does the same for many
// lights, with its own estimates.)

/// Groups of lights: a sphere around each, and its LaneLights::strength.
struct Emitters {
  V3 middle;
  V reach, strength;
};

/// The weights of groups at points p of surfaces with normals n; below 0 where the group cannot
/// contribute. `height`: the distance of p in front of the group's plane or, if it has none, from
/// its middle.
HWY_INLINE V flat_weight(const Emitters& light, V3 p, V3 n, V height) {
  const V3 d = light.middle - p;
  const V inwards = mul_add(n.x, d.x, mul_add(n.y, d.y, mul_add(n.z, d.z, light.reach)));
  const V distance2 =
      mul_add(d.x, d.x, mul_add(d.y, d.y, mul_add(d.z, d.z, hn::Mul(light.reach, light.reach))));
  const V per = hn::Div(set(1), hn::Max(distance2, set(1e-30f)));
  const V brings = hn::Mul(hn::Mul(light.strength, hn::Mul(inwards, per)),
                           hn::Mul(hn::Add(height, light.reach), per));
  return select(hn::Gt(hn::Min(inwards, height), set(0)), brings, set(-1));
}
HWY_INLINE V round_weight(const Emitters& light, V3 p, V3 n) {
  const V3 d = light.middle - p;
  return flat_weight(light, p, n, hn::Sqrt(hn::Max(dot(d, d), set(1e-30f))));
}

/// A light's probability, from the weight of its group and its share in it.
struct LightProbabilities {
  V per_weight, of_each;
};
HWY_INLINE V probability(const LightProbabilities& probabilities, V weight, V share) {
  return hn::IfThenElseZero(
      hn::Ge(weight, set(0)),
      mul_add(hn::Mul(weight, probabilities.per_weight), share, probabilities.of_each));
}

/// The weight of the environment map: the same everywhere.
HWY_INLINE V sky_weight(const LaneLights& lights) {
  return set(lights.strength[lights.sky]);
}

/// The weights of all groups, one register per group.
using Weights = std::array<float, LaneLights::most_groups * lanes>;

inline HWY_NOINLINE LightProbabilities weigh_lights(const LaneLights& lights, const V3& p,
                                                    const V3& n, Weights& weights) {
  V sum = set(0), count = set(0);
  const auto add = [&](std::uint32_t g, V weight) HWY_ATTR {
    hn::Store(weight, d_, weights.data() + g * lanes);
    sum = hn::Add(sum, hn::Max(weight, set(0)));
    const V lights_there = set(static_cast<float>(lights.size[g]));
    count = select(hn::Ge(weight, set(0)), hn::Add(count, lights_there), count);
  };
  const auto emitters = [&](std::uint32_t g) HWY_ATTR {
    return Emitters{set(lights.middle_x[g], lights.middle_y[g], lights.middle_z[g]),
                    set(lights.reach[g]), set(lights.strength[g])};
  };
  for (std::uint32_t g = 0; g < lights.first_round; ++g) {
    const V height =
        mul_add(set(lights.nx[g]), p.x,
                mul_add(set(lights.ny[g]), p.y, mul_sub(set(lights.nz[g]), p.z, set(lights.d[g]))));
    add(g, flat_weight(emitters(g), p, n, height));
  }
  for (std::uint32_t g = lights.first_round; g < lights.groups; ++g)
    add(g, g == lights.sky ? sky_weight(lights) : round_weight(emitters(g), p, n));
  // The total is slightly above 1, so that rounding does not shorten the last group.
  constexpr float all = 1 + 0x1p-20f;
  constexpr auto floor = static_cast<float>(LightTree::floor);
  const M some = hn::Gt(sum, set(0));
  return {hn::IfThenElseZero(some, hn::Div(set((1 - floor) * all), sum)),
          hn::Div(select(some, set(floor * all), set(all)), hn::Max(count, set(1)))};
}

struct Picked {
  U index;  ///< a light
  V probability;
};

/// Stretches u from [0, width) to [0, 1).
HWY_INLINE V stretch(V u, V width) {
  return hn::Min(hn::Div(u, width), set(0x1.fffffep-1f));
}

/// Picks members of groups by u in [0, width): the first `by_strength` of the width chooses by
/// strength, the rest uniformly. Rescales u to [0, 1).
HWY_INLINE Picked pick_member(const LaneLights& lights, U group, V width, V by_strength, V& u) {
  const U first = gather_words(lights.first.data(), group);
  const U size = gather_words(lights.size.data(), group), end = hn::Add(first, size);
  const V count = hn::ConvertTo(d_, hn::BitCast(di_, size));
  const V of_each = hn::Div(hn::Sub(width, by_strength), count);
  const M alike = hn::Ge(u, by_strength);
  const V place = hn::Min(hn::Div(hn::Sub(u, by_strength), of_each), hn::Sub(count, set(0.5f)));
  const U nth = hn::BitCast(du_, hn::ConvertTo(di_, hn::IfThenElseZero(alike, place)));
  const V x = stretch(u, by_strength);
  U at = first;
  for (std::uint32_t half = std::bit_floor(lights.largest); half > 0; half /= 2) {
    const U next = hn::Add(at, set_word(half));
    const U last = hn::Sub(hn::Min(next, end), set_word(1));
    const M above =
        hn::And(hn::Le(gather(lights.upto.data(), last), x), hn::RebindMask(d_, hn::Lt(next, end)));
    at = hn::IfThenElse(hn::RebindMask(du_, above), next, at);
  }
  at = hn::IfThenElse(hn::RebindMask(du_, alike), hn::Add(first, nth), at);
  const U before = hn::Sub(hn::Max(at, set_word(1)), set_word(1));
  const V lower = hn::IfThenZeroElse(same(at, first), gather(lights.upto.data(), before));
  const V share = hn::Sub(gather(lights.upto.data(), at), lower);
  const V of_nth = hn::Sub(place, hn::ConvertTo(d_, hn::BitCast(di_, nth)));
  u = select(alike, hn::Min(of_nth, set(0x1.fffffep-1f)), stretch(hn::Sub(x, lower), share));
  return {gather_words(lights.member.data(), at), mul_add(by_strength, share, of_each)};
}

/// Picks lights by u in [0, 1), and rescales u. The probabilities of groups are multiples of 2^-23,
/// twice the step of u, so they are exactly those with which groups are picked. A small probability
/// leaves few steps of u; `seed` refines them.
inline HWY_NOINLINE Picked pick_light(const LaneLights& lights, const Weights& weights,
                                      const LightProbabilities& probabilities, U seed, V& u) {
  V sum = set(0), of_each = set(0), lower = set(0), upper = set(1);
  U group = set_word(0);
  for (std::uint32_t g = 0; g < lights.groups; ++g) {
    const V weight = hn::Load(d_, weights.data() + g * lanes);
    sum = hn::Add(sum, hn::Max(weight, set(0)));
    of_each = select(
        hn::Ge(weight, set(0)),
        mul_add(probabilities.of_each, set(static_cast<float>(lights.size[g])), of_each), of_each);
    const V exact = mul_add(sum, probabilities.per_weight, of_each);
    const V upto = hn::Sub(hn::Add(exact, set(1)), set(1));
    const M beyond = hn::Ge(u, upto);
    lower = select(beyond, upto, lower);
    upper = select(beyond, upper, hn::Min(upper, upto));
    group = hn::IfThenElse(hn::RebindMask(du_, beyond), set_word(g + 1), group);
  }
  group = hn::Min(group, set_word(lights.groups - 1));
  const V width = hn::Sub(upper, lower);
  u = mul_add(to_unit(mix(seed)), set(0x1p-24f), hn::Sub(u, lower));
  if (lights.largest == 1) {
    u = stretch(u, width);
    return {gather_words(lights.member.data(), group), width};
  }
  const U place = hn::Add(hn::Mul(group, set_word(lanes)), hn::Iota(du_, 0));
  const V weight = hn::Max(gather(weights.data(), place), set(0));
  const V by_strength = hn::Min(hn::Mul(weight, probabilities.per_weight), width);
  return pick_member(lights, group, width, by_strength, u);
}

/// The probability with which lights are chosen at points p of surfaces with normals n.
inline HWY_NOINLINE V probability_of(const LaneLights& lights,
                                     const LightProbabilities& probabilities, U light, const V3& p,
                                     const V3& n) {
  const U group = gather_words(lights.group.data(), light);
  const auto column = [&](const auto& c) HWY_ATTR { return gather(c.data(), group); };
  const Emitters of{{column(lights.middle_x), column(lights.middle_y), column(lights.middle_z)},
                    column(lights.reach),
                    column(lights.strength)};
  const V height =
      mul_add(column(lights.nx), p.x,
              mul_add(column(lights.ny), p.y, mul_sub(column(lights.nz), p.z, column(lights.d))));
  V weight = flat_weight(of, p, n, height);
  if (lights.first_round < lights.groups) {
    const M is_flat = hn::RebindMask(d_, hn::Gt(set_word(lights.first_round), group));
    weight = select(is_flat, weight, round_weight(of, p, n));
  }
  return probability(probabilities, weight, gather(lights.share.data(), light));
}

inline HWY_NOINLINE U pick_start_among_many(const LaneLights& lights, std::uint32_t count, V& u) {
  alignas(64) std::array<float, lanes> x;
  alignas(64) std::array<std::uint32_t, lanes> index;
  hn::Store(u, d_, x.data());
  const float* upto = lights.start_upto.data();
  for (std::size_t i = 0; i < lanes; ++i) {
    const float* at = std::upper_bound(upto, upto + count - 1, x[i]);
    const float lower = at == upto ? 0 : at[-1];
    index[i] = static_cast<std::uint32_t>(at - upto);
    x[i] = std::min((x[i] - lower) / (*at - lower), 0x1.fffffep-1f);
  }
  u = hn::Load(d_, x.data());
  return hn::Load(du_, index.data());
}

/// Picks one of `count` lights by u in [0, 1) and LaneLights::start_upto, and rescales u.
template <bool full>
HWY_INLINE U pick_start(const LaneLights& lights, std::uint32_t count, V& u) {
  if (full && lights.many()) return pick_start_among_many(lights, count, u);
  U index = set_word(0);
  V lower = set(0), upper = set(lights.start_upto[0]);
  for (std::uint32_t i = 1; i < count; ++i) {
    const M beyond = hn::Ge(u, set(lights.start_upto[i - 1]));
    lower = select(beyond, set(lights.start_upto[i - 1]), lower);
    upper = select(beyond, set(lights.start_upto[i]), upper);
    index = hn::IfThenElse(hn::RebindMask(du_, beyond), set_word(i), index);
  }
  u = hn::Min(hn::Div(hn::Sub(u, lower), hn::Sub(upper, lower)), set(0x1.fffffep-1f));
  return index;
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_CHOICE_INL
