// Paths whose second vertices pixels share. Included once for each instruction set.

#if defined(CARLO_SHARING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SHARING_INL
#undef CARLO_SHARING_INL
#else
#define CARLO_SHARING_INL
#endif

#include "random/hash.h"
#include "render/blocks.h"
#include "renderer/lanes/intersect-inl.h"
#include "renderer/lanes/mesh_hits-inl.h"
#include "renderer/lanes/paths-inl.h"
#include "renderer/lanes/shared_vertices-inl.h"
#include "renderer/lanes/starts-inl.h"
#include "renderer/lanes/sums-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Traces a tile's paths in groups of four pixels, two apart along both axes, so that no neighbours
/// share errors. The i-th samples of a group are side by side in four lanes.
///
/// Each path goes from its first vertex x on to a second one, y, and on; from y it brings the
/// radiance Lo(y), which a diffuse y sends to all points alike. So each of the four x takes the Lo
/// of all four y that it sees, as if its own path had gone there (Bekaert, Sbert and Halton,
/// Accelerating path tracing by re-using paths, 2002). MIS weighs the four ways to y by the balance
/// heuristic over their densities p(x -> y) (that y sees x, cosines, distance), so x_i finds
///
///   k_i sum_j Lo(y_j) p(x_i -> y_j) / (sum_m q_m p(x_m -> y_j)),
///
/// with reflectance k_i and the probability q_m that roulette lets the path of x_m go on. Light
/// that y emits, and light from points sampled on lights, is not shared.
template <class Needs>
class SharedPaths {
 public:
  HWY_ATTR SharedPaths(const LaneJob& job, std::span<std::array<double, 3>> means,
                       carlo::Counts& counts)
      : job_(job),
        s_(job.scene),
        means_(means),
        counts_(counts),
        columns_((job.tile.x1 - job.tile.x0 + 3) / 4),
        groups_(columns_ * ((job.tile.y1 - job.tile.y0 + 3) / 4) * 4),
        seconds_(s_),
        walk_(job, counts, nullptr, &seconds_) {}

  HWY_ATTR void run() {
    while (start_batch()) {
      if (!trace()) return;
      seconds_.put_in_place();
      const float* const rest = rest_.stored();
      for (std::size_t r = 0; r < rows_.size(); ++r)
        share(rows_[r], r * lanes, rest + 3 * r * lanes);
    }
  }

 private:
  /// A register of a group's samples, from `first` on.
  struct Row {
    int group;
    std::uint32_t first, samples;
  };

  /// Traces the first segments of as many paths as fit; false if there are no more.
  bool start_batch() {
    rows_.clear();
    waiting_ = taken_ = 0;
    while (rows_.size() < most_shared / lanes && group_ < groups_) {
      const std::uint32_t left = job_.samples() - sample_;
      const Row row{group_, sample_, std::min(static_cast<std::uint32_t>(lanes / 4), left)};
      trace_first(row, rows_.size() * lanes);
      rows_.push_back(row);
      sample_ += row.samples;
      if (sample_ == job_.samples()) sample_ = 0, ++group_;
    }
    return !rows_.empty();
  }

  /// The first of a group's pixels.
  int group_x(int group) const { return job_.tile.x0 + group / 4 % columns_ * 4 + group % 2; }
  int group_y(int group) const { return job_.tile.y0 + group / 4 / columns_ * 4 + group / 2 % 2; }

  /// The paths of a row, at the camera; `alive` are those in the tile.
  HWY_INLINE Paths at_camera(const Row& row) {
    const int x = group_x(row.group), y = group_y(row.group);
    find_keys(row.group, x, y);
    const U lane = hn::Iota(du_, 0), pair = hn::ShiftRight<2>(lane);
    const U right = hn::And(hn::ShiftLeft<1>(lane), set_word(2)),
            below = hn::And(lane, set_word(2));
    auto paths = zeros<Paths>();
    paths.key = hn::Load(du_, keys_.data());
    paths.reversed_index =
        reverse_bits(hn::Add(pair, set_word(job_.tile.first_sample + row.first)));
    const V2 jitter = points(job_, paths.reversed_index, mix(paths.key));
    paths.key = hn::Add(paths.key, set_word(key_step));
    const auto pixel = [](int first, U further) HWY_ATTR {
      return hn::ConvertTo(
          d_, hn::BitCast(di_, hn::Add(set_word(static_cast<std::uint32_t>(first)), further)));
    };
    const V px = pixel(x, right), py = pixel(y, below);
    paths.d = camera_direction(job_, hn::Add(px, jitter.x), hn::Add(py, jitter.y));
    const carlo::Vec3 o = job_.camera.origin;
    paths.from.o = set(o.x, o.y, o.z);
    paths.from.plane = paths.from.last = set_word(nothing);
    paths.beta = set(1, 1, 1);
    paths.guided = paths.roulette_scale = set(1);
    paths.from.clear = each(paths.from.o);
    paths.pdf = set(-1);
    const M inside = hn::And(hn::Lt(px, set(static_cast<float>(job_.tile.x1))),
                             hn::Lt(py, set(static_cast<float>(job_.tile.y1))));
    paths.alive = hn::And(inside, hn::RebindMask(d_, hn::Gt(set_word(row.samples), pair)));
    return paths;
  }

  void find_keys(int group, int x, int y) {
    if (group == group_of_keys_) return;
    group_of_keys_ = group;
    for (std::size_t i = 0; i < lanes; ++i) {
      const int right = i % 2 != 0 ? 2 : 0, below = i / 2 % 2 != 0 ? 2 : 0;
      keys_[i] = key_of_pixel(job_, x + right, y + below);
    }
  }

  HWY_NOINLINE void trace_first(const Row& row, std::size_t slot) {
    Paths paths = at_camera(row);
    paths.number = hn::Add(hn::Iota(du_, 0), set_word(static_cast<std::uint32_t>(slot)));
    counts_.paths += hn::CountTrue(d_, paths.alive);
    walk_.extend_first(paths);
    const M there = hn::And(paths.alive, hn::Gt(max_element(paths.beta), set(0)));
    store(firsts_.there, slot, hn::IfThenElseZero(there, set(1)));
    store(firsts_.k, slot, paths.beta);
    const V q = walk_.end_some(paths);
    paths.alive = hn::And(paths.alive, there);
    store(firsts_.q, slot, q);
    store(firsts_.per_q, slot, hn::IfThenElseZero(paths.alive, hn::Div(set(1), q)));
    store(firsts_.p, slot, paths.from.o);
    store(firsts_.n, slot, paths.n);
    if constexpr (Needs::full) {
      store(firsts_.flat_n, slot, seconds_.n_of_first);
      store(firsts_.clear, slot, paths.from.clear);
    }
    store(firsts_.L, slot, paths.L);
    if constexpr (Needs::close) store(firsts_.arrival, slot, paths.from.arrival);
    store(firsts_.last, slot, paths.from.last);
    store(firsts_.plane, slot, paths.from.plane);
    store(seconds_.there, slot, set(0));
    const ToFront front(paths.alive);
    std::size_t column = 0;
    for_each_column(paths, [&](auto& numbers) HWY_ATTR {
      hn::StoreU(front(hn::BitCast(d_, numbers)), d_, queue_[column++].data() + waiting_);
    });
    waiting_ += hn::CountTrue(d_, paths.alive);
  }

  /// Calls f with each number in which the paths that leave their first vertices differ.
  template <class F>
  HWY_INLINE void for_each_column(Paths& paths, const F& f) const {
    const auto each_of = [&](V3& v) HWY_ATTR { f(v.x), f(v.y), f(v.z); };
    each_of(paths.from.o), each_of(paths.d), f(paths.pdf);
    f(paths.from.last), f(paths.key), f(paths.reversed_index), f(paths.number);
    if constexpr (Needs::close) f(paths.from.plane), each_of(paths.from.arrival);
    if constexpr (Needs::full) each_of(paths.from.clear);
    if (job_.guide != nullptr) f(paths.guided);
    if (s_.lights <= 1 && !(Needs::full && s_.any_mesh_light)) return;
    each_of(paths.n), f(paths.probabilities.per_weight), f(paths.probabilities.of_each);
  }
  static constexpr std::size_t most_columns = 24;

  /// Starts waiting paths in free lanes.
  HWY_INLINE void refill(Paths& paths) {
    const std::uint32_t alive = bits(paths.alive);
    constexpr auto all = static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1);
    if (alive == all || taken_ == waiting_) return;
    const U position = ranks(~alive);
    const M left = hn::RebindMask(
        d_, hn::Gt(set_word(static_cast<std::uint32_t>(waiting_ - taken_)), position));
    const M starts = hn::AndNot(paths.alive, left);
    const auto starts_u = hn::RebindMask(du_, starts);
    const auto from = hn::IndicesFromVec(d_, hn::And(position, set_word(lanes - 1)));
    std::size_t column = 0;
    for_each_column(paths, [&]<class T>(T& numbers) HWY_ATTR {
      const V found = hn::TableLookupLanes(hn::LoadU(d_, queue_[column++].data() + taken_), from);
      if constexpr (std::is_same_v<T, V>)
        numbers = select(starts, found, numbers);
      else
        numbers = hn::IfThenElse(starts_u, hn::BitCast(du_, found), numbers);
    });
    paths.depth = hn::IfThenElse(starts_u, set_word(1), paths.depth);
    paths.beta = select(starts, set(1, 1, 1), paths.beta);
    paths.L = select(starts, set(0, 0, 0), paths.L);
    paths.alive = hn::Or(paths.alive, starts);
    taken_ += hn::CountTrue(d_, starts);
  }

  /// Traces the batch's paths from their first vertices on; false if interrupted.
  HWY_NOINLINE bool trace() {
    auto paths = zeros<Paths>();
    paths.alive = hn::FirstN(d_, 0);
    paths.guided = paths.roulette_scale = set(1);
    for (std::uint64_t round = 0;; ++round) {
      refill(paths);
      const M before = paths.alive;
      if (hn::AllFalse(d_, before)) return true;
      if (round % 4096 == 4095 && carlo::render_interrupted()) return false;
      if constexpr (Needs::full)
        walk_.extend_batch(std::span(&paths, 1));
      else
        walk_.extend(paths);
      const M ended = hn::AndNot(paths.alive, before);
      if (!hn::AllFalse(d_, ended)) rest_.keep(paths, ended, counts_);
    }
  }

  /// Shares what the paths of a row found from their second vertices on, and adds their samples.
  HWY_NOINLINE void share(const Row& row, std::size_t slot, const float* rest) {
    const M there = hn::Gt(load(firsts_.there, slot), set(0));
    const M goes_on = hn::Gt(load(seconds_.there, slot), set(0));
    V3 Lo = zeros<V3>();
    hn::LoadInterleaved3(d_, rest, Lo.x, Lo.y, Lo.z);
    // What is not shared: where there is no second vertex, all that the path found from its first
    // one on.
    const V per_q = load(firsts_.per_q, slot);
    const V3 own = per_q * select(goes_on, load(seconds_.L, slot), Lo);
    V3 found = select(hn::Gt(per_q, set(0)), own, set(0, 0, 0));
    if (!hn::AllFalse(d_, goes_on)) {
      const Densities p = densities(slot, there, goes_on);
      const V q = load(firsts_.q, slot);
      const V sum =
          hn::Add(hn::Add(hn::Mul(q, p.own), swap<1>(hn::Mul(q, p.of_next))),
                  hn::Add(swap<2>(hn::Mul(q, p.of_second)), swap<3>(hn::Mul(q, p.of_third))));
      Lo = select(goes_on, hn::Div(set(1), sum) * Lo, set(0, 0, 0));
      found = found + p.own * Lo + p.of_next * swap<1>(Lo) + p.of_second * swap<2>(Lo) +
              p.of_third * swap<3>(Lo);
    }
    V3 L = load(firsts_.L, slot);
    L = select(there, L + load(firsts_.k, slot) * found, L);
    alignas(64) std::array<float, 3 * lanes> samples;
    const V3 good = Radiances::valid(L, hn::FirstN(d_, lanes), counts_);
    hn::StoreInterleaved3(good.x, good.y, good.z, d_, samples.data());
    add(row, samples);
  }

  /// The densities of second vertices for the path of each lane, per area and up to a factor: its
  /// own, and those of lane ^ 1, lane ^ 2 and lane ^ 3.
  struct Densities {
    V own, of_next, of_second, of_third;
  };
  HWY_INLINE Densities densities(std::size_t slot, M there, M goes_on) {
    const V y_there = hn::IfThenElseZero(goes_on, set(1));
    const auto of = [&]<int k>(std::integral_constant<int, k>) HWY_ATTR {
      const M both = hn::And(there, hn::Gt(swap<k>(y_there), set(0)));
      return density<k>(slot, both);
    };
    return {of(std::integral_constant<int, 0>()), of(std::integral_constant<int, 1>()),
            of(std::integral_constant<int, 2>()), of(std::integral_constant<int, 3>())};
  }

  /// The density of the y of lane ^ k in the lanes of `both`, up to a factor; 0 where it is hidden,
  /// but never for a path's own.
  template <int k>
  HWY_INLINE V density(std::size_t slot, M both) const {
    const V3 x = load(firsts_.p, slot), y = swap<k>(load(seconds_.p, slot));
    const V3 to = y - x;
    const V distance2 = dot(to, to), inverse = hn::Div(set(1), hn::Sqrt(distance2));
    const V3 wi = inverse * to;
    const V cosine = dot(load(firsts_.n, slot), wi);
    const V y_cosine = hn::Neg(dot(swap<k>(load(seconds_.n, slot)), wi));
    const V p = hn::Mul(hn::Mul(cosine, y_cosine), hn::Mul(inverse, inverse));
    M seen = hn::And(hn::And(hn::Gt(cosine, set(0)), hn::Gt(y_cosine, set(0))),
                     hn::And(both, hn::Lt(p, set(longest))));
    if constexpr (k == 0)  // its path went there, whatever rounding says
      return hn::IfThenElseZero(both, hn::IfThenElse(seen, p, set(1 / longest)));
    Origins from = zeros<Origins>();
    from.o = x;
    if constexpr (Needs::close) from.arrival = load(firsts_.arrival, slot);
    from.last = load_word(firsts_.last, slot);
    from.plane = load_word(firsts_.plane, slot);
    const U plane = hn::BitCast(du_, swap<k>(load(seconds_.plane, slot)));
    M elsewhere = differs(plane, from.template starts_on<Needs::close>());
    if constexpr (Needs::close) elsewhere = hn::Or(elsewhere, is_from(s_.first_sphere, plane));
    seen = hn::And(seen, elsewhere);
    if (Needs::full && s_.smooth)
      seen = hn::And(seen, hn::Gt(dot(load(firsts_.flat_n, slot), wi), set(0)));
    if (hn::AllFalse(d_, seen)) return set(0);
    counts_.rays += hn::CountTrue(d_, seen);
    const Segments segments{from, wi, y, hn::Mul(distance2, inverse), plane};
    M clear = unoccluded<Needs::close, Needs::full, End::surface>(s_, segments, seen);
    if (Needs::full && s_.meshes) {
      occlude_by_meshes(s_, load(firsts_.clear, slot), swap<k>(load(seconds_.clear, slot)),
                        set(1 - 1e-6f), clear);
    }
    return hn::IfThenElseZero(clear, p);
  }

  /// Adds a row's samples to the sums of its pixels; completes the blocks that they end.
  void add(const Row& row, const std::array<float, 3 * lanes>& samples) {
    for (std::uint32_t i = 0; i < row.samples; ++i) {
      const float* const four = samples.data() + std::size_t{12} * i;
      for (std::size_t c = 0; c < sums_.size(); ++c)
        sums_[c] += static_cast<double>(four[c]);
      for (std::size_t c = 0; c < 3; ++c)
        products_[c] += products_of([&](std::size_t i) { return static_cast<double>(four[i]); }, c);
      if (++samples_in_block_ == job_.tile.samples) complete(row.group);
    }
  }

  /// The sum of the products of every two of a group's values of a channel, in both orders.
  template <class F>
  static double products_of(const F& value, std::size_t channel) {
    double sum = 0, squares = 0;
    for (std::size_t i = channel; i < 12; i += 3)
      sum += value(i), squares += value(i) * value(i);
    return sum * sum - squares;
  }

  void complete(int group) {
    const double n = job_.tile.samples;
    const carlo::Tile& tile = job_.tile;
    for (int q = 0; q < 4; ++q) {
      const int x = group_x(group) + q % 2 * 2, y = group_y(group) + q / 2 * 2;
      if (x >= tile.x1 || y >= tile.y1) continue;
      const int pixel = (y - tile.y0) * (tile.x1 - tile.x0) + x - tile.x0;
      for (std::size_t c = 0; c < 3; ++c)
        means_[static_cast<std::size_t>(pixel) * job_.blocks + block_][c] =
            sums_[3 * static_cast<std::size_t>(q) + c] / n;
    }
    // Of independent samples, so an upper bound with Sobol' points; one alone has no spread.
    const carlo::BlockGrid grid{job_.width, job_.height};
    for (std::size_t c = 0; c < 3; ++c) {
      const double of_means = products_of([&](std::size_t i) { return sums_[i] / n; }, c);
      double& sum = covariances_[block_][c];
      sum += n > 1 ? (products_[c] - n * of_means) * (n / (n - 1)) : products_[c];
      if (group == groups_ - 1)
        counts_.shared_covariance[c].add(sum * static_cast<double>(grid.tiles()));
    }
    sums_ = {}, products_ = {}, samples_in_block_ = 0;
    if (++block_ == job_.blocks) block_ = 0;
  }

  template <int k>
  HWY_INLINE static V swap(V v) {
    if constexpr (k == 1) return hn::Shuffle2301(v);
    if constexpr (k == 2) return hn::Shuffle1032(v);
    if constexpr (k == 3) return hn::Shuffle0123(v);
    return v;
  }
  template <int k>
  HWY_INLINE static V3 swap(V3 v) {
    return {swap<k>(v.x), swap<k>(v.y), swap<k>(v.z)};
  }

  const LaneJob& job_;
  const LaneScene& s_;
  std::span<std::array<double, 3>> means_;
  carlo::Counts& counts_;
  int columns_, groups_;  ///< of squares of 4 x 4 pixels across the tile; four groups in each
  SecondVertices seconds_;
  Walk<Needs> walk_;
  // What start_batch() has reached.
  int group_ = 0;
  std::uint32_t sample_ = 0;
  int group_of_keys_ = -1;
  alignas(64) std::array<std::uint32_t, lanes> keys_{};
  // A batch.
  std::vector<Row> rows_;
  FirstVertices firsts_;
  alignas(64) std::array<std::array<float, most_shared + lanes>, most_columns> queue_;
  std::size_t waiting_ = 0, taken_ = 0;
  Radiances rest_{most_shared};
  // What add() has reached.
  std::array<double, 12> sums_{};
  std::array<double, 3> products_{};
  std::vector<std::array<double, 3>> covariances_ = std::vector<std::array<double, 3>>(job_.blocks);
  std::uint32_t samples_in_block_ = 0, block_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SHARING_INL
