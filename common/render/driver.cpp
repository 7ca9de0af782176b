#include "render/driver.h"

#include "render/interrupt.h"
#include "render/light_pass.h"
#include "support/progress.h"
#include "support/wall_clock.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

namespace carlo {
namespace {

constexpr int tile_size = driver_tile_size;

class Job {
 public:
  /// Continues from what `result` holds.
  Job(const Integrator& integrator, RenderResult& result, const RenderOptions& options)
      : integrator_(integrator),
        result_(result),
        film_(result.film),
        options_(options),
        columns_((film_.width() + tile_size - 1) / tile_size),
        rows_((film_.height() + tile_size - 1) / tile_size),
        share_(options.share.value_or(everything())),
        earlier_seconds_(result.seconds),
        progress_("rendering", options.progress) {}

  /// Renders passes of one block in every pixel until the samples or the time are used up.
  void run() {
    const std::size_t pixels =
        static_cast<std::size_t>(film_.width()) * static_cast<std::size_t>(film_.height());
    const auto passes = static_cast<std::uint32_t>((share_.end + tiles() - 1) / tiles());
    std::uint32_t at_once = 1;
    for (std::uint32_t pass = first_pass(passes); pass < passes && !stopped(pass);) {
      const WallClock clock;
      const std::uint32_t end = pass + std::min(at_once, passes - pass);
      const LightPass light_pass(integrator_, pixels, 0, pass * film_.block(), film_.block());
      if (interrupt_noted()) break;
      tbb::parallel_for(
          0, columns_ * rows_, [&](int tile) { run_tile(tile, pass, end, light_pass); },
          tbb::simple_partitioner{});
      settle();
      if (end < passes && !stopped(end)) save();
      at_once = passes_at_once(clock.seconds() / (end - pass));
      pass = end;
    }
    settle();
  }

 private:
  std::uint64_t tiles() const {
    return static_cast<std::uint64_t>(columns_) * static_cast<std::uint64_t>(rows_);
  }

  BlockRange everything() const {
    const std::uint32_t passes = options_.seconds ? ~0u : options_.spp / film_.block();
    return {0, passes * tiles()};
  }

  int corner_x(int tile) const { return tile % columns_ * tile_size; }
  int corner_y(int tile) const { return tile / columns_ * tile_size; }

  /// The number of passes to render at once, tile by tile, which takes less time than one after
  /// another: as many as take no longer than somebody who looks at the image would notice, and are
  /// done when the time is up or the result is to be saved. Light paths belong to one pass.
  std::uint32_t passes_at_once(double seconds_of_pass) const {
    if (integrator_.light_paths() > 0) return 1;
    double seconds = 0.25;
    if (options_.seconds) seconds = std::min(seconds, *options_.seconds - clock_.seconds());
    if (options_.checkpoint)
      seconds = std::min(seconds, last_save_ + options_.checkpoint_seconds - clock_.seconds());
    const double most = std::min(seconds / seconds_of_pass, double{most_passes_at_once});
    return static_cast<std::uint32_t>(std::max(1.0, most));
  }

  /// The next pass of a tile. Tiles may differ by `most_passes_at_once` after an interruption.
  std::uint64_t next_pass(int tile) const {
    return share_.first_pass(static_cast<std::uint64_t>(tile), tiles()) +
           film_.blocks(corner_x(tile), corner_y(tile));
  }

  /// True if a tile's block belongs to this share and no earlier render has it.
  bool is_missing(int tile, std::uint64_t pass) const {
    return next_pass(tile) <= pass &&
           share_.contains(pass * tiles() + static_cast<std::uint64_t>(tile));
  }

  /// The first unfinished pass; `passes` if all are finished.
  std::uint32_t first_pass(std::uint32_t passes) {
    std::uint64_t first = passes;
    for (int tile = 0; tile < columns_ * rows_; ++tile) {
      const std::uint64_t next = next_pass(tile);
      if (next < first && is_missing(tile, next)) first = next;
      blocks_done_ += film_.blocks(corner_x(tile), corner_y(tile));
    }
    return static_cast<std::uint32_t>(first);
  }

  /// Fills in the results that follow from the others.
  void settle() {
    result_.seconds = earlier_seconds_ + clock_.seconds();
    result_.counts.splat_covariance =
        result_.covariance.splats.value() / static_cast<double>(tiles());
  }

  /// Passes the current result to the checkpoint callback if it is due.
  void save() {
    if (!options_.checkpoint || clock_.seconds() - last_save_ < options_.checkpoint_seconds) return;
    options_.checkpoint(result_);
    last_save_ = clock_.seconds();
  }

  /// With a time limit every pixel still gets two blocks; with fewer there is no error estimate.
  bool stopped(std::uint32_t pass) const {
    return interrupt_noted() ||
           (options_.seconds && pass >= 2 && clock_.seconds() >= *options_.seconds);
  }

  /// Renders those passes of a tile from `first` to `end` that are missing.
  void run_tile(int number, std::uint32_t first, std::uint32_t end, const LightPass& light_pass) {
    while (first < end && !is_missing(number, first))
      ++first;
    while (first < end && !is_missing(number, end - 1))
      --end;
    if (stopped(first) || first == end) return;
    const std::uint32_t blocks = end - first;
    Tile tile;
    tile.x0 = corner_x(number);
    tile.y0 = corner_y(number);
    tile.x1 = std::min(tile.x0 + tile_size, film_.width());
    tile.y1 = std::min(tile.y0 + tile_size, film_.height());
    tile.samples = film_.block();
    tile.first_sample = first * film_.block();
    tile.light_path_share = light_pass.share();
    tile.share = true;
    std::array<std::array<double, 3>, most_passes_at_once * tile_size * tile_size> room;
    const auto pixels = static_cast<std::size_t>((tile.x1 - tile.x0) * (tile.y1 - tile.y0));
    const std::span means = std::span(room).first(blocks * pixels);
    Counts counts;
    integrator_.render_blocks(tile, blocks, means, counts);
    if (interrupt_noted()) return;  // it may have been cut short
    std::size_t i = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x, ++i)
        add_blocks(x, y, means.subspan(i * blocks, blocks), light_pass);
    }
    // A pass that is rendered in several runs traces its light paths in each; they are counted
    // once, with tile 0.
    if (number == 0) counts += light_pass.counts();
    finish_tile(blocks, counts, light_pass.counts().splat_covariance);
  }

  void add_blocks(int x, int y, std::span<std::array<double, 3>> means,
                  const LightPass& light_pass) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(film_.width()) +
        static_cast<std::size_t>(x);
    for (std::array<double, 3>& mean : means)
      light_pass.add_to(mean, pixel);
    film_.add_blocks(x, y, means);
  }

  void finish_tile(std::uint32_t blocks, const Counts& counts, double splat_covariance) {
    const std::lock_guard lock(mutex_);
    result_.counts += counts;
    result_.covariance.splats.add(splat_covariance);  // 0 for several blocks
    for (std::size_t c = 0; c < 3; ++c)
      result_.covariance.shared[c].add(counts.shared_covariance[c]);
    blocks_done_ += blocks;
    progress_.update(options_.seconds
                         ? clock_.seconds() / *options_.seconds
                         : static_cast<double>(blocks_done_) / static_cast<double>(share_.count()));
  }

  const Integrator& integrator_;
  RenderResult& result_;  ///< all but the film is written under the mutex
  Film& film_;
  const RenderOptions& options_;
  int columns_, rows_;
  BlockRange share_;
  double earlier_seconds_, last_save_ = 0;
  WallClock clock_;
  std::mutex mutex_;  ///< guards the two below
  std::uint64_t blocks_done_ = 0;
  Progress progress_;
};

}  // namespace

bool render_interrupted() {
  return interrupt_noted();
}

std::uint32_t block_size(std::uint32_t spp) {
  const std::uint32_t divisor = spp & (~spp + 1);
  return std::clamp(std::bit_floor(spp / 8), 1u, std::min(divisor, 64u));
}

RenderResult render(const Integrator& integrator, int width, int height,
                    const RenderOptions& options) {
  const InterruptGuard guard;
  const std::uint32_t block = options.seconds ? 8 : block_size(options.spp);
  RenderResult result =
      options.earlier ? *options.earlier : RenderResult{.film = Film(width, height, block)};
  Job job(integrator, result, options);
  result.threads = on_threads(options.threads, [&] { job.run(); });
  if (!options.earlier) result.seconds += integrator.seconds_spent();
  result.interrupted = interrupt_noted();
  return result;
}

static constexpr std::size_t max_threads = 1024;

int on_threads(int threads, const std::function<void()>& work) {
  const int count = threads > 0 ? threads : static_cast<int>(tbb::info::default_concurrency());
  // Lets arenas have more workers than there are cores. A single limit for the whole program,
  // because TBB does not handle lowering and raising it again well.
  static const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, max_threads);
  tbb::task_arena arena(count);
  arena.execute(work);
  return count;
}

}  // namespace carlo
