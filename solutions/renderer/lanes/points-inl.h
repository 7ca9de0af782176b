// Sample points: sampling/sobol.h, one point per lane. Included once for each instruction set.

#if defined(CARLO_POINTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_POINTS_INL
#undef CARLO_POINTS_INL
#else
#define CARLO_POINTS_INL
#endif

#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

HWY_INLINE U reverse_bits(U x) {
  using DB = hn::Repartition<std::uint8_t, DU>;
  constexpr DB db;
  alignas(16) static constexpr std::uint8_t nibbles[16] = {0, 8, 4, 12, 2, 10, 6, 14,
                                                           1, 9, 5, 13, 3, 11, 7, 15};
  alignas(16) static constexpr std::uint8_t bytes[16] = {3,  2,  1, 0, 7,  6,  5,  4,
                                                         11, 10, 9, 8, 15, 14, 13, 12};
  const U low = set_word(0x0F0F0F0F);
  const auto table = hn::LoadDup128(db, nibbles);
  const auto from_low = hn::TableLookupBytes(table, hn::BitCast(db, hn::And(x, low)));
  const auto from_high =
      hn::TableLookupBytes(table, hn::BitCast(db, hn::And(hn::ShiftRight<4>(x), low)));
  const U swapped =
      hn::Or(hn::ShiftLeft<4>(hn::BitCast(du_, from_low)), hn::BitCast(du_, from_high));
  return hn::BitCast(du_,
                     hn::TableLookupBytes(hn::BitCast(db, swapped), hn::LoadDup128(db, bytes)));
}

HWY_INLINE U nested_hash(U x, U seed) {
  x = hn::Xor(x, hn::Mul(x, set_word(0x3D20ADEA)));
  x = hn::Add(x, seed);
  x = hn::Mul(x, hn::Or(hn::ShiftRight<16>(seed), set_word(1)));
  x = hn::Xor(x, hn::Mul(x, set_word(0x05526C56)));
  return hn::Xor(x, hn::Mul(x, set_word(0x53A22864)));
}

/// The second Sobol' coordinate of the point whose first is x: Pascal's triangle modulo 2 times the
/// index, sobol_second(reverse_bits(x)). Both sides of the product are mirrored, so that the shifts
/// go left and no bits need reversing.
HWY_INLINE U second_coordinate(U x) {
  x = hn::Xor(x, hn::And(hn::ShiftLeft<1>(x), set_word(0xAAAAAAAA)));
  x = hn::Xor(x, hn::And(hn::ShiftLeft<2>(x), set_word(0xCCCCCCCC)));
  x = hn::Xor(x, hn::And(hn::ShiftLeft<4>(x), set_word(0xF0F0F0F0)));
  x = hn::Xor(x, hn::And(hn::ShiftLeft<8>(x), set_word(0xFF00FF00)));
  return hn::Xor(x, hn::ShiftLeft<16>(x));
}

/// A bijection of words whose output bits depend on all input bits (C. Wellons' "lowbias32").
HWY_INLINE U mix(U x) {
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<16>(x)), set_word(0x7FEB352D));
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<15>(x)), set_word(0x846CA68B));
  return hn::Xor(x, hn::ShiftRight<16>(x));
}

/// In [0, 1), never 1.
HWY_INLINE V to_unit(U x) {
  return hn::Mul(hn::ConvertTo(d_, hn::BitCast(di_, hn::ShiftRight<8>(x))), set(0x1p-24f));
}

/// Adds to each binary digit of a fraction the two before it, each where the bits of `which` say
/// so.
HWY_INLINE U add_digits(U fraction, U which) {
  const U one = hn::And(hn::ShiftRight<1>(fraction), which);
  const U two = hn::And(hn::ShiftRight<2>(fraction), hn::ShiftLeft<11>(which));
  return hn::Xor(fraction, hn::Xor(one, two));
}

/// The points of one dimension pair: Sobol' points in shuffled order, scrambled and shifted by the
/// random word k. `index` is the sample's number within its pixel, its bits reversed. Shuffling
/// keeps 2^m points together (nested_hash), so that they remain a (0, m, 2)-net; so does scrambling
/// digits by those before them (the cheapest part of Matousek's random linear scrambling). Without
/// it all pairs would be the same net up to a shift, and integrands constant on that net, such as
/// the product of the second digits on 4 points, would have the variance of one point.
HWY_INLINE V2 sobol_2d(U index, U k) {
  // The bit-reversed index is the first coordinate.
  const U x = nested_hash(index, k);
  const U y = second_coordinate(x);
  const U shift = hn::Mul(k, set_word(0xB5297A4D));
  return {to_unit(add_digits(x, shift)), to_unit(hn::Xor(add_digits(y, k), shift))};
}

/// Independent points instead of Sobol'.
HWY_INLINE V2 random_2d(U reversed_index, U k) {
  const U point = mix(hn::Xor(k, mix(hn::Add(reversed_index, set_word(0x85EBCA6B)))));
  return {to_unit(point), to_unit(mix(hn::Add(point, set_word(0x9E3779B9))))};
}

/// The random word of a vertex's second dimension pair, from that of its first.
HWY_INLINE U second_word(U k) {
  return hn::Mul(hn::Xor(k, hn::ShiftRight<15>(k)), set_word(0x2C1B3C6D));
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_POINTS_INL
