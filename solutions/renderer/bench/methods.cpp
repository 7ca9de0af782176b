#include "methods.h"

#include "renderer/path_integrator.h"
#include "scene/sampler_kind.h"
#include "scene_renderer/lab_integrator.h"
#include "support/error.h"

namespace bench {

using carlo::SamplerKind;
using carlo::Scene;

std::string name(Method method) {
  switch (method) {
    case Method::recursive:
      return "recursive (lab 8.4)";
    case Method::iterative:
      return "iterative (lab 8.8)";
    case Method::scalar:
      return "reference, scalar";
    case Method::best:
      return "reference, vector";
  }
  return "";
}

std::unique_ptr<carlo::Integrator> make_integrator(Method method, const Scene& scene,
                                                   std::uint64_t seed, std::uint32_t spp) {
  const auto lab = [&](lab08::Method of_lab) {
    return lab08::make_lab_integrator(scene, {.method = of_lab, .seed = seed, .spp = spp});
  };
  const auto reference = [&](renderer::Kernel kernel) {
    return renderer::make_path_integrator(scene, {.seed = seed, .spp = spp, .kernel = kernel});
  };
  switch (method) {
    case Method::recursive:
      return lab(lab08::Method::recursive);
    case Method::iterative:
      return lab(lab08::Method::iterative);
    case Method::scalar:
      return reference(renderer::Kernel::scalar);
    case Method::best:
      return reference(renderer::Kernel::best);
  }
  throw carlo::Error("there is no method {}", static_cast<int>(method));
}

std::vector<Way> ways_for(const Scene& given) {
  std::vector<Way> ways;
  Scene scene = given;
  for (const SamplerKind sampler : carlo::sampler_kinds) {
    scene.sampler = sampler;
    for (const Method method :
         {Method::recursive, Method::iterative, Method::scalar, Method::best}) {
      if (method == Method::recursive && sampler != SamplerKind::independent) continue;
      try {
        const auto integrator = make_integrator(method, scene, 1, 64);
        if (method == Method::best &&
            integrator->name() == make_integrator(Method::scalar, scene, 1, 64)->name()) {
          continue;
        }
        ways.push_back({method, sampler});
      } catch (const carlo::Error&) {
        continue;  // scenes that the method cannot render get no row
      }
    }
  }
  return ways;
}

}  // namespace bench
