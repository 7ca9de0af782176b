#include "renderer/production/resumed_render.h"

#include "support/error.h"

#include <fmt/core.h>

#include <filesystem>

namespace carlo {

namespace fs = std::filesystem;

/// Throws unless both or neither have a target error.
static void fill_from_target(ProductionArguments& a, const EarlierRender& earlier) {
  const std::optional<double> target = earlier.target_error();
  if (!target) {
    if (a.target_error)
      throw Error("{} has no target error: continue it with --spp or --seconds", a.resume);
    if (!a.spp && !a.seconds)
      throw Error("--resume continues up to --spp N or for --seconds S: which?");
    return;
  }
  if (a.target_error.value_or(*target) != *target) {
    throw Error("cannot resume {}: its target error is {}, this render's {}", a.resume, *target,
                *a.target_error);
  }
  a.target_error = target;
  if (!a.spp) a.spp = static_cast<std::uint32_t>(earlier.number("spp_limit"));
}

void fill_from(ProductionArguments& a, const EarlierRender& earlier) {
  fill_from_target(a, earlier);
  if (a.scene.empty()) a.scene = earlier.setting("scene");
  if (a.definitions.empty()) a.definitions = earlier.definitions();
  if (a.size.empty()) a.size = fmt::format("{}x{}", earlier.width(), earlier.height());
  if (a.sampler.empty()) a.sampler = earlier.setting("sampler");
  if (!a.max_depth) a.max_depth = static_cast<int>(earlier.number("max_depth"));
  if (!a.seed) a.seed = earlier.number("seed");
  if (a.output.empty()) a.output = fs::path(a.resume).replace_extension().string() + ".exr";
}

RenderResult uniform_start(const EarlierRender& earlier, std::optional<std::uint32_t> spp) {
  RenderResult result{.film = earlier.film(),
                      .counts = earlier.counts(),
                      .splat_covariance = earlier.splat_covariance()};
  result.seconds = earlier.seconds(result.film);
  const std::uint32_t block = result.film.block();
  const auto pixels =
      static_cast<std::uint64_t>(earlier.width()) * static_cast<std::uint64_t>(earlier.height());
  if (spp && (*spp % block != 0 || *spp * pixels <= result.film.samples())) {
    throw Error(
        "cannot continue from {1:.6g} samples to --spp {0}: expected more, a multiple of {2}", *spp,
        static_cast<double>(result.film.samples()) / static_cast<double>(pixels), block);
  }
  return result;
}

EarlierAdaptive adaptive_start(const EarlierRender& earlier) {
  EarlierAdaptive start{earlier.adaptive_state(), earlier.counts()};
  start.seconds = earlier.seconds(start.state.film());
  return start;
}

}  // namespace carlo
