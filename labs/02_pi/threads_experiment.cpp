#include "experiments.h"
#include "pi.h"
#include "support/wall_clock.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <numbers>
#include <thread>

// Threads against time, and the bits of the sums.

namespace lab02 {
namespace {

struct Run {
  int threads = 1;
  Sums sums;
  double seconds = 1e9;  ///< the best of several
};

std::vector<int> thread_counts() {
  std::vector<int> counts = {1, 2, 3, 4, 8};
  const int here = static_cast<int>(std::thread::hardware_concurrency());
  if (here > 8) counts.push_back(here);
  return counts;
}

Run time_threads(int threads, std::int64_t n, std::uint64_t seed, int repetitions) {
  Run run{threads, {}};
  for (int i = 0; i < repetitions; ++i) {
    const carlo::WallClock clock;
    run.sums = sum_in_parallel(sum_circle, n, seed, threads);
    run.seconds = std::min(run.seconds, clock.seconds());
  }
  return run;
}

carlo::Table runs_table(const std::vector<Run>& runs) {
  carlo::Table table({"threads", "N", "estimate", "error", "bits of the sum", "time", "speed-up"},
                     {"threads", "points", "estimate", "error", "bits", "seconds", "speed_up"});
  for (const Run& run : runs) {
    const double estimate = mean_of(run.sums).value;
    const double speed_up = runs.front().seconds / run.seconds;
    table.add_row({run.threads, run.sums.count,
                   carlo::Cell(fmt::format("{:.15g}", estimate), estimate),
                   estimate - std::numbers::pi,
                   fmt::format("{:016x}", std::bit_cast<std::uint64_t>(run.sums.sum)),
                   carlo::seconds_cell(run.seconds),
                   carlo::Cell(fmt::format("{:.2f} ×", speed_up), speed_up)});
  }
  return table;
}

carlo::Chart threads_chart(const std::vector<Run>& runs) {
  carlo::Chart chart{
      "Threads against time",
      fmt::format("this machine runs {} at once", std::thread::hardware_concurrency()),
      {"threads", carlo::Unit::count},
      {"time", carlo::Unit::seconds},
      {{"measured", {}}, {"one thread's time shared out", {}}}};
  for (const Run& run : runs) {
    chart.series[0].points.push_back({double(run.threads), run.seconds});
    chart.series[1].points.push_back({double(run.threads), runs.front().seconds / run.threads});
  }
  return chart;
}

}  // namespace

void threads_experiment(Notebook& notebook) {
  notebook.begin("Many threads, the same bits");
  // Called here for a missing exercise to be reported outside the threads, where nothing is lost.
  const auto nothing = [](std::int64_t n, carlo::Rng&) { return Sums{n, 0, 0}; };
  if (!notebook.attempt([&] { (void)sum_in_parallel(nothing, 1, 1, 1); })) return;
  notebook.attempt([&] {
    carlo::Rng rng = notebook.rng();
    (void)mean_of(sum_circle(2, rng));
    const std::int64_t n = notebook.options().n * 16 + 1;
    const std::vector<int> counts = thread_counts();
    std::vector<Run> runs;
    for (const int threads : counts) {
      notebook.progress(static_cast<double>(runs.size()), static_cast<double>(counts.size()));
      runs.push_back(time_threads(threads, n, notebook.options().seed, notebook.repetitions(16)));
    }
    const bool same = std::all_of(runs.begin(), runs.end(), [&](const Run& run) {
      return std::bit_cast<std::uint64_t>(run.sums.sum) ==
             std::bit_cast<std::uint64_t>(runs.front().sums.sum);
    });
    notebook.say(
        same ? "Chunk i draws from stream i whoever works on it, and the chunks are added up in "
               "their order: the sums agree to the last bit. More threads than the machine has "
               "cores gain nothing."
             : "The sums are not the same for all numbers of threads: see the column of bits.");
    notebook.table("threads", runs_table(runs), "4 √(1 − x²) by Lab 2.6, the best time of each");
    notebook.charts({threads_chart(runs)});
  });
}

}  // namespace lab02
