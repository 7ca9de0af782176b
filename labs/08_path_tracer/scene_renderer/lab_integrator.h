#pragma once

#include "render/integrator.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>

namespace lab08 {

/// The one of lab 8's tracers that makes the image.
enum class Method {
  iterative,  ///< path_radiance(), 8.8
  recursive,  ///< trace_path(), 8.4: worlds of Phong surfaces
  direct      ///< trace_specular(), 8.7
};

struct LabIntegratorOptions {
  Method method = Method::iterative;
  std::uint64_t seed = 1;
  std::uint32_t spp = 64;  ///< planned samples per pixel, for the stratified sampler
};

/// Lab 08's tracers as an Integrator for common/render. A sample's random numbers depend only on
/// seed, pixel, sample and dimension: the iterative tracer reads the scene's sampler, the recursive
/// ones a separate stream for each sample (the film position comes from the sampler with all
/// three). Counts neither rays nor paths cut by longest_path. Copies the scene. Throws Error for
/// what World refuses, and if a recursive tracer is given a limited path length, which it does not
/// support, or trace_path() mirrors or glass.
std::unique_ptr<carlo::Integrator> make_lab_integrator(const carlo::Scene& scene,
                                                       const LabIntegratorOptions& options);

}  // namespace lab08
