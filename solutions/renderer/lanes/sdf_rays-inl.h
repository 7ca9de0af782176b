// Rays that may hit a signed distance function, in its coordinates. Included once for each
// instruction set.

#if defined(CARLO_SDF_RAYS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SDF_RAYS_INL
#undef CARLO_SDF_RAYS_INL
#else
#define CARLO_SDF_RAYS_INL
#endif

#include "renderer/lanes/lane_sdf.h"
#include "renderer/lanes/sdf-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The number of registers of paths traced together in scenes with sdfs: few rays of each register
/// come near an sdf, and these take very different numbers of steps.
constexpr std::size_t batch = 32;

using DL = hn::RebindToSigned<DD>;
using VL = hn::Vec<DL>;
constexpr DL dl_;

/// Some of a batch's rays, packed: first as they come, then in an sdf's coordinates as o + s d, |d|
/// = 1.
struct SdfRays {
  /// Whole registers are written, the last one past the rays.
  template <class T>
  struct alignas(64) Row : std::array<T, (batch + 1) * lanes> {};
  Row<float> from_x, from_y, from_z, along_x, along_y, along_z, longest;
  Row<std::uint32_t> lane;  ///< of the batch
  Row<double> ox, oy, oz, dx, dy, dz, t_per_s;
  Row<double> begin, end;      ///< of the part within the sdf's box
  Row<double> fine;            ///< resolution()
  Row<double> s;               ///< of the hit; below 0: none
  Row<double> a, b, f_a, f_b;  ///< bracket of the hit, with values of F of different signs
  std::size_t count = 0;

  /// Adds the `wanted` rays o + t d, t up to `far`, of the register that starts at lane first_lane.
  HWY_INLINE void add(V3 o, V3 d, V far, M wanted, std::size_t first_lane) {
    const ToFront to_front(wanted);
    const auto put = [&](V v, Row<float>& row)
                         HWY_ATTR { hn::StoreU(to_front(v), d_, row.data() + count); };
    put(o.x, from_x), put(o.y, from_y), put(o.z, from_z);
    put(d.x, along_x), put(d.y, along_y), put(d.z, along_z);
    put(far, longest);
    const U number = hn::Iota(du_, static_cast<std::uint32_t>(first_lane));
    hn::StoreU(to_front(number), du_, lane.data() + count);
    count += hn::CountTrue(d_, wanted);
  }
  /// Turns rays into the sdf's coordinates.
  HWY_INLINE void turn(const LaneSdf& sdf) {
    const auto& place = sdf.place;
    const VD scale = number(place.scale), per_scale = number(1 / place.scale);
    for (std::size_t i = 0; i < count; i += doubles) {
      const auto of = [i](const Row<float>& row)
                          HWY_ATTR { return hn::PromoteTo(dd_, hn::LoadU(half_, row.data() + i)); };
      const V3D from = V3D{of(from_x), of(from_y), of(from_z)} - numbers(place.origin);
      const V3D o = per_scale * turned_back(place.rotation, from);
      const V3D d = turned_back(place.rotation, {of(along_x), of(along_y), of(along_z)});
      const VD l = length(d);
      put(o, i, ox, oy, oz);
      put(hn::Div(number(1), l) * d, i, dx, dy, dz);
      hn::Store(hn::Div(scale, l), dd_, t_per_s.data() + i);
    }
  }
  HWY_INLINE V3D origins(VL i) const { return {of(ox, i), of(oy, i), of(oz, i)}; }
  HWY_INLINE V3D directions(VL i) const { return {of(dx, i), of(dy, i), of(dz, i)}; }
  HWY_INLINE VD of(const Row<double>& row, VL i) const {
    return hn::GatherIndex(dd_, row.data(), i);
  }
  HWY_INLINE V3D origins(std::size_t i) const { return {of(ox, i), of(oy, i), of(oz, i)}; }
  HWY_INLINE V3D directions(std::size_t i) const { return {of(dx, i), of(dy, i), of(dz, i)}; }
  HWY_INLINE VD of(const Row<double>& row, std::size_t i) const {
    return hn::Load(dd_, row.data() + i);
  }

 private:
  static constexpr hn::Rebind<float, DD> half_{};
  HWY_INLINE void put(V3D v, std::size_t i, Row<double>& x, Row<double>& y, Row<double>& z) {
    hn::Store(v.x, dd_, x.data() + i);
    hn::Store(v.y, dd_, y.data() + i);
    hn::Store(v.z, dd_, z.data() + i);
  }
};

HWY_INLINE V3D at(const V3D& o, const V3D& d, VD s) {
  return {mul_add(s, d.x, o.x), mul_add(s, d.y, o.y), mul_add(s, d.z, o.z)};
}

/// The precision with which a point of a ray from o can be known to lie on the surface: 64
/// roundings of the largest number involved.
HWY_INLINE VD resolution(const LaneSdf& sdf, const V3D& o) {
  return hn::Mul(number(0x1p-46), hn::Add(length(o), number(sdf.reach)));
}

/// Clips [begin, end] to the part in which rays are inside the sdf's box.
HWY_INLINE void clip(const LaneSdf& sdf, const V3D& o, const V3D& d, VD& begin, VD& end) {
  const auto slab = [&](VD from, VD along, double lower, double upper) HWY_ATTR {
    // A component of 0 is replaced by one so small that no quotient is 0 / 0.
    const VD inverse =
        hn::Div(number(1), hn::IfThenElse(hn::Eq(along, number(0)), number(0x1p-1000), along));
    const VD a = hn::Mul(hn::Sub(number(lower), from), inverse),
             b = hn::Mul(hn::Sub(number(upper), from), inverse);
    begin = hn::Max(begin, hn::Min(a, b));
    end = hn::Min(end, hn::Max(a, b));
  };
  slab(o.x, d.x, sdf.box.lower.x, sdf.box.upper.x);
  slab(o.y, d.y, sdf.box.lower.y, sdf.box.upper.y);
  slab(o.z, d.z, sdf.box.lower.z, sdf.box.upper.z);
}

/// Fills SdfRays' begin, end and fine.
HWY_INLINE void prepare(const LaneSdf& sdf, SdfRays& rays) {
  rays.turn(sdf);
  for (std::size_t i = 0; i < rays.count; i += doubles) {
    const V3D o = rays.origins(i);
    const VD longest =
        hn::PromoteTo(dd_, hn::LoadU(hn::Rebind<float, DD>(), rays.longest.data() + i));
    VD begin = number(0), end = hn::Div(longest, rays.of(rays.t_per_s, i));
    clip(sdf, o, rays.directions(i), begin, end);
    hn::Store(begin, dd_, rays.begin.data() + i);
    hn::Store(end, dd_, rays.end.data() + i);
    hn::Store(resolution(sdf, o), dd_, rays.fine.data() + i);
    hn::Store(number(-1), dd_, rays.s.data() + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SDF_RAYS_INL
