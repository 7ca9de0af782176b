#pragma once

#include "render/integrator.h"
#include "scene/sampler_kind.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace bench {

/// The ways to render that the benchmark compares.
enum class Method { recursive, iterative, scalar, best };

std::string name(Method method);

/// A method with a sampler.
struct Way {
  Method method;
  carlo::SamplerKind sampler;
  std::string label() const { return name(method) + ", " + carlo::name_of(sampler); }
};

/// Throws Error where the method cannot render the scene. `scene` must outlive the integrator; its
/// sampler is ignored for the way's.
std::unique_ptr<carlo::Integrator> make_integrator(Method method, const carlo::Scene& scene,
                                                   std::uint64_t seed, std::uint32_t spp);

/// The ways that can render the scene and differ: no "best" where that is the scalar one. The
/// recursive tracer draws its own numbers, so it comes only once.
std::vector<Way> ways_for(const carlo::Scene& scene);

}  // namespace bench
