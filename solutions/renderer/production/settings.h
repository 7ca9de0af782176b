#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// What the bits of a render depend on: by name, as text. Those of shares have a "version", too.
using RenderSettings = std::map<std::string, std::string>;

/// `planned` is the number of samples that the integrator was made for.
RenderSettings render_settings(const Scene& scene, const std::string& kernel, std::uint64_t seed,
                               std::uint32_t planned, const std::vector<std::string>& definitions);

/// The settings that every state tells.
const std::vector<std::string>& needed_settings();

/// Those among the attributes of a state.
RenderSettings settings_among(const std::map<std::string, std::string>& attributes);

/// The film as render_settings() tells it: "256 x 128".
std::string film_text(int width, int height);

/// What makes two renders different: the most telling setting, and its values.
struct Difference {
  std::string name, a, b;
};

/// Nothing if they are the same render. A kernel, a film or a version that only one of them tells
/// makes no difference, nor does a limit of samples, nor what -D defines: that is in the scene.
std::optional<Difference> difference_of(const RenderSettings& a, const RenderSettings& b);

/// The "version", of the program that runs: 16 hexadecimal digits from the bytes of its file, for
/// what is compiled differently may round differently. Throws Error.
std::string program_version();

}  // namespace carlo
