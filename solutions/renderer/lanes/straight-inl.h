// Traces a tile's paths where each ends at its first surface, as in a scene of lights alone.
// Included once for each instruction set.

#if defined(CARLO_STRAIGHT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_STRAIGHT_INL
#undef CARLO_STRAIGHT_INL
#else
#define CARLO_STRAIGHT_INL
#endif

#include "render/blocks.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/paths-inl.h"
#include "renderer/lanes/starts-inl.h"
#include "renderer/lanes/sums-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The parallelograms of runs that camera rays may meet: all but those beside the image that the
/// rays' pixels have on their plane. Pixels are taken together, side by side, to `samples` samples
/// if possible; parallelograms are compared a register at a time, once for all these samples, where
/// each register of rays would search all patches.
class SeenMembers {
 public:
  explicit SeenMembers(const LaneJob& job)
      : job_(job),
        s_(job.scene),
        width_(std::clamp(static_cast<int>(samples / job.samples()), 1, carlo::driver_tile_size)),
        members_(s_.first_disk - s_.first_quad),
        count_(members_.size()) {}

  /// Prepares for rays; false if they lead through pixels that are not taken together.
  HWY_INLINE bool covers(const CameraRays& rays) {
    const int x = cell(rays.x);
    if (rays.y != rays.last_y || x != cell(rays.last_x)) return false;
    if (x != x_ || rays.y != y_) {
      x_ = x, y_ = rays.y;
      look();
    }
    return true;
  }

  /// As NearbyMembers. Calls them in the same order.
  template <class F>
  HWY_INLINE void operator()(const LaneScene&, const Run& run, V3, M, const F& f) const {
    const std::uint32_t first = run.first - s_.first_quad;
    for (std::uint32_t k = first; k < first + count_[first]; ++k)
      f(members_[k]);
  }

 private:
  static constexpr std::uint32_t samples = 256;
  /// The relative error of points on the plane that rays meet at this cosine or more. Where some
  /// meet it at a smaller one, nothing is left out.
  static constexpr float margin = 0x1p-15f, least_cosine = 0x1p-4f;

  int cell(int x) const { return job_.tile.x0 + (x - job_.tile.x0) / width_ * width_; }

  void look() {
    for (std::uint32_t i = s_.first_quad; i < s_.first_disk; i = s_.run_end[i]) {
      if (s_.run_end[i] > i + 1) look_at(run_from(s_, i));
    }
  }

  struct Corners {
    std::array<V3, 4> p;
    V3 extent;  ///< of all coordinates on the way to them
    bool ahead;
  };
  /// Where the corners of the pixels lie on the run's plane.
  HWY_INLINE Corners corners(const Run& run) const {
    const U corner = hn::Iota(du_, 0);
    const M right = differs(hn::And(corner, set_word(1)), set_word(0)),
            below = differs(hn::And(corner, set_word(2)), set_word(0));
    const V x = set(static_cast<float>(x_)), y = set(static_cast<float>(y_));
    const V3 d =
        camera_direction(job_, select(right, hn::Add(x, set(static_cast<float>(width_))), x),
                         select(below, hn::Add(y, set(1)), y));
    const carlo::Vec3 from = job_.camera.origin;
    const V3 o = set(from.x, from.y, from.z);
    const PlaneHit hit = intersect_plane<Outline::quad>(s_, run.first, o, d);
    const V3 p = add_scaled(o, hit.t, d);
    Corners found;
    const auto value = [&](V c, int k) HWY_ATTR {
      return hn::TableLookupLanes(c, hn::IndicesFromVec(d_, hn::Set(di_, k)));
    };
    V least = hit.along, most = hit.along, nearest = hit.t;
    found.extent = {hn::Abs(o.x), hn::Abs(o.y), hn::Abs(o.z)};
    for (int k = 0; k < 4; ++k) {
      const V3 c{value(p.x, k), value(p.y, k), value(p.z, k)};
      found.p[static_cast<std::size_t>(k)] = c;
      found.extent = {hn::Max(found.extent.x, hn::Abs(c.x)), hn::Max(found.extent.y, hn::Abs(c.y)),
                      hn::Max(found.extent.z, hn::Abs(c.z))};
      least = hn::Min(least, value(hit.along, k)), most = hn::Max(most, value(hit.along, k));
      nearest = hn::Min(nearest, value(hit.t, k));
    }
    const float low = hn::GetLane(least), high = hn::GetLane(most);
    found.ahead = hn::GetLane(nearest) > 0 && (low >= least_cosine || high <= -least_cosine);
    return found;
  }

  HWY_INLINE void look_at(const Run& run) {
    const Corners c = corners(run);
    const std::uint32_t first = run.first - s_.first_quad;
    std::uint32_t count = 0;
    for (std::uint32_t row = run.first / lanes * lanes; row < run.end; row += lanes) {
      std::uint32_t seen = c.ahead ? bits(hn::And(meets(c, s_.ax, s_.ay, s_.az, s_.a0, row),
                                                  meets(c, s_.bx, s_.by, s_.bz, s_.b0, row)))
                                   : ~std::uint32_t{0};
      for (std::uint32_t k = 0; k < lanes; ++k) {
        if ((seen >> k & 1) != 0 && row + k >= run.first && row + k < run.end)
          members_[first + count++] = row + k;
      }
    }
    count_[first] = count;
  }

  /// Whether the pixels' image comes between -reach and reach of this coordinate of each member.
  template <class Column>
  HWY_INLINE M meets(const Corners& c, const Column& x, const Column& y, const Column& z,
                     const Column& zero, std::uint32_t row) const {
    const V3 axis{hn::LoadU(d_, x.data() + row), hn::LoadU(d_, y.data() + row),
                  hn::LoadU(d_, z.data() + row)};
    const V origin = hn::LoadU(d_, zero.data() + row);
    V low = set(longest), high = set(-longest);
    for (const V3& p : c.p) {
      const V value = hn::Sub(dot(axis, p), origin);
      low = hn::Min(low, value), high = hn::Max(high, value);
    }
    const V3 size{hn::Abs(axis.x), hn::Abs(axis.y), hn::Abs(axis.z)};
    const V most = mul_add(set(margin), hn::Add(dot(size, c.extent), hn::Abs(origin)), set(reach));
    return hn::And(hn::Le(low, most), hn::Ge(high, hn::Neg(most)));
  }

  const LaneJob& job_;
  const LaneScene& s_;
  int width_;            ///< pixels taken together
  int x_ = -1, y_ = -1;  ///< the first of them
  /// Of a run that begins with the i-th parallelogram: count_[i] members, from members_[i] on.
  std::vector<std::uint32_t> members_, count_;
};

/// run() for scenes whose longest path has one segment, with the same bits: no lane outlives
/// another, so that samples neither wait for a lane nor for each other. (Starting and collecting
/// them one by one took half of the time.)
HWY_INLINE void run_straight(const LaneJob& job, std::span<std::array<double, 3>> means,
                             carlo::Counts& counts) {
  using Needs = Features<false, true, false, false, true>;
  Starts starts(job);
  Sums sums(job, means);
  SeenMembers seen(job);
  const Walk<Needs> walk(job, counts);
  const carlo::Vec3 o = job.camera.origin;
  Paths paths = zeros<Paths>();
  paths.from.o = set(o.x, o.y, o.z);
  paths.from.last = paths.from.plane = set_word(nothing);
  Vertex vertex;
  while (const std::uint32_t some = starts.allow(Sums::most)) {
    if (carlo::render_interrupted()) return;
    for (std::uint32_t first = 0; first < some; first += lanes) {
      const CameraRays rays = starts.next_register();
      const M alive = hn::FirstN(d_, rays.count);
      if (seen.covers(rays)) {
        vertex.hits = closest<true, false>(job.scene, paths.from, rays.d, alive, seen);
      } else {
        vertex.hits = closest<true, false>(job.scene, paths.from, rays.d, alive);
      }
      counts.paths += rays.count, counts.rays += rays.count;
      paths.d = rays.d, paths.alive = alive;
      paths.L = set(0, 0, 0), paths.beta = set(1, 1, 1);
      walk.shade(paths, vertex);
      sums.radiances().keep_row(paths, alive, first, counts);
    }
    sums.add(some);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_STRAIGHT_INL
