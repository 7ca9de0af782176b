// Camera rays: a tile's samples before they become paths. Included once for each instruction set.

#if defined(CARLO_STARTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_STARTS_INL
#undef CARLO_STARTS_INL
#else
#define CARLO_STARTS_INL
#endif

#include "random/hash.h"
#include "renderer/lanes/paths-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The unit direction through the film's point (x, y), in pixels: Camera::ray() in lanes.
HWY_INLINE V3 camera_direction(const LaneJob& job, V x, V y) {
  const carlo::Camera& c = job.camera;
  const V fx = mul_sub(x, set(2 / static_cast<float>(job.width)), set(1));
  const V fy = neg_mul_add(y, set(2 / static_cast<float>(job.height)), set(1));
  const V3 forward = set(c.forward.x, c.forward.y, c.forward.z);
  return normalize(add_scaled(
      add_scaled(forward, hn::Mul(fx, set(c.tan_half_x)), set(c.right.x, c.right.y, c.right.z)),
      hn::Mul(fy, set(c.tan_half_y)), set(c.up.x, c.up.y, c.up.z)));
}

/// For a camera ray in direction d: the density per solid angle of its pixel's samples over that of
/// light paths over the whole image, as a ratio of their numbers.
HWY_INLINE V camera_density(const LaneJob& job, V3 d) {
  const carlo::Camera& c = job.camera;
  const V cosine = dot(d, set(c.forward.x, c.forward.y, c.forward.z));
  const float per_film = 1 / (4 * c.tan_half_x * c.tan_half_y * job.choices.light_paths);
  return hn::Div(set(per_film), hn::Mul(cosine, hn::Mul(cosine, cosine)));
}

/// The random word of a pixel. Words of 32 bits, so of n pixels about n^2 / 2^33 pairs share all
/// their random numbers (of 384 x 384, two or three): their errors are alike, while each pixel's
/// error bar still holds.
inline std::uint32_t key_of_pixel(const LaneJob& job, int x, int y) {
  const std::uint64_t number =
      static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(job.width) +
      static_cast<std::uint64_t>(x);
  return static_cast<std::uint32_t>(carlo::hash(job.seed, number));
}

/// A register of camera rays; of the last ones of a tile, only the first `count` lanes.
struct CameraRays {
  V3 d;
  U key;  ///< of their pixels
  U reversed_index;
  std::uint32_t count;
};

/// A queue of a tile's samples, pixel by pixel, that start as lanes become free. They are prepared
/// a register at a time.
class Starts {
 public:
  HWY_ATTR explicit Starts(const LaneJob& job)
      : left_(
            std::uint64_t{job.samples()} *
            static_cast<std::uint64_t>((job.tile.x1 - job.tile.x0) * (job.tile.y1 - job.tile.y0))),
        x_(job.tile.x0),
        y_(job.tile.y0),
        job_(job) {
    pixel_key_ = key_of_pixel(job_, x_, y_);
  }

  /// Goes on with the first sample of a pixel.
  void go_to(int x, int y) {
    x_ = x, y_ = y, sample_ = 0;
    pixel_key_ = key_of_pixel(job_, x_, y_);
  }

  /// Lets up to `most` more samples start, once all earlier ones have started; returns how many.
  std::uint32_t allow(std::uint32_t most) {
    allowed_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, left_));
    left_ -= allowed_;
    number_ = 0;
    return allowed_;
  }

  /// The rays of the next samples that may start, at least one.
  HWY_INLINE CameraRays next_register() {
    const auto made = static_cast<std::uint32_t>(std::min<std::uint32_t>(lanes, allowed_));
    const std::uint32_t samples = job_.samples();
    if (sample_ == samples) next_pixel();
    const U lane = hn::Iota(du_, 0);
    V x = set(static_cast<float>(x_)), y = set(static_cast<float>(y_));
    U keys = set_word(pixel_key_), sample = hn::Add(lane, set_word(sample_));
    std::uint32_t first = 0;  // first lane of the pixel
    while (made - first > samples - sample_) {
      first += samples - sample_;
      next_pixel();
      const auto next = hn::Gt(hn::Add(lane, set_word(1)), set_word(first));
      const M next_f = hn::RebindMask(d_, next);
      x = select(next_f, set(static_cast<float>(x_)), x);
      y = select(next_f, set(static_cast<float>(y_)), y);
      keys = hn::IfThenElse(next, set_word(pixel_key_), keys);
      sample = hn::IfThenElse(next, hn::Sub(lane, set_word(first)), sample);
    }
    sample_ += made - first;
    const U reversed = reverse_bits(hn::Add(sample, set_word(job_.tile.first_sample)));
    const V2 jitter = points(job_, reversed, mix(keys));
    const V3 d = camera_direction(job_, hn::Add(x, jitter.x), hn::Add(y, jitter.y));
    allowed_ -= made;
    return {d, keys, reversed, made};
  }

  /// Starts queued samples in free lanes.
  template <class Needs>
  HWY_INLINE void refill(Paths& paths, carlo::Counts& counts) {
    const std::uint32_t alive = bits(paths.alive);
    if (alive == static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1)) return;
    if (waiting_ < lanes && allowed_ > 0) prepare();
    if (waiting_ == 0) return;
    // The position in the queue: the number of free lanes before this one.
    const U position = ranks(~alive);
    const M starts =
        hn::AndNot(paths.alive, hn::RebindMask(d_, hn::Gt(set_word(waiting_), position)));
    start<Needs>(paths, starts, hn::And(position, set_word(lanes - 1)));
    const auto started = static_cast<std::uint32_t>(hn::CountTrue(d_, starts));
    first_ += started;
    waiting_ -= started;
    counts.paths += started;
  }

 private:
  template <class Needs>
  HWY_INLINE void start(Paths& paths, M starts, U position) const {
    const auto from = hn::IndicesFromVec(d_, position);
    const auto starts_u = hn::RebindMask(du_, starts);
    const auto floats = [&](const float* queue) HWY_ATTR {
      return hn::TableLookupLanes(hn::LoadU(d_, queue + first_), from);
    };
    const auto words = [&](const std::uint32_t* queue) HWY_ATTR {
      return hn::BitCast(du_, floats(reinterpret_cast<const float*>(queue)));
    };
    const carlo::Vec3 o = job_.camera.origin;
    paths.from.o = select(starts, set(o.x, o.y, o.z), paths.from.o);
    if constexpr (Needs::close) {
      paths.from.arrival = select(starts, set(0, 0, 0), paths.from.arrival);
      paths.from.plane = hn::IfThenElse(starts_u, set_word(nothing), paths.from.plane);
    }
    if constexpr (Needs::full) {
      paths.from.through = hn::AndNot(starts, paths.from.through);
      paths.roulette_scale = select(starts, set(1), paths.roulette_scale);
      paths.from.clear = select(starts, set(o.x, o.y, o.z), paths.from.clear);
    }
    paths.d = select(starts, {floats(dx_.data()), floats(dy_.data()), floats(dz_.data())}, paths.d);
    if constexpr (Needs::light_paths)
      paths.mis_ratio =
          select(starts, hn::Div(set(1), camera_density(job_, paths.d)), paths.mis_ratio);
    paths.beta = select(starts, set(1, 1, 1), paths.beta);
    paths.L = select(starts, set(0, 0, 0), paths.L);
    if (job_.guide != nullptr) paths.guided = select(starts, set(1), paths.guided);
    paths.pdf = select(starts, set(-1), paths.pdf);
    paths.from.last = hn::IfThenElse(starts_u, set_word(nothing), paths.from.last);
    paths.depth = hn::IfThenElse(starts_u, set_word(0), paths.depth);
    paths.key = hn::IfThenElse(starts_u, words(key_.data()), paths.key);
    paths.reversed_index = hn::IfThenElse(starts_u, words(index_.data()), paths.reversed_index);
    paths.number = hn::IfThenElse(starts_u, words(number_of_.data()), paths.number);
    paths.alive = hn::Or(paths.alive, starts);
  }

  /// Moves the rest of the queue to its front and appends registers of samples. Appends several at
  /// a time, since branch prediction cannot foresee when more are needed.
  /// Not inlined: the loop over paths needs the registers.
  HWY_NOINLINE void prepare() {
    move(dx_, d_), move(dy_, d_), move(dz_, d_);
    move(key_, du_), move(index_, du_), move(number_of_, du_);
    first_ = 0;
    for (std::size_t i = 0; i < at_a_time && allowed_ > 0; ++i)
      append_register();
  }

  HWY_INLINE void append_register() {
    const CameraRays rays = next_register();
    hn::StoreU(rays.d.x, d_, dx_.data() + waiting_);
    hn::StoreU(rays.d.y, d_, dy_.data() + waiting_);
    hn::StoreU(rays.d.z, d_, dz_.data() + waiting_);
    hn::StoreU(hn::Add(rays.key, set_word(key_step)), du_, key_.data() + waiting_);
    hn::StoreU(rays.reversed_index, du_, index_.data() + waiting_);
    hn::StoreU(hn::Add(hn::Iota(du_, 0), set_word(number_)), du_, number_of_.data() + waiting_);
    waiting_ += rays.count;
    number_ += rays.count;
  }

  void next_pixel() {
    if (x_ + 1 < job_.tile.x1)
      go_to(x_ + 1, y_);
    else
      go_to(job_.tile.x0, y_ + 1);
  }

  template <class Queue, class Tag>
  HWY_INLINE void move(Queue& queue, Tag tag) const {
    hn::StoreU(hn::LoadU(tag, queue.data() + first_), tag, queue.data());
  }

  static constexpr std::size_t at_a_time = 4;
  /// The queue: `waiting_` samples from `first_` on. Lookups read a register from any position in
  /// it.
  template <class T>
  using Queue = std::array<T, (at_a_time + 2) * lanes>;
  static constexpr std::size_t alignment = lanes * sizeof(float);
  alignas(alignment) Queue<float> dx_{}, dy_{}, dz_{};
  alignas(alignment) Queue<std::uint32_t> key_{}, index_{}, number_of_{};
  std::uint32_t first_ = 0, waiting_ = 0;
  std::uint64_t left_;         ///< samples that may not start yet
  std::uint32_t allowed_ = 0;  ///< samples that may start but are not in the queue yet
  std::uint32_t number_ = 0;   ///< of the next one to enter the queue, among all that may start
  std::uint32_t sample_ = 0;   ///< the next one of its pixel
  int x_, y_;
  std::uint32_t pixel_key_ = 0;
  const LaneJob& job_;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_STARTS_INL
