#pragma once

#include "given/sampled.h"
#include "images/images.h"

namespace lab08 {

/// A world and its image in steps f to h.
struct View {
  explicit View(carlo::Scene scene, int size);
  Ray ray(int x, int y) const { return middle_ray(world.scene().camera, size, size, x, y); }

  World world;
  int size;
};

/// The Cornell box of common/scenes, size x size pixels.
carlo::Scene cornell_box();
/// A room with a ball of mirror and a ball of glass under a square light.
carlo::Scene room_with_balls();
/// Four plates, each more polished than the last, that mirror four balls of light of decreasing
/// size.
carlo::Scene plates();

using Trace = std::function<Rgb(const Ray& ray, Rng& rng)>;

/// Pixels by independent calls of a tracer.
SampledPixel traced(const View& view, const Trace& trace);

/// Pixels by path_radiance() with the points of a sampler; each call has its own seed.
template <class Sampler>
SampledPixel tracer(const View& view) {
  return [&view](int x, int y, int samples, Rng& rng) {
    carlo::SampleId id{rng.next_u64(), static_cast<std::uint32_t>(y * view.size + x), 0,
                       static_cast<std::uint32_t>(samples)};
    return mean_of(samples, [&] {
      Sampled<Sampler> dimensions(id);
      ++id.index;
      return path_radiance(view.world, view.ray(x, y), 0, dimensions);
    });
  };
}

}  // namespace lab08
