#include "renderer/production/shard_render.h"

#include "course/render/outputs.h"
#include "course/render/report.h"
#include "render/driver.h"
#include "renderer/production/part.h"
#include "scene/needs.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <optional>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// Returns the path given by -o with the extension of parts; by default the scene's name and the
/// share.
fs::path part_path(const ShardRender& render) {
  fs::path given(render.output);
  if (given.extension() == part_suffix) return given;
  const bool named = given.has_filename() && !fs::is_directory(given);
  const fs::path stem = output_stem(render.output, render.scene);
  const Shard& shard = render.shard;
  return with_suffix(stem, named
                               ? std::string(part_suffix)
                               : fmt::format(".{}-of-{}{}", shard.index, shard.count, part_suffix));
}

PartHeader header_of(const Scene& scene, const Integrator& integrator, const ShardRender& render) {
  PartHeader part;
  part.settings = render.settings;
  part.settings["version"] = program_version();
  part.scene = render.scene;
  part.needs = describe(needs(scene));
  const std::uint32_t block = block_size(render.spp);
  part.grid = {scene.width, scene.height, block, render.spp / block};
  part.light_paths = integrator.light_paths() > 0;
  part.least_light_probability = integrator.least_light_probability();
  part.shard = render.shard;
  return part;
}

/// Returns the header for the samples rendered so far.
PartHeader with(PartHeader part, const RenderResult& result, const BlockRange& share) {
  part.blocks = blocks_done(result.film, share);
  part.counts = result.counts;
  part.covariance = result.covariance;
  part.microseconds = static_cast<std::uint64_t>(std::llround(1e6 * result.seconds));
  part.threads = result.threads;
  return part;
}

/// Reads the state to continue from.
RenderResult result_of(const PartFile& file, const PartHeader& now, const BlockRange& share) {
  const PartHeader& then = file.header();
  const std::string where = fmt::format("cannot continue {}", file.path().string());
  const char* const hint = "; remove it, or name another with -o";
  if (const auto difference = difference_of(then, now)) {
    throw Error("{}: its {} is {}, this render's {}{}", where, difference->name, difference->a,
                difference->b, hint);
  }
  if (then.shard != now.shard) {
    throw Error("{}: it is {}, not shard {}{}", where, describe(then), now.shard->text(), hint);
  }
  RenderResult result{.film = Film(now.grid.width, now.grid.height, now.grid.block),
                      .counts = then.counts,
                      .covariance = then.covariance,
                      .seconds = 1e-6 * static_cast<double>(then.microseconds)};
  file.add_to(result.film);
  if (blocks_done(result.film, share) != then.blocks) {
    throw Error("{}: its samples are not the first ones of shard {}{}", where, now.shard->text(),
                hint);
  }
  return result;
}

/// True if another process has by now written more of the same share; a node that seemed dead, for
/// example.
bool is_behind(const fs::path& path, const PartHeader& part) {
  try {
    const PartFile file(path);
    const PartHeader& there = file.header();
    return there.shard == part.shard && !difference_of(there, part) &&
           there.blocks.count() > part.blocks.count();
  } catch (const Error&) {
    return false;
  }
}

void tell(const Scene& scene, const Integrator& integrator, const ShardRender& render,
          const PartHeader& part, const RenderResult& result, const fs::path& path,
          const BlockRange& share) {
  const std::uint64_t seed = std::stoull(part.settings.at("seed"));
  const RenderReport report = make_report(scene, render.scene, integrator, seed, result);
  fmt::print("{}", to_text(to_lines(report)));
  for (const std::string& note : scene.notes)
    fmt::print("  {:<16} {}\n", "note", note);
  if (share.count() == 0) {
    fmt::print(
        "  {:<16} shard {} has no samples: there are {} blocks of them, for as many shards\n",
        "note", render.shard.text(), part.grid.blocks());
  }
  const std::uint64_t done = part.blocks.count();
  fmt::print("  {:<16} {}: {} of shard {}, {:.4g} % of all samples\n", "written", path.string(),
             done == share.count()
                 ? "all"
                 : fmt::format("{:.4g} %", 100.0 * static_cast<double>(done) /
                                               static_cast<double>(share.count())),
             render.shard.text(),
             100.0 * static_cast<double>(done) / static_cast<double>(part.grid.blocks()));
}

}  // namespace

int render_shard(const Scene& scene, const Integrator& integrator, const ShardRender& render) {
  const fs::path path = part_path(render);
  const AtomicFile writable(path);
  const PartHeader header = header_of(scene, integrator, render);
  const BlockRange share = share_of(render.shard, header.grid, header.light_paths);
  std::optional<RenderResult> start;
  if (fs::exists(path)) {
    const PartFile file(path);
    start = result_of(file, header, share);
    if (file.header().blocks.count() == share.count()) {
      if (!render.quiet)
        fmt::print("  {} has all of shard {} already\n", path.string(), render.shard.text());
      return 0;
    }
  }
  const auto write = [&](const RenderResult& r) {
    const PartHeader part = with(header, r, share);
    if (!is_behind(path, part)) write_part(path, part, r.film);
  };
  const RenderResult result = carlo::render(integrator, scene.width, scene.height,
                                            {.spp = render.spp,
                                             .threads = render.threads,
                                             .progress = !render.quiet,
                                             .earlier = start ? &*start : nullptr,
                                             .share = share,
                                             .checkpoint = write,
                                             .checkpoint_seconds = render.checkpoint_seconds});
  write(result);
  if (!render.quiet)
    tell(scene, integrator, render, with(header, result, share), result, path, share);
  return result.interrupted ? 130 : 0;
}

}  // namespace carlo
