#include "renderer/production/shard_render.h"

#include "course/render/outputs.h"
#include "course/render/report.h"
#include "render/driver.h"
#include "renderer/production/state_exr.h"
#include "renderer/production/state_file.h"
#include "scene/needs.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <optional>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// Returns the path that -o names; by default it is made of the scene's name and the share.
fs::path part_path(const ShardRender& render) {
  const fs::path given(render.output);
  const bool named = given.has_filename() && !fs::is_directory(given);
  const Shard& shard = render.shard;
  return with_suffix(
      output_stem(render.output, render.scene),
      named ? std::string(".exr") : fmt::format(".{}-of-{}.exr", shard.index, shard.count));
}

/// A share of a render and its files.
class Share {
 public:
  Share(const Scene& scene, const Integrator& integrator, const ShardRender& render)
      : scene_(scene), integrator_(integrator), render_(render), settings_(render.settings) {
    settings_["version"] = program_version();
    const std::uint32_t block = block_size(render.spp);
    grid_ = {scene.width, scene.height, block, render.spp / block};
    part_.needs = describe(needs(scene));
    part_.lamps = integrator.lamp_paths() > 0;
    part_.least_light_chance = integrator.least_light_chance();
    part_.shard = render.shard;
    range_ = share_of(render.shard, grid_, part_.lamps);
  }

  const BlockRange& range() const { return range_; }

  /// Returns the result to continue from. Throws Error if the file is anything else.
  RenderResult start_from(const StateFile& file) const;
  /// Writes the part, unless the file already holds more of the same share, by another process: for
  /// example of a node that was taken for dead.
  void write(const fs::path& path, const RenderResult& result) const;
  void tell(const fs::path& path, const RenderResult& result) const;

 private:
  bool is_behind(const fs::path& path, std::uint64_t blocks) const;

  const Scene& scene_;
  const Integrator& integrator_;
  const ShardRender& render_;
  RenderSettings settings_;
  BlockGrid grid_;
  Part part_;  ///< without what has been rendered
  BlockRange range_;
};

RenderResult Share::start_from(const StateFile& file) const {
  const std::string where = fmt::format("cannot go on with {}", file.path().string());
  const char* const hint = "; remove it, or name another with -o";
  if (!file.part()) throw Error("{}: it is no part of a render{}", where, hint);
  if (const auto difference = difference_of(file.settings(), settings_)) {
    throw Error("{}: its {} is {}, this render's {}{}", where, difference->name, difference->a,
                difference->b, hint);
  }
  if (file.part()->shard != part_.shard) {
    throw Error("{}: it is {}, not shard {}{}", where, told(*file.part()), part_.shard->text(),
                hint);
  }
  RenderResult result{.film = Film(grid_.width, grid_.height, grid_.block),
                      .counts = file.counts(),
                      .lamp_ties = file.lamp_ties(),
                      .seconds = 1e-6 * static_cast<double>(file.part()->microseconds)};
  file.add_to(result.film);
  if (blocks_done(result.film, range_) != file.part()->blocks) {
    throw Error("{}: its samples are not the first ones of shard {}{}", where, part_.shard->text(),
                hint);
  }
  return result;
}

void Share::write(const fs::path& path, const RenderResult& result) const {
  Part part = part_;
  part.blocks = blocks_done(result.film, range_);
  part.microseconds = static_cast<std::uint64_t>(std::llround(1e6 * result.seconds));
  part.threads = result.threads;
  if (is_behind(path, part.blocks.count())) return;
  ExrFile file{.image = result.film.mean()};
  file.attributes["scene"] = render_.scene;
  add_state(file, settings_, result.film, result.counts, result.lamp_ties);
  add_part(file, part);
  write_state(path, std::move(file));
}

bool Share::is_behind(const fs::path& path, std::uint64_t blocks) const {
  try {
    const StateFile there(path);
    return there.part() && there.part()->shard == part_.shard &&
           !difference_of(there.settings(), settings_) && there.part()->blocks.count() > blocks;
  } catch (const Error&) {
    return false;
  }
}

void Share::tell(const fs::path& path, const RenderResult& result) const {
  const auto seed = number_of<std::uint64_t>(settings_.at("seed")).value_or(0);
  ReportLines lines = to_lines(make_report(scene_, render_.scene, integrator_, seed, result));
  for (const std::string& note : scene_.notes)
    lines.emplace_back("note", note);
  if (range_.count() == 0) {
    lines.emplace_back("note",
                       fmt::format("shard {} has no samples: there are {} blocks of them, for as "
                                   "many shards",
                                   render_.shard.text(), grid_.blocks()));
  }
  const std::uint64_t done = blocks_done(result.film, range_).count();
  const auto percent = [&](std::uint64_t of) {
    return fmt::format("{:.4g} %", 100.0 * static_cast<double>(done) / static_cast<double>(of));
  };
  lines.emplace_back("written",
                     fmt::format("{}: {} of shard {}, {} of all samples", path.string(),
                                 done == range_.count() ? "all" : percent(range_.count()),
                                 render_.shard.text(), percent(grid_.blocks())));
  fmt::print("{}", to_text(lines));
}

}  // namespace

int render_shard(const Scene& scene, const Integrator& integrator, const ShardRender& render) {
  const fs::path path = part_path(render);
  const AtomicFile writable(path);
  const Share share(scene, integrator, render);
  std::optional<RenderResult> start;
  if (fs::exists(path)) {
    const StateFile file(path);
    start = share.start_from(file);
    if (file.part()->blocks.count() == share.range().count()) {
      if (!render.quiet)
        fmt::print("  {} has all of shard {} already\n", path.string(), render.shard.text());
      return 0;
    }
  }
  const auto write = [&](const RenderResult& r) { share.write(path, r); };
  const RenderResult result = carlo::render(integrator, scene.width, scene.height,
                                            {.spp = render.spp,
                                             .threads = render.threads,
                                             .progress = !render.quiet,
                                             .earlier = start ? &*start : nullptr,
                                             .share = share.range(),
                                             .checkpoint = write,
                                             .checkpoint_seconds = render.checkpoint_seconds});
  write(result);
  if (!render.quiet) share.tell(path, result);
  return result.interrupted ? 130 : 0;
}

}  // namespace carlo
