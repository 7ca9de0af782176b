#include "render/light_pass.h"

#include "image/image.h"
#include "numeric/compensated.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carlo {

LightPass::LightPass(const Integrator& integrator, std::size_t pixels, std::uint32_t stream,
                     std::uint32_t first_sample, std::uint32_t samples, double share) {
  const double per_sample = integrator.light_paths() * static_cast<double>(pixels);
  if (per_sample == 0) return;
  const auto first = static_cast<std::uint64_t>(first_sample * per_sample);
  const double whole = samples * per_sample;
  const auto count = static_cast<std::uint64_t>(std::ceil(share * whole));
  share_ = static_cast<double>(count) / whole;
  paths_ = static_cast<double>(count);
  splats_.emplace(pixels, integrator.splat_unit(count));
  constexpr std::uint64_t at_once = 1 << 14;
  std::vector<Counts> parts((count + at_once - 1) / at_once);
  tbb::parallel_for(
      std::size_t{0}, parts.size(),
      [&](std::size_t part) {
        if (render_interrupted()) return;
        const std::uint64_t begin = part * at_once;
        integrator.trace_light_paths(
            {first + begin, std::min(at_once, count - begin), stream, share_}, *splats_,
            parts[part]);
      },
      tbb::simple_partitioner{});
  // In order, because splat_covariance is not a whole number.
  for (const Counts& part : parts)
    counts_ += part;
  const double per_image = share_ * static_cast<double>(pixels);
  counts_.splat_covariance =
      (counts_.splat_covariance - paths_ * products_of_means(pixels)) / (per_image * per_image);
}

double LightPass::products_of_means(std::size_t pixels) const {
  CompensatedSum sum, squares;
  for (std::size_t i = 0; i < pixels; ++i) {
    std::array<double, 3> mean{};
    add_to(mean, i);
    sum.add(luminance(mean));
    squares.add(luminance(mean) * luminance(mean));
  }
  return sum.value() * sum.value() - squares.value();
}

}  // namespace carlo
