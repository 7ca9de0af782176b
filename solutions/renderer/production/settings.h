#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// The settings that determine a render's bits, by name, as text. Those of shares also have a
/// "version".
using RenderSettings = std::map<std::string, std::string>;

/// `planned` is the number of samples that the integrator was made for.
RenderSettings render_settings(const Scene& scene, const std::string& kernel, std::uint64_t seed,
                               std::uint32_t planned, const std::vector<std::string>& definitions);

/// The settings that every state must have.
const std::vector<std::string>& needed_settings();

/// Returns the settings among the attributes of a state.
RenderSettings settings_among(const std::map<std::string, std::string>& attributes);

/// The film's size as render_settings() writes it: "256 x 128".
std::string film_text(int width, int height);

/// What distinguishes two renders: the most informative setting and its two values.
struct Difference {
  std::string name, a, b;
};

/// Returns nothing if they are the same render. Ignored are a kernel, a film or a version that only
/// one of them has, the limit of samples, and the definitions of -D, which are part of the scene.
std::optional<Difference> difference_of(const RenderSettings& a, const RenderSettings& b);

/// Returns the "version" of the running program: 16 hexadecimal digits from the bytes of its file,
/// because another build may round differently. Throws Error.
std::string program_version();

}  // namespace carlo
