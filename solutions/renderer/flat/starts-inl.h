// A tile's samples, before they are paths. Included once for each instruction set.

#if defined(CARLO_STARTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_STARTS_INL
#undef CARLO_STARTS_INL
#else
#define CARLO_STARTS_INL
#endif

#include "random/hash.h"
#include "renderer/flat/paths-inl.h"
#include "renderer/flat/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Through the film's point (x, y), in pixels; of length 1. Camera::ray() in lanes.
HWY_INLINE V3 camera_direction(const FlatJob& job, V x, V y) {
  const carlo::Camera& c = job.camera;
  const V fx = hn::MulSub(x, set(2 / static_cast<float>(job.width)), set(1));
  const V fy = hn::NegMulAdd(y, set(2 / static_cast<float>(job.height)), set(1));
  const V3 forward = set(c.forward.x, c.forward.y, c.forward.z);
  return normalize(add_scaled(
      add_scaled(forward, hn::Mul(fx, set(c.tan_half_x)), set(c.right.x, c.right.y, c.right.z)),
      hn::Mul(fy, set(c.tan_half_y)), set(c.up.x, c.up.y, c.up.z)));
}

/// A tile's samples as paths about to start, pixel by pixel. They are made ready for all lanes at
/// once, and taken as lanes become free.
class Starts {
 public:
  HWY_ATTR explicit Starts(const FlatJob& job)
      : columns_(static_cast<std::uint32_t>(job.tile.x1 - job.tile.x0)), job_(job) {
    const auto rows = static_cast<std::uint32_t>(job.tile.y1 - job.tile.y0);
    if (job.tile.samples > 0) pixels_ = columns_ * rows;
  }

  /// Gives paths to lanes that have none, as far as there are.
  HWY_INLINE void refill(Paths& paths, carlo::Counts& counts) {
    const std::uint32_t alive = bits(paths.alive);
    if (alive == static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1)) return;
    if (waiting_ < lanes && pixel_ < pixels_) prepare();
    if (waiting_ == 0) return;
    // The place in the queue: how many lanes before this one are free.
    const U before = hn::Sub(hn::Shl(set_word(1), hn::Iota(du_, 0)), set_word(1));
    const U place = hn::PopulationCount(hn::And(set_word(~alive), before));
    const M starts = hn::AndNot(paths.alive, hn::RebindMask(d_, hn::Gt(set_word(waiting_), place)));
    take(paths, starts, hn::And(place, set_word(lanes - 1)));
    const auto started = static_cast<std::uint32_t>(hn::CountTrue(d_, starts));
    first_ += started;
    waiting_ -= started;
    counts.paths += started;
  }

 private:
  HWY_INLINE void take(Paths& paths, M starts, U place) const {
    const auto from = hn::IndicesFromVec(d_, place);
    const auto starts_u = hn::RebindMask(du_, starts);
    const auto floats = [&](const float* queue) HWY_ATTR {
      return hn::TableLookupLanes(hn::LoadU(d_, queue + first_), from);
    };
    const auto words = [&](const std::uint32_t* queue) HWY_ATTR {
      return hn::BitCast(du_, floats(reinterpret_cast<const float*>(queue)));
    };
    const carlo::Vec3 o = job_.camera.origin;
    paths.from.o = select(starts, set(o.x, o.y, o.z), paths.from.o);
    if (job_.scene.touching || job_.scene.first_sphere < job_.scene.surfaces)
      paths.from.came = select(starts, set(0, 0, 0), paths.from.came);
    paths.d = select(starts, {floats(dx_.data()), floats(dy_.data()), floats(dz_.data())}, paths.d);
    paths.beta = select(starts, set(1, 1, 1), paths.beta);
    paths.L = select(starts, set(0, 0, 0), paths.L);
    paths.pdf = select(starts, set(-1), paths.pdf);
    paths.from.last = hn::IfThenElse(starts_u, set_word(nothing), paths.from.last);
    paths.from.plane = hn::IfThenElse(starts_u, set_word(nothing), paths.from.plane);
    paths.depth = hn::IfThenElse(starts_u, set_word(0), paths.depth);
    paths.key = hn::IfThenElse(starts_u, words(key_.data()), paths.key);
    paths.reversed_index = hn::IfThenElse(starts_u, words(index_.data()), paths.reversed_index);
    paths.pixel = hn::IfThenElse(starts_u, words(pixel_of_.data()), paths.pixel);
    paths.alive = hn::Or(paths.alive, starts);
  }

  /// The queue's rest moves to its front, and a register of samples joins it. Behind the tile's
  /// last sample the register holds nothing that counts as waiting.
  HWY_INLINE void prepare() {
    move(dx_, d_), move(dy_, d_), move(dz_, d_);
    move(key_, du_), move(index_, du_), move(pixel_of_, du_);
    first_ = 0;
    alignas(64) std::array<std::int32_t, lanes> x{}, y{};
    alignas(64) std::array<std::uint32_t, lanes> key{}, index{};
    std::uint32_t made = 0;
    for (; made < lanes && pixel_ < pixels_; ++made) {
      if (sample_ == 0) start_pixel();
      x[made] = x_, y[made] = y_, key[made] = pixel_key_;
      index[made] = job_.tile.first_sample + sample_;
      pixel_of_[waiting_ + made] = pixel_;
      if (++sample_ < job_.tile.samples) continue;
      sample_ = 0;
      ++pixel_;
    }
    const U keys = hn::Load(du_, key.data());
    const U reversed = reverse_bits(hn::Load(du_, index.data()));
    const V2 jitter = points(job_, reversed, mix(keys));
    const V3 d =
        camera_direction(job_, hn::Add(hn::ConvertTo(d_, hn::Load(di_, x.data())), jitter.x),
                         hn::Add(hn::ConvertTo(d_, hn::Load(di_, y.data())), jitter.y));
    hn::StoreU(d.x, d_, dx_.data() + waiting_);
    hn::StoreU(d.y, d_, dy_.data() + waiting_);
    hn::StoreU(d.z, d_, dz_.data() + waiting_);
    hn::StoreU(hn::Add(keys, set_word(key_step)), du_, key_.data() + waiting_);
    hn::StoreU(reversed, du_, index_.data() + waiting_);
    waiting_ += made;
  }

  void start_pixel() {
    x_ = job_.tile.x0 + static_cast<int>(pixel_ % columns_);
    y_ = job_.tile.y0 + static_cast<int>(pixel_ / columns_);
    const std::uint64_t number =
        static_cast<std::uint64_t>(y_) * static_cast<std::uint64_t>(job_.width) +
        static_cast<std::uint64_t>(x_);
    pixel_key_ = static_cast<std::uint32_t>(carlo::hash(job_.seed, number));
  }

  template <class Queue, class Tag>
  HWY_INLINE void move(Queue& queue, Tag tag) const {
    hn::StoreU(hn::LoadU(tag, queue.data() + first_), tag, queue.data());
  }

  /// The queue: `waiting_` from `first_` on. Lookups read a register from anywhere in it.
  template <class T>
  using Queue = std::array<T, 3 * lanes>;
  static constexpr std::size_t alignment = lanes * sizeof(float);
  alignas(alignment) Queue<float> dx_{}, dy_{}, dz_{};
  alignas(alignment) Queue<std::uint32_t> key_{}, index_{}, pixel_of_{};
  std::uint32_t first_ = 0, waiting_ = 0;
  std::uint32_t columns_, pixels_ = 0;
  std::uint32_t pixel_ = 0, sample_ = 0;  ///< the next
  int x_ = 0, y_ = 0;
  std::uint32_t pixel_key_ = 0;
  const FlatJob& job_;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_STARTS_INL
