#include "renderer/flat/flat_kernel.h"

#include "cli/error.h"
#include "random/hash.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/flat/flat_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the two above, which compile it anew.
#include "renderer/flat/paths-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The samples of a tile, handed out to lanes one after the other, pixel by pixel.
class Samples {
 public:
  HWY_ATTR explicit Samples(const FlatJob& job) : job_(job) {
    const carlo::Tile& tile = job.tile;
    for (int row = tile.y0; row < tile.y1; ++row) {
      for (int column = tile.x0; column < tile.x1; ++column) {
        const auto pixel = static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(job.width) +
                           static_cast<std::uint64_t>(column);
        pixels_.push_back({static_cast<float>(column), static_cast<float>(row),
                           static_cast<std::uint32_t>(carlo::hash(job.seed, pixel))});
      }
    }
    sums_.resize(pixels_.size());
    pixel_of_lane_.fill(0);
    if (tile.samples == 0) next_pixel_ = pixels_.size();
  }

  bool left() const { return next_pixel_ < pixels_.size(); }

  /// Gives the lanes whose bits are set in `lanes_free` the next samples; the bits of those that
  /// got one.
  std::uint32_t assign(std::uint32_t lanes_free) {
    std::uint32_t given = 0;
    for (; lanes_free != 0 && left(); lanes_free &= lanes_free - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes_free));
      given |= 1u << lane;
      pixel_of_lane_[lane] = next_pixel_;
      key[lane] = pixels_[next_pixel_].key;
      x[lane] = pixels_[next_pixel_].x;
      y[lane] = pixels_[next_pixel_].y;
      index[lane] = job_.tile.first_sample + next_sample_;
      if (++next_sample_ < job_.tile.samples) continue;
      next_sample_ = 0;
      ++next_pixel_;
    }
    return given;
  }

  /// Adds radiances to the pixels of the lanes whose bits are set, in the order of the lanes.
  void finish(std::uint32_t ended, const float* r, const float* g, const float* b,
              carlo::Counts& counts) {
    for (; ended != 0; ended &= ended - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(ended));
      sums_[pixel_of_lane_[lane]].add({r[lane], g[lane], b[lane]}, counts);
    }
  }

  void means(std::span<std::array<double, 3>> result) const {
    for (std::size_t i = 0; i < sums_.size(); ++i)
      result[i] = sums_[i].mean(job_.tile.samples);
  }

  /// Of the samples that were given out last, by lanes: the pixel and its key, and the index.
  alignas(64) std::array<float, lanes> x{}, y{};
  alignas(64) std::array<std::uint32_t, lanes> key{}, index{};

 private:
  struct Pixel {
    float x, y;
    std::uint32_t key;
  };
  const FlatJob& job_;
  std::vector<Pixel> pixels_;
  std::vector<carlo::BlockSum> sums_;
  std::array<std::size_t, lanes> pixel_of_lane_;
  std::size_t next_pixel_ = 0;
  std::uint32_t next_sample_ = 0;
};

HWY_INLINE std::uint32_t bits(M mask) {
  static_assert(lanes <= 32);
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d_, mask, bytes.data());
  std::uint32_t word;
  std::memcpy(&word, bytes.data(), sizeof word);
  return word;
}

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

/// Lanes without a path take the next samples.
template <class Needs>
HWY_INLINE void start_paths(const FlatJob& job, const Walk<Needs>& walk, Samples& samples,
                            Paths& paths, carlo::Counts& counts) {
  const std::uint32_t all = static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1);
  const std::uint32_t given = samples.assign(all & ~bits(paths.alive));
  if (given == 0) return;
  counts.paths += static_cast<std::uint64_t>(std::popcount(given));
  const std::array<std::uint8_t, 8> bytes{static_cast<std::uint8_t>(given),
                                          static_cast<std::uint8_t>(given >> 8)};
  const M starts = hn::LoadMaskBits(d_, bytes.data());
  const auto starts_u = hn::RebindMask(du_, starts);
  const U keys = hn::Load(du_, samples.key.data()),
          reversed = reverse_bits(hn::Load(du_, samples.index.data()));
  const V2 jitter = walk.points(reversed, keys);
  const V3 d = camera_direction(job, hn::Add(hn::Load(d_, samples.x.data()), jitter.x),
                                hn::Add(hn::Load(d_, samples.y.data()), jitter.y));
  const carlo::Vec3 o = job.camera.origin;
  paths.o = select(starts, set(o.x, o.y, o.z), paths.o);
  paths.d = select(starts, d, paths.d);
  paths.beta = select(starts, set(1, 1, 1), paths.beta);
  paths.L = select(starts, set(0, 0, 0), paths.L);
  paths.pdf = select(starts, set(-1), paths.pdf);
  paths.last = hn::IfThenElse(starts_u, set_word(nothing), paths.last);
  paths.depth = hn::IfThenElse(starts_u, set_word(0), paths.depth);
  paths.key = hn::IfThenElse(starts_u, hn::Add(keys, set_word(pair_step)), paths.key);
  paths.reversed_index = hn::IfThenElse(starts_u, reversed, paths.reversed_index);
  paths.alive = hn::Or(paths.alive, starts);
}

template <class Needs>
HWY_ATTR void run(const FlatJob& job, std::span<std::array<double, 3>> means,
                  carlo::Counts& counts) {
  Samples samples(job);
  const Walk<Needs> walk(job, counts);
  Paths paths{};
  paths.alive = hn::FirstN(d_, 0);
  for (std::uint64_t round = 0;; ++round) {
    if (samples.left()) start_paths(job, walk, samples, paths, counts);
    if (hn::AllFalse(d_, paths.alive)) break;
    if (round % 4096 == 4095 && carlo::render_interrupted()) return;
    const M before = paths.alive;
    walk.extend(paths);
    const M ended = hn::AndNot(paths.alive, before);
    if (hn::AllFalse(d_, ended)) continue;
    alignas(64) std::array<float, lanes> r, g, b;
    hn::Store(paths.L.x, d_, r.data());
    hn::Store(paths.L.y, d_, g.data());
    hn::Store(paths.L.z, d_, b.data());
    samples.finish(bits(ended), r.data(), g.data(), b.data(), counts);
  }
  samples.means(means);
}

HWY_ATTR void render_tile(const FlatJob& job, std::span<std::array<double, 3>> means,
                          carlo::Counts& counts) {
  const bool spheres = job.scene.spheres();
  if (job.scene.phong) {
    spheres ? run<Features<true, true>>(job, means, counts)
            : run<Features<true, false>>(job, means, counts);
  } else {
    spheres ? run<Features<false, true>>(job, means, counts)
            : run<Features<false, false>>(job, means, counts);
  }
}

std::string instruction_set() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {

HWY_EXPORT(render_tile);
HWY_EXPORT(instruction_set);

void render_flat(const FlatJob& job, std::span<std::array<double, 3>> means,
                 carlo::Counts& counts) {
  HWY_DYNAMIC_DISPATCH(render_tile)(job, means, counts);
}

std::string flat_instruction_set() {
  return HWY_DYNAMIC_DISPATCH(instruction_set)();
}

void use_instruction_set(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  std::string known;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
    known += std::string(known.empty() ? "" : ", ") + hwy::TargetName(target);
  }
  hwy::GetChosenTarget().DeInit();
  if (!name.empty() && name != flat_instruction_set()) {
    throw carlo::Error("this machine has no instruction set '{}'; it has {}", name, known);
  }
}

}  // namespace renderer
#endif
