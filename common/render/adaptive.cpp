#include "render/adaptive.h"

#include "numeric/compensated.h"
#include "render/adaptive_state.h"
#include "render/interrupt.h"
#include "render/lamp_pass.h"
#include "render/light_asks.h"
#include "support/error.h"
#include "support/wall_clock.h"

#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <vector>

namespace carlo {
namespace {

/// Decisions are taken for squares of this many pixels a side; work is handed out in squares of up
/// to `square_size`.
constexpr int unit_size = adaptive_unit_size, square_size = 16;
/// 95 % of normal errors are within this many standard errors.
constexpr double confidence = 1.96;
/// The worst pixel of a unit may be this much above the unit's root mean square error.
constexpr double worst_excess = 3;
constexpr double floor_fraction = 0.01;
/// A render may be kept (checkpoints) after so many jobs for each thread.
constexpr std::ptrdiff_t jobs_at_once = 64;
/// Of a half: for lights alone no pixel gets more.
constexpr double most_for_lights = 1024;
/// Larger jobs are split, so that all threads have work until the end.
constexpr std::uint64_t most_paths_a_job = 1u << 20;

/// A square of pixels and a half of theirs, for one round.
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
        counts_(options.earlier_counts) {
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
        if (!render(work, half)) return;  // some pixels may lack the round
      }
      if (options_.share) return;  // others have the rest of it
      if (state_.level == 0) set_floors();
      decide();
      if (options_.one_round) {
        ++state_.level;
        return;
      }
    }
  }

  AdaptiveResult result() const {
    AdaptiveResult result{
        state_.film(), counts_, {}, std::make_shared<const AdaptiveState>(state_)};
    std::vector<std::uint64_t> samples;
    for (int y = 0; y < state_.height; ++y) {
      for (int x = 0; x < state_.width; ++x)
        samples.push_back(result.film.samples(x, y));
    }
    std::sort(samples.begin(), samples.end());
    AdaptiveSummary& summary = result.summary;
    summary.target = goal_.target;
    summary.least = samples.front();
    summary.median = samples[samples.size() / 2];
    summary.most = samples.back();
    summary.floor = floor_fraction * mean_luminance(0, 1);
    summary.within = expected_within(state_, goal_.target, summary.floor);
    summary.capped = capped();
    summary.asks = asks(static_cast<double>(summary.least));
    const auto taken = static_cast<double>(counts_.paths);
    summary.decided_only = taken > 0 ? 1 - static_cast<double>(result.film.samples()) / taken : 0;
    return result;
  }

 private:
  const AdaptiveState::Unit& unit_of(int x, int y) const {
    return state_.units[state_.unit_number(x, y)];
  }

  /// Halves that still get samples have those of all rounds before, and with or without this one's.
  void check_samples() const {
    const double before = levels_.begin(state_.level), after = levels_.end(state_.level);
    for (int y = 0; y < state_.height; ++y) {
      for (int x = 0; x < state_.width; ++x) {
        for (const auto& half : state_.halves) {
          const double n = half[state_.pixel(x, y)].seen().samples();
          if (unit_of(x, y).active() && n != before && n != after) {
            throw Error(
                "an adaptive render with {} samples in half a pixel cannot go on with --spp {}", n,
                goal_.spp);
          }
        }
      }
    }
  }

  /// Lets the caller keep what is there, now and then.
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

  /// A half's work of a round; whether it was finished.
  bool render(const std::vector<Work>& work, std::uint32_t half) {
    std::vector<Work> left;
    std::uint32_t number = 0;  // of the half's jobs
    for (const Work& w : work) {
      if (w.half == half && ours(number++) && !done(w)) left.push_back(w);
    }
    if (left.empty()) return true;
    const std::vector<LampPass> lamps = trace_lamps(half);
    const auto batch = jobs_at_once * tbb::this_task_arena::max_concurrency();
    for (auto begin = left.begin(); begin < left.end();) {
      const auto end = begin + std::min<std::ptrdiff_t>(batch, left.end() - begin);
      tbb::parallel_for_each(begin, end, [&](const Work& w) { render(w, lamps); });
      // Counted with the last of the half's work: what goes on from a copy traces them again.
      if (ours(0) &&
          std::all_of(left.begin(), left.end(), [&](const Work& w) { return done(w); })) {
        for (const LampPass& pass : lamps)
          counts_ += pass.counts();
      }
      if (stopped()) return false;
      save();
      begin = end;
    }
    return true;
  }

  /// Whether it has this round's samples, perhaps from an earlier render.
  bool done(const Work& work) const {
    const GroupedMean& seen = state_.halves[work.half][state_.pixel(work.x, work.y)].seen();
    return seen.samples() > levels_.begin(state_.level);
  }

  /// What comes to all pixels from the lamps, for each block of a round: as many paths as start at
  /// the camera, about, or a few pixels' last rounds would cost as much as the whole image's.
  std::vector<LampPass> trace_lamps(std::uint32_t half) const {
    std::vector<LampPass> passes;
    for (std::uint32_t b = 0; b < HalfPixel::blocks; ++b)
      passes.emplace_back(integrator_, state_.halves[0].size(), half, first_sample(b), block(),
                          state_.undecided(half));
    return passes;
  }

  /// The samples of a block of this round, and the first of block b.
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

  /// Adds the active pixels of a square, in squares as large as can be.
  void plan_square(int x, int y, int size, std::vector<Work>& work) const {
    const int x1 = std::min(x + size, state_.width), y1 = std::min(y + size, state_.height);
    if (x >= x1 || y >= y1) return;
    bool all = true, none = true;
    for (int v = y; v < y1; v += unit_size) {
      for (int u = x; u < x1; u += unit_size) {
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

  void render(const Work& work, const std::vector<LampPass>& lamps) {
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
              lamps[0].share()};
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
          lamps[b].add_to(group[b], state_.pixel(x, y));
        half[state_.pixel(x, y)].add(group, block());
      }
    }
    const std::lock_guard lock(mutex_);
    counts_ += counts;
    const double done = static_cast<double>(counts_.paths);
    options_.progress(goal_.seconds ? clock_.seconds() / *goal_.seconds
                                    : done / std::fmax(state_.expected_paths, done));
  }

  /// The mean luminance of the image, from the halves [begin, end).
  double mean_luminance(std::size_t begin, std::size_t end) const {
    CompensatedSum sum;
    for (std::size_t h = begin; h < end; ++h) {
      for (const HalfPixel& p : state_.halves[h])
        sum.add(p.estimate(3).mean());
    }
    return sum.value() / static_cast<double>((end - begin) * state_.halves[0].size());
  }

  /// From the first round, each half for itself: else the halves would not be independent.
  void set_floors() {
    for (std::size_t h = 0; h < 2; ++h)
      state_.floors[h] = floor_fraction * mean_luminance(h, h + 1);
  }

  /// The squared relative errors that the image would have if both halves were as this one.
  struct SquaredErrors {
    double mean = 0, worst = 0;
  };
  SquaredErrors errors(std::size_t unit, std::size_t half) const {
    const int x0 = static_cast<int>(unit) % state_.columns * unit_size;
    const int y0 = static_cast<int>(unit) / state_.columns * unit_size;
    const int x1 = std::min(x0 + unit_size, state_.width),
              y1 = std::min(y0 + unit_size, state_.height);
    SquaredErrors result;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const GroupedMean& seen = state_.halves[half][state_.pixel(x, y)].seen();
        const double reference = std::fmax(seen.mean(), state_.floors[half]);
        const double variance = seen.variance() / 2;
        const double squared = variance > 0 ? variance / (reference * reference) : 0;
        result.mean += squared / ((x1 - x0) * (y1 - y0));
        result.worst = std::fmax(result.worst, squared);
      }
    }
    return result;
  }

  /// After a round: each half of each active unit looks whether the other is finished. Only what
  /// the same half of other units saw before their decisions counts besides, so that decisions stay
  /// functions of that half's samples alone.
  void decide() {
    const double allowed = goal_.target * goal_.target / (confidence * confidence);
    const double n = levels_.end(state_.level);
    if (n < most_for_lights && asks(n) < enough_asks) {
      state_.expected_paths =
          std::fmax(state_.expected_paths, 2 * static_cast<double>(counts_.paths));
      return;
    }
    std::vector<std::array<SquaredErrors, 2>> found(state_.units.size());
    for (std::size_t unit = 0; unit < state_.units.size(); ++unit) {
      for (std::size_t half = 0; half < 2; ++half) {
        if (state_.units[unit].fell[half]) continue;
        found[unit][half] = errors(unit, half);
        state_.units[unit].noise[half] = n * found[unit][half].mean;
      }
    }
    double missing = 0;
    for (std::size_t unit = 0; unit < state_.units.size(); ++unit) {
      for (std::size_t half = 0; half < 2; ++half) {
        if (state_.units[unit].fell[half]) continue;
        const SquaredErrors& e = found[unit][half];
        const double mean = std::fmax(e.mean, noise_around(unit, half) / n);
        if (mean <= allowed && e.worst <= worst_excess * worst_excess * allowed) {
          state_.units[unit].fell[half] = true;
          finish(unit, 1 - half);
        } else {
          missing += still_missing(mean / allowed);
        }
      }
    }
    state_.expected_paths = static_cast<double>(counts_.paths) + missing;
  }

  /// The mean noise of a unit and the eight around it, as one half's samples show it.
  double noise_around(std::size_t unit, std::size_t half) const {
    const int column = static_cast<int>(unit) % state_.columns,
              row = static_cast<int>(unit) / state_.columns;
    const int rows = static_cast<int>(state_.units.size()) / state_.columns;
    double sum = 0, count = 0;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y) {
      for (int x = std::max(column - 1, 0); x <= std::min(column + 1, state_.columns - 1); ++x) {
        sum += state_
                   .units[static_cast<std::size_t>(y) * static_cast<std::size_t>(state_.columns) +
                          static_cast<std::size_t>(x)]
                   .noise[half];
        ++count;
      }
    }
    return sum / count;
  }

  double asks(double samples) const {
    return expected_asks(integrator_.least_light_chance(), samples, state_.width, state_.height);
  }

  /// An estimate of the samples that a unit lacks, for the progress bar.
  double still_missing(double excess) const {
    const double n = levels_.end(state_.level), most = levels_.end(levels_.count() - 1);
    return unit_size * unit_size * (std::clamp(n * excess, 1.5 * n, std::fmax(most, 1.5 * n)) - n);
  }

  void finish(std::size_t unit, std::size_t half) {
    const int x0 = static_cast<int>(unit) % state_.columns * unit_size;
    const int y0 = static_cast<int>(unit) / state_.columns * unit_size;
    for (int y = y0; y < std::min(y0 + unit_size, state_.height); ++y) {
      for (int x = x0; x < std::min(x0 + unit_size, state_.width); ++x)
        state_.halves[half][state_.pixel(x, y)].finish();
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
  double last_save_ = 0;
  std::mutex mutex_;  ///< guards counts_ and the calls of options_.progress
  Counts counts_;
};

}  // namespace

AdaptiveResult render_adaptively(const Integrator& integrator, int width, int height,
                                 const AdaptiveGoal& goal, const AdaptiveOptions& options) {
  AdaptiveState state = options.earlier ? *options.earlier : AdaptiveState(width, height);
  if (state.width != width || state.height != height) {
    throw Error("an adaptive render of {} x {} pixels cannot go on with {} x {}", state.width,
                state.height, width, height);
  }
  AdaptiveJob job(integrator, std::move(state), goal, options);
  job.run();
  return job.result();
}

}  // namespace carlo
