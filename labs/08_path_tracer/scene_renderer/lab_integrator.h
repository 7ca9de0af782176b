#pragma once

#include "render/integrator.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>

namespace lab08 {

/// Which of lab 08's tracers makes the image.
enum class Method {
  iterative,  ///< path_radiance(), 8.8
  recursive,  ///< trace_path(), 8.4: worlds of Phong surfaces
  direct      ///< trace_specular(), 8.7
};

struct LabIntegratorOptions {
  Method method = Method::iterative;
  std::uint64_t seed = 1;
  std::uint32_t spp = 64;  ///< planned samples a pixel, for the stratified sampler
};

/// Lab 08 as what common/render drives. A sample's random numbers depend only on seed, pixel,
/// sample and dimension: the iterative tracer reads the scene's sampler, the recursive ones a
/// stream of their own for each sample (the film position is the sampler's with all three). Neither
/// the rays nor the paths that longest_path cuts are counted. Copies the scene. Throws Error for
/// what World refuses, and where a recursive tracer is asked for paths of limited length, which it
/// does not know, or trace_path() for mirrors or glass.
std::unique_ptr<carlo::Integrator> make_lab_integrator(const carlo::Scene& scene,
                                                       const LabIntegratorOptions& options);

}  // namespace lab08
