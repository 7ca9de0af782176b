#pragma once

#include "scene/scene.h"

#include <array>
#include <string>
#include <vector>

namespace carlo {

/// All supported kinds; others are refused by name.
inline constexpr std::array sampler_kinds = {SamplerKind::independent, SamplerKind::stratified,
                                             SamplerKind::sobol};

/// "independent", "stratified" or "sobol", as in scene files, on the command line and in reports.
std::string name_of(SamplerKind kind);

/// All names.
std::vector<std::string> sampler_names();

/// The kind of this name. Throws Error if there is none.
SamplerKind sampler_kind(const std::string& name);

}  // namespace carlo
