#include "renderer/production/settings.h"

#include "course/cli/program.h"
#include "renderer/production/definitions.h"
#include "renderer/production/digest.h"
#include "scene/fingerprint.h"
#include "scene/sampler_kind.h"
#include "support/error.h"

#include <fmt/core.h>

#include <array>
#include <fstream>

namespace carlo {
namespace {

struct Compared {
  const char* name;
  bool told_by_all;
};

/// The most informative first: settings that the scene's digest depends on come before it, and
/// those that depend on the scene after it.
constexpr std::array<Compared, 9> compared = {{{"seed", true},
                                               {"sampler", true},
                                               {"max_depth", true},
                                               {"target_error", true},
                                               {"planned_spp", true},
                                               {"film", false},
                                               {"scene_digest", true},
                                               {"kernel", false},
                                               {"version", false}}};

}  // namespace

RenderSettings render_settings(const Scene& scene, const std::string& kernel, std::uint64_t seed,
                               std::uint32_t planned, const std::vector<std::string>& definitions) {
  return {{"scene_digest", fingerprint(scene)},
          {"film", film_text(scene.width, scene.height)},
          {"seed", std::to_string(seed)},
          {"sampler", name_of(scene.sampler)},
          {"max_depth", std::to_string(scene.max_depth)},
          {"planned_spp", std::to_string(planned)},
          {"kernel", kernel},
          {"definitions", definitions_text(definitions)}};
}

const std::vector<std::string>& needed_settings() {
  static const std::vector<std::string> names = {
      "seed", "sampler", "max_depth", "planned_spp", "scene_digest", "kernel", "definitions"};
  return names;
}

RenderSettings settings_among(const std::map<std::string, std::string>& attributes) {
  RenderSettings settings;
  const auto take = [&](const std::string& name) {
    const auto at = attributes.find(name);
    if (at != attributes.end()) settings.insert(*at);
  };
  for (const auto& setting : compared)
    take(setting.name);
  take("definitions");
  return settings;
}

std::string film_text(int width, int height) {
  return fmt::format("{} x {}", width, height);
}

std::optional<Difference> difference_of(const RenderSettings& a, const RenderSettings& b) {
  const auto value = [](const RenderSettings& settings, const char* name) {
    const auto at = settings.find(name);
    return at == settings.end() ? std::string() : at->second;
  };
  for (const auto& [setting, told_by_all] : compared) {
    const std::string one = value(a, setting), other = value(b, setting);
    if (one == other || (!told_by_all && (one.empty() || other.empty()))) continue;
    const std::string name = setting;
    return Difference{name == "scene_digest" ? "scene" : name, one, other};
  }
  return std::nullopt;
}

std::string program_version() {
  const std::string path = own_path();
  std::ifstream in(path, std::ios::binary);
  Digest digest;
  std::string bytes(1 << 20, '\0');
  while (in) {
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    digest.add(std::string_view(bytes).substr(0, static_cast<std::size_t>(in.gcount())));
  }
  if (!in.eof()) throw Error("cannot read {}, the program itself, to tell its version", path);
  return digest.text();
}

}  // namespace carlo
