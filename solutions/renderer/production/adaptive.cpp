#include "renderer/production/adaptive.h"

#include "render/driver.h"
#include "render/interrupt.h"
#include "render/light_coverage.h"
#include "render/light_pass.h"
#include "renderer/production/adaptive_decisions.h"
#include "renderer/production/adaptive_state.h"
#include "support/error.h"
#include "support/progress.h"
#include "support/wall_clock.h"

#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

namespace carlo {
namespace {

/// Work is handed out in squares of up to this side, in pixels.
constexpr int square_size = 16;
/// Jobs per thread between possible checkpoints.
constexpr std::ptrdiff_t jobs_at_once = 64;
/// Samples per half; beyond these no pixel waits for lights that have not been sampled.
constexpr double most_for_lights = 1024;
/// Larger jobs are split, so that all threads have work until the end.
constexpr std::uint64_t most_paths_a_job = 1u << 20;

/// The samples of one half in a square of pixels, for one round.
struct Work {
  int x, y, size;
  std::uint32_t half;
};

class AdaptiveJob {
 public:
  AdaptiveJob(const Integrator& integrator, AdaptiveState state, const AdaptiveGoal& goal,
              const AdaptiveOptions& options)
      : integrator_(integrator),
        state_(std::move(state)),
        goal_(goal),
        options_(options),
        levels_(goal.spp),
        progress_("rendering", options.progress) {
    if (options.earlier) {
      counts_ = options.earlier->counts;
      earlier_seconds_ = options.earlier->seconds;
    }
    if (!(goal.target > 0) || !std::isfinite(goal.target)) {
      throw Error("--target-error is a number above 0, got {}", goal.target);
    }
    check_samples();
  }

  void run() {
    for (; state_.level < levels_.count() && !stopped(); ++state_.level) {
      const std::vector<Work> work = plan();
      if (work.empty()) return;
      for (std::uint32_t half = 0; half < 2; ++half) {
        if (!render(work, half)) return;  // some pixels may miss this round
      }
      if (options_.share) return;  // the other shares do the rest
      if (state_.level == 0) set_floors(state_);
      decide();
      if (options_.one_round) {
        ++state_.level;
        return;
      }
    }
  }

  AdaptiveResult result() const {
    AdaptiveResult result{{.film = state_.film(), .counts = counts_},
                          {},
                          std::make_shared<const AdaptiveState>(state_)};
    result.seconds = earlier_seconds_ + clock_.seconds();
    result.threads = tbb::this_task_arena::max_concurrency();
    result.summary = summary_of(result.film);
    // Each round traces about as many light paths as its mean number of samples per pixel
    // calls for.
    const double pixels = 1.0 * state_.width * state_.height;
    result.light_path_covariance =
        counts_.splat_covariance / (static_cast<double>(result.film.samples()) * pixels *
                                    static_cast<double>(result.summary.most));
    return result;
  }

 private:
  AdaptiveSummary summary_of(const Film& film) const {
    std::vector<std::uint64_t> samples;
    for (int y = 0; y < state_.height; ++y) {
      for (int x = 0; x < state_.width; ++x)
        samples.push_back(film.samples(x, y));
    }
    std::sort(samples.begin(), samples.end());
    AdaptiveSummary summary;
    summary.target = goal_.target;
    summary.least = samples.front();
    summary.median = samples[samples.size() / 2];
    summary.most = samples.back();
    summary.floor = adaptive_floor(state_, 0, 1);
    summary.within = expected_within(state_, goal_.target, summary.floor);
    summary.capped = capped();
    summary.light_samples = light_samples(static_cast<double>(summary.least));
    const auto taken = static_cast<double>(counts_.paths);
    summary.decided_only = taken > 0 ? 1 - static_cast<double>(film.samples()) / taken : 0;
    return summary;
  }

  const AdaptiveState::Unit& unit_of(int x, int y) const {
    return state_.units[state_.unit_number(x, y)];
  }

  /// Throws Error unless halves that still get samples have those of all earlier rounds, and all or
  /// none of this round's.
  void check_samples() const {
    const double before = levels_.begin(state_.level), after = levels_.end(state_.level);
    for (int y = 0; y < state_.height; ++y) {
      for (int x = 0; x < state_.width; ++x) {
        for (const auto& half : state_.halves) {
          const double n = half[state_.pixel(x, y)].seen().samples();
          if (unit_of(x, y).active() && n != before && n != after) {
            throw Error(
                "an adaptive render with {} samples in half a pixel cannot continue with --spp {}",
                n, goal_.spp);
          }
        }
      }
    }
  }

  /// Passes the current result to the checkpoint callback if it is due.
  void save() {
    if (!options_.checkpoint || clock_.seconds() - last_save_ < options_.checkpoint_seconds) return;
    options_.checkpoint(result());
    last_save_ = clock_.seconds();
  }

  bool stopped() const {
    return interrupt_noted() ||
           (goal_.seconds && state_.level > 0 && clock_.seconds() >= *goal_.seconds);
  }

  bool ours(std::uint32_t number) const {
    return !options_.share || number % options_.share->count == options_.share->index - 1;
  }

  /// Renders one half's work of a round; returns whether it was finished.
  bool render(const std::vector<Work>& work, std::uint32_t half) {
    std::vector<Work> left;
    std::uint32_t number = 0;  // among the half's jobs
    for (const Work& w : work) {
      if (w.half == half && ours(number++) && !done(w)) left.push_back(w);
    }
    if (left.empty()) return true;
    const std::vector<LightPass> light_passes = trace_light_paths(half);
    const auto batch = jobs_at_once * tbb::this_task_arena::max_concurrency();
    for (auto begin = left.begin(); begin < left.end();) {
      const auto end = begin + std::min<std::ptrdiff_t>(batch, left.end() - begin);
      tbb::parallel_for_each(begin, end, [&](const Work& w) { render(w, light_passes); });
      // Counted with the last of the half's work, since a render that continues from a copy traces
      // them again.
      if (ours(0) &&
          std::all_of(left.begin(), left.end(), [&](const Work& w) { return done(w); })) {
        for (const LightPass& pass : light_passes)
          counts_ += pass.counts();
      }
      if (stopped()) return false;
      save();
      begin = end;
    }
    return true;
  }

  /// True if the square has this round's samples, perhaps from an earlier render.
  bool done(const Work& work) const {
    const GroupedMean& seen = state_.halves[work.half][state_.pixel(work.x, work.y)].seen();
    return seen.samples() > levels_.begin(state_.level);
  }

  /// Traces the light paths for each block of a round: about as many as belong to its camera paths,
  /// or the last rounds of a few pixels would cost as much as those of the whole image.
  std::vector<LightPass> trace_light_paths(std::uint32_t half) const {
    std::vector<LightPass> passes;
    for (std::uint32_t b = 0; b < HalfPixel::blocks; ++b)
      passes.emplace_back(integrator_, state_.halves[0].size(), half, first_sample(b), block(),
                          state_.undecided(half));
    return passes;
  }

  /// The number of samples in a block of this round; below, the first sample of block b.
  std::uint32_t block() const {
    const std::uint32_t samples = levels_.end(state_.level) - levels_.begin(state_.level);
    return samples / static_cast<std::uint32_t>(HalfPixel::blocks);
  }
  std::uint32_t first_sample(std::uint32_t b) const {
    return levels_.begin(state_.level) + b * block();
  }

  std::vector<Work> plan() const {
    std::vector<Work> work;
    for (int y = 0; y < state_.height; y += square_size) {
      for (int x = 0; x < state_.width; x += square_size)
        plan_square(x, y, square_size, work);
    }
    return work;
  }

  /// Adds the active pixels of a square, in squares as large as possible.
  void plan_square(int x, int y, int size, std::vector<Work>& work) const {
    const int x1 = std::min(x + size, state_.width), y1 = std::min(y + size, state_.height);
    if (x >= x1 || y >= y1) return;
    bool all = true, none = true;
    for (int v = y; v < y1; v += adaptive_unit_size) {
      for (int u = x; u < x1; u += adaptive_unit_size) {
        const bool active = unit_of(u, v).active();
        all = all && active;
        none = none && !active;
      }
    }
    if (none) return;
    const std::uint64_t paths = static_cast<std::uint64_t>(size) *
                                static_cast<std::uint64_t>(size) *
                                (levels_.end(state_.level) - levels_.begin(state_.level));
    if (all && (size == 1 || paths <= most_paths_a_job)) {
      work.push_back({x, y, size, 0});
      work.push_back({x, y, size, 1});
      return;
    }
    const int part = size / 2;
    for (int i = 0; i < 4; ++i)
      plan_square(x + i % 2 * part, y + i / 2 * part, part, work);
  }

  void render(const Work& work, const std::vector<LightPass>& light_passes) {
    if (stopped()) return;
    constexpr std::size_t blocks = HalfPixel::blocks;
    std::vector<HalfPixel>& half = state_.halves[work.half];
    Tile tile{work.x,
              work.y,
              std::min(work.x + work.size, state_.width),
              std::min(work.y + work.size, state_.height),
              0,
              block(),
              work.half,
              light_passes[0].share()};
    std::vector<HalfPixel::Group> groups(static_cast<std::size_t>(work.size * work.size));
    std::array<std::array<double, 3>, square_size * square_size> means;
    Counts counts;
    for (std::uint32_t b = 0; b < blocks; ++b) {
      tile.first_sample = first_sample(b);
      integrator_.render(tile, means, counts);
      if (interrupt_noted()) return;  // it may have been cut short
      for (std::size_t i = 0; i < groups.size(); ++i)
        groups[i][b] = means[i];
    }
    std::size_t i = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        HalfPixel::Group& group = groups[i++];
        for (std::size_t b = 0; b < blocks; ++b)
          light_passes[b].add_to(group[b], state_.pixel(x, y));
        half[state_.pixel(x, y)].add(group, block());
      }
    }
    const std::lock_guard lock(mutex_);
    counts_ += counts;
    const double done = static_cast<double>(counts_.paths);
    progress_.update(goal_.seconds ? clock_.seconds() / *goal_.seconds
                                   : done / std::fmax(state_.expected_paths, done));
  }

  double light_samples(double samples) const {
    return expected_light_samples(integrator_.least_light_probability(), samples, state_.width,
                                  state_.height);
  }

  /// Makes the decisions of the round if the lights have been sampled often enough.
  void decide() {
    const double n = levels_.end(state_.level), paths = static_cast<double>(counts_.paths);
    if (n < most_for_lights && light_samples(n) < enough_light_samples) {
      state_.expected_paths = std::fmax(state_.expected_paths, 2 * paths);
    } else {
      state_.expected_paths = paths + decide_round(state_, goal_.target, levels_);
    }
  }

  double capped() const {
    double count = 0;
    for (int y = 0; y < state_.height; ++y) {
      for (int x = 0; x < state_.width; ++x)
        count += unit_of(x, y).active() ? 1 : 0;
    }
    return count / static_cast<double>(state_.halves[0].size());
  }

  const Integrator& integrator_;
  AdaptiveState state_;
  const AdaptiveGoal& goal_;
  const AdaptiveOptions& options_;
  Levels levels_;
  WallClock clock_;
  double earlier_seconds_ = 0, last_save_ = 0;
  std::mutex mutex_;  ///< guards the two below
  Counts counts_;
  Progress progress_;
};

}  // namespace

AdaptiveResult render_adaptively(const Integrator& integrator, int width, int height,
                                 const AdaptiveGoal& goal, const AdaptiveOptions& options) {
  const InterruptGuard guard;
  AdaptiveState state = options.earlier ? options.earlier->state : AdaptiveState(width, height);
  if (state.width != width || state.height != height) {
    throw Error("an adaptive render of {} x {} pixels cannot continue with {} x {}", state.width,
                state.height, width, height);
  }
  std::optional<AdaptiveResult> result;
  on_threads(options.threads, [&] {
    AdaptiveJob job(integrator, std::move(state), goal, options);
    job.run();
    result = job.result();
  });
  if (!options.earlier) result->seconds += integrator.seconds_spent();
  result->interrupted = interrupt_noted();
  return *result;
}

}  // namespace carlo
