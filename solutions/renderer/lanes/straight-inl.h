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
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The parallelograms that camera rays of a few pixels, side by side, may meet: all but those
/// beside the image that the pixels have on their planes. They are compared a register at a time,
/// once for all samples of these pixels, where each register of rays would search all patches.
class SeenMembers {
 public:
  explicit SeenMembers(const LaneJob& job)
      : job_(job),
        s_(job.scene),
        could_be_alike_(s_.solids.empty() && !s_.enclosed && s_.surfaces == s_.first_disk &&
                        carlo::Vec3(s_.environment[0], s_.environment[1], s_.environment[2]) ==
                            carlo::Vec3(0)),
        strips_(s_.first_disk - s_.first_quad),
        members_(strips_.size()),
        count_(strips_.size()) {}

  /// How many pixels to look at together: to `samples` samples if possible.
  int width() const {
    return std::clamp(static_cast<int>(samples / job_.samples()), 1, carlo::driver_tile_size);
  }

  /// Looks at the next pixels, from (x, y) on.
  HWY_INLINE void look(int x, int y) {
    if (y != y_ || ++cell_ == cells) begin_strip(x, y);
    alike_ = could_be_alike_, seen_ = covered_ = false;
    radiance_ = carlo::Vec3(0);
    for (std::uint32_t i = s_.first_quad; i < s_.first_disk; i = s_.run_end[i]) {
      if (alike_ || s_.run_end[i] > i + 1) look_at(run_from(s_, i));
    }
  }

  /// The radiance along all rays of these pixels that meet something, if it is certain to be the
  /// same, and all others find none.
  std::optional<carlo::Vec3> only_radiance() const {
    if (!alike_) return std::nullopt;
    return radiance_;
  }
  /// Whether none or all of these rays meet something, for certain.
  bool none_meets() const { return alike_ && !seen_; }
  bool all_meet() const { return alike_ && covered_; }

  /// As NearbyMembers. Calls them in the same order.
  template <class F>
  HWY_INLINE void operator()(const LaneScene&, const Run& run, V3, M, const F& f) const {
    const std::uint32_t first = run.first - s_.first_quad;
    for (std::uint32_t k = first; k < first + count_[first]; ++k)
      f(members_[k]);
  }

 private:
  static constexpr std::uint32_t samples = 128;
  /// The relative error of points on the plane that rays meet at this cosine or more. Where some
  /// meet it at a smaller one, nothing is left out.
  static constexpr float margin = 0x1p-15f, least_cosine = 0x1p-4f;

  /// Where rays through the upper and lower corners of the next `cells` groups of pixels meet a
  /// run's plane: the upper ones in the first half of the lanes.
  struct alignas(64) Strip {
    V3 p;
    V t, along;
  };
  static constexpr std::uint32_t half = lanes / 2, cells = half - 1;

  HWY_NOINLINE void begin_strip(int x, int y) {
    y_ = y, cell_ = 0;
    const U lane = hn::Iota(du_, 0);
    const M below = hn::RebindMask(d_, hn::Gt(lane, set_word(half - 1)));
    const V column = hn::ConvertTo(d_, hn::BitCast(di_, hn::And(lane, set_word(half - 1))));
    const V corner_x =
        hn::Min(mul_add(column, set(static_cast<float>(width())), set(static_cast<float>(x))),
                set(static_cast<float>(job_.tile.x1)));
    const V corner_y = select(below, set(static_cast<float>(y + 1)), set(static_cast<float>(y)));
    const V3 d = camera_direction(job_, corner_x, corner_y);
    const carlo::Vec3 from = job_.camera.origin;
    const V3 o = set(from.x, from.y, from.z);
    for (std::uint32_t i = s_.first_quad; i < s_.first_disk; i = s_.run_end[i]) {
      const PlaneHit hit = intersect_plane<Outline::quad>(s_, i, o, d);
      strips_[i - s_.first_quad] = {add_scaled(o, hit.t, d), hit.t, hit.along};
    }
  }

  struct Corners {
    std::array<V3, 4> p;
    V3 extent;  ///< of all coordinates on the way to them
    bool ahead;
    bool along;  ///< whether rays go along the plane's normal, not against it
  };
  /// Where the corners of the pixels lie on the run's plane.
  HWY_INLINE Corners corners(const Run& run) const {
    const Strip& strip = strips_[run.first - s_.first_quad];
    const carlo::Vec3 o = job_.camera.origin;
    Corners found;
    found.extent = set(std::abs(o.x), std::abs(o.y), std::abs(o.z));
    V least = set(longest), most = set(-longest), nearest = set(longest);
    for (std::uint32_t k = 0; k < 4; ++k) {
      const auto lane = hn::IndicesFromVec(d_, set_word(cell_ + k % 2 + k / 2 * half));
      const auto value = [&](V c) HWY_ATTR { return hn::TableLookupLanes(c, lane); };
      const V3 c{value(strip.p.x), value(strip.p.y), value(strip.p.z)};
      found.p[k] = c;
      found.extent = {hn::Max(found.extent.x, hn::Abs(c.x)), hn::Max(found.extent.y, hn::Abs(c.y)),
                      hn::Max(found.extent.z, hn::Abs(c.z))};
      const V along = value(strip.along);
      least = hn::Min(least, along), most = hn::Max(most, along);
      nearest = hn::Min(nearest, value(strip.t));
    }
    const float low = hn::GetLane(least), high = hn::GetLane(most);
    found.ahead = hn::GetLane(nearest) > 0 && (low >= least_cosine || high <= -least_cosine);
    found.along = low > 0;
    return found;
  }

  HWY_INLINE void look_at(const Run& run) {
    const Corners c = corners(run);
    alike_ = alike_ && c.ahead;
    const std::uint32_t first = run.first - s_.first_quad;
    std::uint32_t count = 0;
    for (std::uint32_t row = run.first / lanes * lanes; row < run.end; row += lanes) {
      const Across a = across(c, s_.ax, s_.ay, s_.az, s_.a0, row),
                   b = across(c, s_.bx, s_.by, s_.bz, s_.b0, row);
      std::uint32_t seen = bits(hn::And(in_run(run, row), hn::And(a.meets, b.meets)));
      const std::uint32_t covers = bits(hn::And(a.within, b.within));
      covered_ = covered_ || (seen & covers) != 0;
      for (; seen != 0; seen &= seen - 1) {
        members_[first + count] = row + static_cast<std::uint32_t>(std::countr_zero(seen));
        if (alike_) compare(members_[first + count], c.along);
        ++count;
      }
    }
    count_[first] = count;
  }

  HWY_INLINE static M in_run(const Run& run, std::uint32_t row) {
    const U number = hn::Add(hn::Iota(du_, 0), set_word(row));
    return hn::RebindMask(
        d_, hn::AndNot(hn::Lt(number, set_word(run.first)), hn::Lt(number, set_word(run.end))));
  }

  /// Notes a parallelogram that these pixels may see.
  void compare(std::uint32_t k, bool along) {
    const bool front = (s_.turned[k] != 0) == along, bright = front && s_.light_density[k] > 0;
    const carlo::Vec3 radiance =
        bright ? carlo::Vec3(s_.le_r[k], s_.le_g[k], s_.le_b[k]) : carlo::Vec3(0);
    alike_ = !seen_ || radiance == radiance_;
    radiance_ = radiance, seen_ = true;
  }

  /// Whether the pixels' image comes between -reach and reach of this coordinate of each member,
  /// and whether it stays there. Where some of it is not ahead, it may come anywhere.
  struct Across {
    M meets, within;
  };
  template <class Column>
  HWY_INLINE Across across(const Corners& c, const Column& x, const Column& y, const Column& z,
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
    const V error = hn::Mul(set(margin), hn::Add(dot(size, c.extent), hn::Abs(origin)));
    const V most = hn::Add(set(reach), error), least = hn::Sub(set(reach), error);
    const M meets = hn::And(hn::Le(low, most), hn::Ge(high, hn::Neg(most)));
    const M within = hn::And(hn::Ge(low, hn::Neg(least)), hn::Le(high, least));
    const M ahead = hn::FirstN(d_, c.ahead ? lanes : 0);
    return {hn::Or(meets, hn::Not(ahead)), hn::And(within, ahead)};
  }

  const LaneJob& job_;
  const LaneScene& s_;
  bool could_be_alike_;  ///< nothing but parallelograms in the dark
  // What look() has reached: a row, and a group of pixels of the strip there.
  int y_ = -1;
  std::uint32_t cell_ = 0;
  std::vector<Strip> strips_;  ///< of the run that begins with the i-th parallelogram
  bool alike_ = false, seen_ = false, covered_ = false;
  carlo::Vec3 radiance_{0};
  /// Of a run that begins with the i-th parallelogram: count_[i] members, from members_[i] on.
  std::vector<std::uint32_t> members_, count_;
};

/// run() for scenes whose longest path has one segment, with the same bits: no lane outlives
/// another, so that samples neither wait for a lane nor for each other; and pixels of one radiance
/// need no rays.
class StraightPaths {
  using Needs = Features<false, true, false, false, true>;

 public:
  HWY_ATTR StraightPaths(const LaneJob& job, std::span<std::array<double, 3>> means,
                         carlo::Counts& counts)
      : job_(job),
        counts_(counts),
        starts_(job),
        sums_(job, means),
        seen_(job),
        walk_(job, counts) {}

  HWY_ATTR void run() {
    const carlo::Tile& tile = job_.tile;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; x += seen_.width()) {
        if (carlo::render_interrupted()) return;
        const int width = std::min(seen_.width(), tile.x1 - x);
        left_ = std::uint64_t{job_.samples()} * static_cast<unsigned>(width);
        counts_.paths += left_;
        seen_.look(x, y);
        const std::optional<carlo::Vec3> only = seen_.only_radiance();
        if (seen_.none_meets() || seen_.all_meet()) {
          sums_.add_pixels(width, *only);
          continue;
        }
        starts_.go_to(x, y);
        if (only)
          count_hits(*only);
        else
          trace();
      }
    }
  }

 private:
  /// Starts up to Sums::most of the samples that are left; returns how many.
  HWY_INLINE std::uint32_t start_some() {
    const auto some = static_cast<std::uint32_t>(std::min<std::uint64_t>(left_, Sums::most));
    left_ -= some;
    counts_.rays += some;
    return starts_.allow(some);
  }

  HWY_INLINE Origins camera() const {
    const carlo::Vec3 o = job_.camera.origin;
    Origins from = zeros<Origins>();
    from.o = set(o.x, o.y, o.z);
    from.last = from.plane = set_word(nothing);
    return from;
  }

  /// Traces samples that find this radiance or none.
  HWY_INLINE void count_hits(carlo::Vec3 radiance) {
    const Origins from = camera();
    while (const std::uint32_t some = start_some()) {
      for (std::uint32_t first = 0; first < some; first += lanes) {
        const CameraRays rays = starts_.next_register();
        const M alive = hn::FirstN(d_, rays.count);
        const Hits hits = closest<true, false>(job_.scene, from, rays.d, alive, seen_);
        const M met = hn::And(alive, differs(hits.surface, set_word(nothing)));
        sums_.add_hits(bits(met), rays.count, radiance);
      }
    }
  }

  HWY_NOINLINE void trace() {
    Paths paths = zeros<Paths>();
    paths.from = camera();
    while (const std::uint32_t some = start_some()) {
      for (std::uint32_t first = 0; first < some; first += lanes) {
        const CameraRays rays = starts_.next_register();
        const M alive = hn::FirstN(d_, rays.count);
        Vertex vertex;
        vertex.hits = closest<true, false>(job_.scene, paths.from, rays.d, alive, seen_);
        paths.d = rays.d, paths.alive = alive;
        paths.L = set(0, 0, 0), paths.beta = set(1, 1, 1);
        walk_.shade(paths, vertex);
        sums_.radiances().keep_row(paths, alive, first, counts_);
      }
      sums_.add(some);
    }
  }

  const LaneJob& job_;
  carlo::Counts& counts_;
  Starts starts_;
  Sums sums_;
  SeenMembers seen_;
  Walk<Needs> walk_;
  std::uint64_t left_ = 0;  ///< samples of the pixels at hand that have not started
};

/// Adds the light that a tile's pixels see directly, where paths leave it out (LaneJob): at the
/// edges of bright lights most of the noise is theirs. Several rays for each path look for it, in
/// pixels that may see a light.
class SeenLights {
 public:
  HWY_ATTR SeenLights(const LaneJob& job, std::span<std::array<double, 3>> means,
                      carlo::Counts& counts)
      : job_(job), means_(means), counts_(counts) {}

  HWY_ATTR void run() {
    const carlo::Tile& tile = job_.tile;
    const int columns = tile.x1 - tile.x0;
    std::vector<char> seen(means_.size() / job_.blocks);
    for (const FilmRectangle& at : job_.lights_apart) {
      for (int y = std::max(at.y0, tile.y0); y < std::min(at.y1, tile.y1); ++y) {
        for (int x = std::max(at.x0, tile.x0); x < std::min(at.x1, tile.x1); ++x)
          seen[static_cast<std::size_t>((y - tile.y0) * columns + x - tile.x0)] = 1;
      }
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto number = static_cast<int>(i);
      if (seen[i] != 0)
        add(tile.x0 + number % columns, tile.y0 + number / columns,
            means_.subspan(i * job_.blocks, job_.blocks));
    }
  }

 private:
  static constexpr std::uint32_t rays_for_path = 4;

  /// With other points than the paths'.
  HWY_NOINLINE void add(int x, int y, std::span<std::array<double, 3>> means) {
    carlo::Tile pixel = job_.tile;
    pixel.first_sample *= rays_for_path, pixel.samples *= rays_for_path;
    pixel.x0 = x, pixel.x1 = x + 1, pixel.y0 = y, pixel.y1 = y + 1;
    const LaneJob job{job_.scene, job_.camera, job_.width, job_.height,  1,
                      ~job_.seed, job_.sobol,  pixel,      job_.choices, job_.blocks};
    std::vector<std::array<double, 3>> found(job.blocks);
    carlo::Counts counts;
    StraightPaths(job, found, counts).run();
    counts_.rays += counts.rays, counts_.bad += counts.bad;
    for (std::size_t b = 0; b < found.size(); ++b) {
      for (std::size_t c = 0; c < 3; ++c)
        means[b][c] += found[b][c];
    }
  }

  const LaneJob& job_;
  std::span<std::array<double, 3>> means_;
  carlo::Counts& counts_;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_STRAIGHT_INL
