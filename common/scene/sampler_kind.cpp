#include "scene/sampler_kind.h"

#include "support/error.h"

#include <fmt/ranges.h>

namespace carlo {

std::string name_of(SamplerKind kind) {
  switch (kind) {
    case SamplerKind::independent:
      return "independent";
    case SamplerKind::stratified:
      return "stratified";
    case SamplerKind::sobol:
      return "sobol";
  }
  throw Error("there is no sampler {}", static_cast<int>(kind));
}

std::vector<std::string> sampler_names() {
  std::vector<std::string> names;
  for (const SamplerKind kind : sampler_kinds)
    names.push_back(name_of(kind));
  return names;
}

SamplerKind sampler_kind(const std::string& name) {
  for (const SamplerKind kind : sampler_kinds) {
    if (name_of(kind) == name) return kind;
  }
  throw Error("there is no sampler '{}', expected {}", name, fmt::join(sampler_names(), ", "));
}

}  // namespace carlo
