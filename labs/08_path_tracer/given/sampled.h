#pragma once

#include "path_tracer.h"
#include "sampling/samplers.h"

namespace lab08 {

/// Adapts one of the samplers of common/sampling to lab 8's Dimensions.
template <class Sampler>
class Sampled final : public Dimensions {
 public:
  explicit Sampled(const carlo::SampleId& id) : sampler_(id) {}
  void seek(unsigned dimension) override { sampler_.seek(dimension); }
  float next_1d() override { return sampler_.next_1d(); }
  Vec2 next_2d() override { return sampler_.next_2d(); }

 private:
  Sampler sampler_;
};

}  // namespace lab08
