#include "beside.h"

#include "image/metrics.h"
#include "render/scene_film.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"
#include "support/error.h"
#include "support/quotes.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace bench {
namespace {

using carlo::Image;
using carlo::Scene;

Rung render_ours(const Compared& c, std::uint64_t seed, std::uint32_t samples, Image& image) {
  const auto integrator =
      renderer::make_path_integrator(c.scene, {.seed = seed,
                                               .spp = samples,
                                               .technique = renderer::Technique::automatic,
                                               .guidance = renderer::Guidance::automatic,
                                               .share = true});
  const Rendered rendered = render_timed(*integrator, c.scene, samples);
  image = rendered.film.mean();
  return {static_cast<double>(samples), rendered.seconds + integrator->seconds_spent(),
          carlo::compare(image, c.reference.image).rel_mse - c.noise};
}

/// Halves or doubles the samples until the error lies between two measurements.
Rung ours_at(const Compared& c, std::uint64_t seed, std::uint32_t samples, double rel_mse,
             Image& image) {
  constexpr std::uint32_t most = 1u << 16;
  Rung rung = render_ours(c, seed, samples, image);
  const bool fewer = rung.rel_mse < rel_mse;
  while (true) {
    if (fewer ? samples == 1 : samples >= most) return at_error(rung, rung, rel_mse);
    samples = fewer ? samples / 2 : 2 * samples;
    const Rung next = render_ours(c, seed, samples, image);
    if (fewer && next.rel_mse >= rel_mse) return at_error(next, rung, rel_mse);
    if (!fewer && next.rel_mse <= rel_mse) return at_error(rung, next, rel_mse);
    rung = next;
  }
}

/// The scenes that were asked for among those with a reference image, all by default. Throws Error
/// if there is none of a name.
std::set<std::string> wanted_scenes(const Options& options) {
  std::set<std::string> names = reference_scenes(options);
  if (options.peer_scenes.empty()) return names;
  for (const std::string& name : options.peer_scenes) {
    if (names.count(name) == 0) {
      throw carlo::Error("--scene: {} has no reference image; those that have one: {}",
                         carlo::in_quotes(name), fmt::join(names, ", "));
    }
  }
  return {options.peer_scenes.begin(), options.peer_scenes.end()};
}

}  // namespace

Choice choose(const Options& options, Peer peer) {
  Choice choice;
  for (const std::string& name : wanted_scenes(options)) {
    Scene scene = carlo::load_scene(options.scenes / (name + ".xml"));
    if (const auto reason = obstacle(scene, peer)) {
      choice.left_out.push_back(fmt::format("{} ({})", name, *reason));
      continue;
    }
    carlo::ExrFile reference = carlo::read_exr(options.references / (name + ".exr"));
    if (!reference.standard_error) continue;
    carlo::resize(scene, reference.image.width, reference.image.height);
    scene.sampler = carlo::SamplerKind::sobol;
    const double noise = rel_mse_noise(reference.image, *reference.standard_error);
    choice.scenes.push_back({name, std::move(scene), std::move(reference), noise});
  }
  if (choice.scenes.empty() && options.peer_scenes.empty()) {
    throw carlo::Error("no scene with a reference image in {} is one that the peer can render",
                       options.references.string());
  }
  return choice;
}

Runs measure(Context& context, const Contender& contender, const Compared& c, std::uint32_t samples,
             int count, double from, double to) {
  Runs runs;
  (void)render_ours(c, 1, samples, runs.ours);  // the first render also pays for one-time work
  nlohmann::json spec = peer_scene(c.scene, contender.peer);
  spec.update(contender.choices);
  for (int i = 0; i < count; ++i) {
    const double done = from + (to - from) * i / count;
    const std::uint64_t seed = context.options().seed + static_cast<std::uint64_t>(i);
    spec["samples"] = samples;
    spec["seed"] = seed;
    PeerImage theirs = render_by(contender.program, spec, [&] { context.progress(done); });
    const double rel_mse = carlo::compare(theirs.image, c.reference.image).rel_mse - c.noise;
    if (!(rel_mse > 0)) {
      throw carlo::Error("the image of {} is nearer to the reference than its noise", c.name);
    }
    const Rung ours = ours_at(c, seed, samples, rel_mse, runs.ours);
    runs.seconds.push_back(theirs.seconds);
    runs.rel_mse.push_back(rel_mse);
    runs.our_samples.push_back(ours.samples);
    runs.our_seconds.push_back(ours.seconds);
    runs.ratio.push_back(theirs.seconds / ours.seconds);
    runs.theirs.push_back(std::move(theirs.image));
    runs.version = theirs.version;
  }
  return runs;
}

std::vector<carlo::Cell> beside_row(const std::string& scene, const Runs& runs,
                                    const Agreement& agreement) {
  const Spread rel_mse = spread(runs.rel_mse), samples = spread(runs.our_samples);
  return {scene,
          seconds_spread_cell(spread(runs.seconds)),
          carlo::number_cell(rel_mse.median),
          carlo::number_cell(samples.median),
          seconds_spread_cell(spread(runs.our_seconds)),
          spread_cell(spread(runs.ratio)),
          {fmt::format("{:.4f}", agreement.mean_ratio), agreement.mean_ratio},
          {fmt::format("{:.1f}", agreement.tile_z), agreement.tile_z},
          {fmt::format("{:.1f}", agreement.mean_z), agreement.mean_z}};
}

carlo::Viewer beside_viewer(const std::string& peer, const Compared& c, const Runs& runs) {
  return {fmt::format("{} by {} and by us, one run of each", c.name, peer),
          "Ours has about as many samples as the other's error takes.",
          {{peer, runs.theirs.back()}, {"ours", runs.ours}},
          carlo::ViewerImage{"reference image", c.reference.image, c.reference.standard_error}};
}

}  // namespace bench
