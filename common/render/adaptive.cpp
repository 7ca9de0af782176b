#include "render/adaptive.h"

#include "cli/error.h"
#include "numeric/compensated.h"
#include "render/half_sums.h"
#include "render/interrupt.h"

#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <mutex>
#include <numbers>
#include <vector>

namespace carlo {
namespace {

/// Decisions are taken for squares of this many pixels a side; work is handed out in squares of up
/// to `tile_size`.
constexpr int unit_size = 4, tile_size = 16;
/// 95 % of normal errors are within this many standard errors.
constexpr double confidence = 1.96;
/// The worst pixel of a unit may be this much above the unit's root mean square error.
constexpr double worst_excess = 3;
constexpr double floor_fraction = 0.01;
/// Larger jobs are split, so that all threads have work until the end.
constexpr std::uint64_t most_paths_a_job = 1u << 20;

/// The samples of a half after a number of rounds: n, 3/2 n, 2 n, 3 n, 4 n ... The samples of each
/// round are aligned runs of a power of two, which Sobol' points fill evenly.
class Levels {
 public:
  explicit Levels(std::uint32_t spp) {
    if (spp < 32) {
      throw Error("--target-error needs at least 32 samples a pixel, got --spp {}", spp);
    }
    first_ = std::min(32u, std::bit_floor(spp / 2));
    while (end(count_) <= spp / 2)
      ++count_;
  }
  int count() const { return count_; }
  std::uint32_t end(int level) const {
    const std::uint32_t octave = first_ << (level / 2);
    return level % 2 == 0 ? octave : octave + octave / 2;
  }
  std::uint32_t begin(int level) const { return level == 0 ? 0 : end(level - 1); }

 private:
  std::uint32_t first_ = 0;
  int count_ = 0;
};

struct Unit {
  std::array<bool, 2> fell{};  ///< whether the decision that a half takes has fallen
  /// Squared relative error times samples, as a half saw it when it last looked.
  std::array<double, 2> noise{};
  bool active() const { return !(fell[0] && fell[1]); }
};

/// A square of pixels and a half of theirs, for one round.
struct Work {
  int x, y, size;
  std::uint32_t half;
};

class AdaptiveJob {
 public:
  AdaptiveJob(const Integrator& integrator, int width, int height, const AdaptiveGoal& goal,
              const std::function<void(double)>& progress)
      : integrator_(integrator),
        width_(width),
        height_(height),
        goal_(goal),
        progress_(progress),
        levels_(goal.spp),
        columns_((width + unit_size - 1) / unit_size),
        units_(static_cast<std::size_t>(columns_) *
               static_cast<std::size_t>((height + unit_size - 1) / unit_size)) {
    if (!(goal.target > 0) || !std::isfinite(goal.target)) {
      throw Error("--target-error is a number above 0, got {}", goal.target);
    }
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (auto& half : halves_)
      half.resize(pixels);
  }

  void run() {
    for (level_ = 0; level_ < levels_.count() && !stopped(); ++level_) {
      const std::vector<Work> work = plan();
      if (work.empty()) return;
      tbb::parallel_for_each(work, [&](const Work& w) { render(w); });
      if (stopped()) return;  // some pixels may lack the round
      if (level_ == 0) set_floors();
      decide();
    }
  }

  AdaptiveResult result(double radiance_scale) const {
    AdaptiveResult result{Film(width_, height_, 1, radiance_scale), counts_, {}};
    std::vector<std::uint64_t> samples;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        add_estimate(x, y, result.film);
        samples.push_back(result.film.samples(x, y));
      }
    }
    std::sort(samples.begin(), samples.end());
    AdaptiveSummary& summary = result.summary;
    summary.target = goal_.target;
    summary.least = samples.front();
    summary.median = samples[samples.size() / 2];
    summary.most = samples.back();
    summary.floor = floor_fraction * mean_luminance(0, 1);
    summary.within = expected_within(summary.floor);
    summary.capped = capped();
    const auto taken = static_cast<double>(counts_.paths);
    summary.decided_only = taken > 0 ? 1 - static_cast<double>(result.film.samples()) / taken : 0;
    return result;
  }

 private:
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  const Unit& unit_of(int x, int y) const {
    return units_[static_cast<std::size_t>(y / unit_size) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(x / unit_size)];
  }

  double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  bool stopped() const {
    return interrupt_noted() || (goal_.seconds && level_ > 0 && elapsed() >= *goal_.seconds);
  }

  std::vector<Work> plan() const {
    std::vector<Work> work;
    for (int y = 0; y < height_; y += tile_size) {
      for (int x = 0; x < width_; x += tile_size)
        plan_square(x, y, tile_size, work);
    }
    return work;
  }

  /// Adds the active pixels of a square, in squares as large as can be.
  void plan_square(int x, int y, int size, std::vector<Work>& work) const {
    const int x1 = std::min(x + size, width_), y1 = std::min(y + size, height_);
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
                                (levels_.end(level_) - levels_.begin(level_));
    if (all && (size == 1 || paths <= most_paths_a_job)) {
      work.push_back({x, y, size, 0});
      work.push_back({x, y, size, 1});
      return;
    }
    const int part = size / 2;
    for (int i = 0; i < 4; ++i)
      plan_square(x + i % 2 * part, y + i / 2 * part, part, work);
  }

  void render(const Work& work) {
    if (stopped()) return;
    constexpr std::size_t blocks = HalfPixel::blocks;
    const std::uint32_t first = levels_.begin(level_);
    const auto samples = static_cast<std::uint32_t>((levels_.end(level_) - first) / blocks);
    Tile tile{work.x,
              work.y,
              std::min(work.x + work.size, width_),
              std::min(work.y + work.size, height_),
              0,
              samples,
              work.half};
    std::vector<HalfPixel::Group> groups(static_cast<std::size_t>(work.size * work.size));
    std::array<std::array<double, 3>, tile_size * tile_size> means;
    Counts counts;
    for (std::uint32_t b = 0; b < blocks; ++b) {
      tile.first_sample = first + b * samples;
      integrator_.render(tile, means, counts);
      if (interrupt_noted()) return;  // it may have been cut short
      for (std::size_t i = 0; i < groups.size(); ++i)
        groups[i][b] = means[i];
    }
    std::size_t i = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x)
        halves_[work.half][pixel(x, y)].add(groups[i++], samples);
    }
    const std::lock_guard lock(mutex_);
    counts_ += counts;
    const double done = static_cast<double>(counts_.paths);
    progress_(goal_.seconds ? elapsed() / *goal_.seconds : done / std::fmax(expected_paths_, done));
  }

  /// The mean luminance of the image, from the halves [begin, end).
  double mean_luminance(std::size_t begin, std::size_t end) const {
    CompensatedSum sum;
    for (std::size_t h = begin; h < end; ++h) {
      for (const HalfPixel& p : halves_[h])
        sum.add(p.estimate(3).mean());
    }
    return sum.value() / static_cast<double>((end - begin) * halves_[0].size());
  }

  /// From the first round, each half for itself: else the halves would not be independent.
  void set_floors() {
    for (std::size_t h = 0; h < 2; ++h)
      floors_[h] = floor_fraction * mean_luminance(h, h + 1);
  }

  /// The squared relative errors that the image would have if both halves were as this one.
  struct SquaredErrors {
    double mean = 0, worst = 0;
  };
  SquaredErrors errors(std::size_t unit, std::size_t half) const {
    const int x0 = static_cast<int>(unit) % columns_ * unit_size;
    const int y0 = static_cast<int>(unit) / columns_ * unit_size;
    const int x1 = std::min(x0 + unit_size, width_), y1 = std::min(y0 + unit_size, height_);
    SquaredErrors result;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const GroupedMean& seen = halves_[half][pixel(x, y)].seen();
        const double reference = std::fmax(seen.mean(), floors_[half]);
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
    const double n = levels_.end(level_);
    std::vector<std::array<SquaredErrors, 2>> found(units_.size());
    for (std::size_t unit = 0; unit < units_.size(); ++unit) {
      for (std::size_t half = 0; half < 2; ++half) {
        if (units_[unit].fell[half]) continue;
        found[unit][half] = errors(unit, half);
        units_[unit].noise[half] = n * found[unit][half].mean;
      }
    }
    double missing = 0;
    for (std::size_t unit = 0; unit < units_.size(); ++unit) {
      for (std::size_t half = 0; half < 2; ++half) {
        if (units_[unit].fell[half]) continue;
        const SquaredErrors& e = found[unit][half];
        const double mean = std::fmax(e.mean, noise_around(unit, half) / n);
        if (mean <= allowed && e.worst <= worst_excess * worst_excess * allowed) {
          units_[unit].fell[half] = true;
          finish(unit, 1 - half);
        } else {
          missing += still_missing(mean / allowed);
        }
      }
    }
    expected_paths_ = static_cast<double>(counts_.paths) + missing;
  }

  /// The mean noise of a unit and the eight around it, as one half's samples show it.
  double noise_around(std::size_t unit, std::size_t half) const {
    const int column = static_cast<int>(unit) % columns_, row = static_cast<int>(unit) / columns_;
    const int rows = static_cast<int>(units_.size()) / columns_;
    double sum = 0, count = 0;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y) {
      for (int x = std::max(column - 1, 0); x <= std::min(column + 1, columns_ - 1); ++x) {
        sum += units_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(x)]
                   .noise[half];
        ++count;
      }
    }
    return sum / count;
  }

  /// An estimate of the samples that a unit lacks, for the progress bar.
  double still_missing(double excess) const {
    const double n = levels_.end(level_), most = levels_.end(levels_.count() - 1);
    return unit_size * unit_size * (std::clamp(n * excess, 1.5 * n, std::fmax(most, 1.5 * n)) - n);
  }

  void finish(std::size_t unit, std::size_t half) {
    const int x0 = static_cast<int>(unit) % columns_ * unit_size;
    const int y0 = static_cast<int>(unit) / columns_ * unit_size;
    for (int y = y0; y < std::min(y0 + unit_size, height_); ++y) {
      for (int x = x0; x < std::min(x0 + unit_size, width_); ++x)
        halves_[half][pixel(x, y)].finish();
    }
  }

  void add_estimate(int x, int y, Film& film) const {
    const HalfPixel& a = halves_[0][pixel(x, y)];
    const HalfPixel& b = halves_[1][pixel(x, y)];
    std::array<double, 3> mean, error;
    for (std::size_t c = 0; c < 3; ++c) {
      const Estimate e = estimate(a, b, c);
      mean[c] = e.mean;
      error[c] = std::sqrt(e.variance);
    }
    const double samples = a.estimate(0).samples() + b.estimate(0).samples();
    if (samples > 0) film.set_estimate(x, y, mean, error, static_cast<std::uint64_t>(samples));
  }

  struct Estimate {
    double mean, variance;
  };
  /// (A + B) / 2, with weights that no sample has a say in; after an interruption the half that is.
  static Estimate estimate(const HalfPixel& a, const HalfPixel& b, std::size_t channel) {
    const GroupedMean& p = a.estimate(channel);
    const GroupedMean& q = b.estimate(channel);
    if (!(q.samples() > 0)) return {p.mean(), p.variance()};
    if (!(p.samples() > 0)) return {q.mean(), q.variance()};
    return {(p.mean() + q.mean()) / 2, (p.variance() + q.variance()) / 4};
  }

  /// The mean over the pixels of the probability that a normal error is within the target.
  double expected_within(double floor) const {
    double sum = 0;
    for (std::size_t i = 0; i < halves_[0].size(); ++i) {
      const Estimate e = estimate(halves_[0][i], halves_[1][i], 3);
      const double allowed = goal_.target * std::fmax(e.mean, floor);
      sum += e.variance > 0 ? std::erf(allowed / std::sqrt(2 * e.variance)) : 1;
    }
    return sum / static_cast<double>(halves_[0].size());
  }

  double capped() const {
    double count = 0;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x)
        count += unit_of(x, y).active() ? 1 : 0;
    }
    return count / static_cast<double>(halves_[0].size());
  }

  const Integrator& integrator_;
  int width_, height_;
  const AdaptiveGoal& goal_;
  const std::function<void(double)>& progress_;
  Levels levels_;
  int columns_;
  std::vector<Unit> units_;
  std::array<std::vector<HalfPixel>, 2> halves_;
  std::array<double, 2> floors_{};
  int level_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;  ///< guards counts_ and the calls of progress_
  Counts counts_;
  double expected_paths_ = 0;
};

}  // namespace

AdaptiveResult render_adaptively(const Integrator& integrator, int width, int height,
                                 double radiance_scale, const AdaptiveGoal& goal,
                                 const std::function<void(double)>& progress) {
  AdaptiveJob job(integrator, width, height, goal, progress);
  job.run();
  return job.result(radiance_scale);
}

}  // namespace carlo
