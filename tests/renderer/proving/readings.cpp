#include "proving/readings.h"

#include "course/render/report.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/needs.h"
#include "scene_renderer/lab_integrator.h"
#include "scene_tools.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

namespace proving {
namespace {

using carlo::Integrator, carlo::Scene;

constexpr double sigmas = 5, most_error = .02, darkness = 1e-6;

/// Null if the kernel does not support the scene.
std::unique_ptr<Integrator> make_kernel(const Scene& scene, std::size_t kernel, std::uint64_t seed,
                                        std::uint32_t spp) {
  if (kernel == 3) {
    try {
      return lab08::make_lab_integrator(scene, {lab08::Method::iterative, seed, spp});
    } catch (const carlo::Error&) {
      return nullptr;
    }
  }
  const bool lanes = kernel == 1 || kernel == 2;
  if (lanes && !renderer::LaneScene::suits(needs(scene), scene)) return nullptr;
  if (kernel == 2 && !renderer::LaneScene(scene).can_share()) return nullptr;
  return renderer::make_path_integrator(
      scene, {.seed = seed,
              .spp = spp,
              .kernel = kernel == 0 ? renderer::Kernel::scalar : renderer::Kernel::best,
              .choices = {.share = kernel == 2}});
}

Reading read_kernel(const Integrator& integrator, const Scene& scene, std::uint32_t spp) {
  const carlo::RenderResult result =
      render(integrator, scene.width, scene.height, {.spp = spp, .threads = 1, .progress = false});
  const carlo::MeanRadiance mean = mean_of(result);
  return {mean.value, mean.standard_error, result.counts.bad, result.counts.cut, result.seconds};
}

std::string channels(const std::array<double, 3>& x) {
  return x[0] == x[1] && x[1] == x[2] ? fmt::format("{:.8g}", x[0])
                                      : fmt::format("({:.8g}, {:.8g}, {:.8g})", x[0], x[1], x[2]);
}

std::string describe_reading(std::size_t kernel, const Reading& r) {
  return fmt::format("{} {} +- {}", kernel_names[kernel], channels(r.mean), channels(r.error));
}

/// Why a channel is wrong, or empty.
std::string wrong(const Proof& proof, const Reading& r, std::size_t c) {
  const double exact = proof.exact[c], difference = std::abs(r.mean[c] - exact);
  if (exact == 0) {
    const double samples = static_cast<double>(proof.scene.width * proof.scene.height) * proof.spp;
    const double allowed = darkness + proof.rounding + sigmas * std::sqrt(proof.rounding / samples);
    return r.mean[c] <= allowed ? "" : "not dark";
  }
  const double allowed = sigmas * r.error[c] + proof.rounding * exact;
  // Not "difference > allowed": NaN is wrong.
  if (!(difference <= allowed))
    return fmt::format("off by {:.3g} %, {:.1f} se", 100 * (r.mean[c] - exact) / exact,
                       difference / r.error[c]);
  return r.error[c] <= most_error * exact ? "" : "too noisy to tell";
}

}  // namespace

Readings read_film(const Scene& scene, std::uint32_t spp, std::uint64_t seed, Lab lab) {
  Readings readings;
  const std::size_t kernels = readings.size() - (lab == Lab::asked ? 0 : 1);
  for (std::size_t kernel = 0; kernel < kernels; ++kernel) {
    const auto integrator =
        make_kernel(scene, kernel, kernel_names.size() * seed + kernel + 1, spp);
    if (integrator) readings[kernel] = read_kernel(*integrator, scene, spp);
  }
  return readings;
}

void judge_exact(const Proof& proof, const Readings& readings, std::vector<Finding>& findings) {
  for (std::size_t kernel = 0; kernel < readings.size(); ++kernel) {
    if (!readings[kernel]) continue;
    const Reading& r = *readings[kernel];
    std::string why;
    for (std::size_t c = 0; c < 3 && why.empty(); ++c)
      why = wrong(proof, r, c);
    if (r.bad > 0) why += fmt::format(", {} bad samples", r.bad);
    if (!why.empty())
      findings.push_back(
          {proof.name,
           fmt::format("{}, exact {}: {}", describe_reading(kernel, r), channels(proof.exact), why),
           &proof.scene});
  }
}

void judge_agreement(const std::string& name, const Scene& scene, double rounding,
                     const Readings& readings, std::vector<Finding>& findings) {
  for (std::size_t a = 0; a < readings.size(); ++a) {
    for (std::size_t b = a + 1; b < readings.size(); ++b) {
      if (!readings[a] || !readings[b]) continue;
      const Reading &x = *readings[a], &y = *readings[b];
      for (std::size_t c = 0; c < 3; ++c) {
        const double allowed = sigmas * std::hypot(x.error[c], y.error[c]) +
                               rounding * std::max(x.mean[c], y.mean[c]) + darkness * 1e-3;
        if (std::abs(x.mean[c] - y.mean[c]) <= allowed) continue;
        findings.push_back(
            {name,
             fmt::format("{}; {}: they differ", describe_reading(a, x), describe_reading(b, y)),
             &scene});
        break;
      }
    }
  }
}

}  // namespace proving
