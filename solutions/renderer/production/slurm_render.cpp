#include "renderer/production/slurm_render.h"

#include "course/slurm/array_job.h"
#include "course/slurm/folder_lock.h"
#include "render/interrupt.h"
#include "support/error.h"
#include "support/progress.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using slurm::FolderLock;
using Seconds = std::chrono::duration<double>;

/// Signals a task before its time limit, so that it can write its part and be queued again; Slurm's
/// resolution is a minute.
constexpr const char* time_is_up = "USR1@60";
/// A waiting process asks Slurm with pauses that grow up to this many seconds, and opens at most so
/// many parts per second.
constexpr double longest_pause = 10, parts_a_second = 50;
/// This many failed questions to Slurm in a row are an error.
constexpr int unanswered = 30;

FolderLock lock_of(const fs::path& folder) {
  // Others hold the lock during a submission.
  for (int tries = 0; tries < 600; ++tries) {
    if (auto lock = FolderLock::take(folder, FolderLock::Use::alone)) return std::move(*lock);
    std::this_thread::sleep_for(Seconds(.1));
  }
  throw Error("{} is locked by {}, for a minute now", folder.string(), FolderLock::holder(folder));
}

std::string merge_name(const SlurmPlan& plan) {
  return plan.jobs + "_merge";
}

std::vector<std::string> command(const SlurmFolder& folder, const SlurmPlan& plan,
                                 const char* option) {
  std::vector<std::string> words{folder.program().string(), option, folder.path().string()};
  words.insert(words.end(), plan.words.begin(), plan.words.end());
  return words;
}

/// Returns the array's id; nothing if another array of this render exists, submitted by a process
/// on a machine whose locks do not reach ours.
std::string submit_tasks(const SlurmFolder& folder, const SlurmPlan& plan,
                         const std::vector<int>& shards) {
  std::string id = slurm::submit({.name = plan.jobs,
                                  .folder = folder.output_of_tasks(),
                                  .command = command(folder, plan, "--slurm-task"),
                                  .processors = plan.threads,
                                  .time = plan.time,
                                  .partition = plan.partition,
                                  .numbers = slurm::array_numbers(shards),
                                  .signal = time_is_up,
                                  .start = plan.start});
  for (const std::string& other : slurm::jobs_named(plan.jobs).ids) {
    if (std::stoul(other) >= std::stoul(id)) continue;
    slurm::cancel(id);
    return {};
  }
  return id;
}

void submit_merge(const SlurmFolder& folder, const SlurmPlan& plan, const std::string& after) {
  slurm::submit({.name = merge_name(plan),
                 .folder = folder.output_of_merge(),
                 .command = command(folder, plan, "--slurm-merge"),
                 .partition = plan.partition,
                 .after = after,
                 .start = plan.start});
}

/// Returns the last line that a job wrote.
std::string last_line(const fs::path& path) {
  std::ifstream in(path);
  std::string line, last;
  while (std::getline(in, line)) {
    if (!line.empty()) last = line;
  }
  return last.empty() ? "nothing" : last;
}

[[noreturn]] void fail_stuck(SlurmFolder& folder, const SlurmPlan& plan) {
  const SlurmFolder::State state = folder.look(plan);
  const fs::path log = state.missing.empty()
                           ? folder.output_of_merge() / "1.txt"
                           : folder.output_of_tasks() / fmt::format("{}.txt", state.missing[0]);
  const std::string what = state.missing.empty()
                               ? "the merge"
                               : fmt::format("{} of {} shards, the first of them {},",
                                             state.missing.size(), plan.shards, state.missing[0]);
  throw Error("{} came to nothing, and Slurm has ended the jobs; the last word in {}: {}", what,
              log.string(), last_line(log));
}

/// Throws Error unless the render that was begun is this one.
void require_same(const SlurmFolder& folder, const SlurmPlan& then, const SlurmRender& now) {
  const auto require = [&](const std::string& name, const std::string& a, const std::string& b) {
    if (a == b) return;
    throw Error(
        "cannot continue {}: its {} is {}, this render's {}; remove it, or name another image "
        "with -o",
        folder.path().string(), name, a, b);
  };
  for (const auto& [name, value] : now.plan.settings) {
    const auto at = then.settings.find(name);
    require(name, at == then.settings.end() ? "" : at->second, value);
  }
  require("film", fmt::format("{} x {}", then.width, then.height),
          fmt::format("{} x {}", now.plan.width, now.plan.height));
  if (now.tasks_given)
    require("number of tasks", std::to_string(then.shards), std::to_string(now.plan.shards));
}

/// Returns the plan of the render that was begun, updated with the new request; begins it if there
/// is none.
SlurmPlan settle_plan(SlurmFolder& folder, const SlurmRender& render) {
  const FolderLock lock = lock_of(folder.path());
  SlurmPlan plan = render.plan;
  if (const auto begun = folder.plan()) {
    require_same(folder, *begun, render);
    plan.shards = begun->shards;
    plan.jobs = begun->jobs;
    plan.light_paths = begun->light_paths;
    folder.write(plan);
  } else {
    plan.jobs = slurm::job_name("render", folder.path());
    folder.begin(plan);
  }
  return plan;
}

/// Waits for the jobs, and submits failed work again as long as there is progress.
class Waiting {
 public:
  Waiting(SlurmFolder& folder, const SlurmPlan& plan, bool quiet)
      : folder_(folder), plan_(plan), progress_("rendering", !quiet) {}

  /// Returns the report; nothing after Ctrl-C.
  std::optional<std::string> run() {
    const InterruptGuard guard;
    while (true) {
      if (auto report = folder_.done()) return report;
      if (interrupt_noted()) return {};
      if (!jobs_there() && !folder_.done() &&
          advance_on_slurm(folder_, false) == SlurmStep::stuck) {
        progress_.clear();
        fail_stuck(folder_, plan_);
      }
      show();
      pause();
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool jobs_there() {
    try {
      const bool there = slurm::jobs_named(plan_.jobs + "," + merge_name(plan_)).any();
      silent_ = 0;
      return there;
    } catch (const Error&) {
      if (++silent_ == unanswered) throw;
      return true;
    }
  }

  void show() {
    if (Clock::now() < next_look_) return;
    const auto blocks = static_cast<double>(folder_.look(plan_).blocks);
    progress_.update(blocks / plan_.all_blocks());
    next_look_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                    Seconds(std::max(2.0, plan_.shards / parts_a_second)));
  }

  void pause() {
    const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(pause_));
    while (Clock::now() < until && !interrupt_noted())
      std::this_thread::sleep_for(Seconds(.1));
    pause_ = std::min(1.3 * pause_, longest_pause);
  }

  SlurmFolder& folder_;
  const SlurmPlan& plan_;
  Progress progress_;
  double pause_ = .5;
  int silent_ = 0;
  Clock::time_point next_look_{};
};

}  // namespace

SlurmStep advance_on_slurm(SlurmFolder& folder, bool asked_for, const std::string& but_for) {
  const FolderLock lock = lock_of(folder.path());
  if (folder.done()) return SlurmStep::done;
  const auto plan = folder.plan();
  if (!plan) throw Error("{} has no plan of a render", folder.path().string());
  const std::vector<std::string> tasks = slurm::jobs_named(plan->jobs).ids;
  std::vector<std::string> merges = slurm::jobs_named(merge_name(*plan)).ids;
  std::erase(merges, but_for);
  if (!merges.empty()) return SlurmStep::under_way;
  std::string after = fmt::format("{}", fmt::join(tasks, ":"));
  if (tasks.empty()) {
    const SlurmFolder::State state = folder.look(*plan);
    if (!asked_for && folder.submitted() == state.blocks) return SlurmStep::stuck;
    if (!state.missing.empty()) {
      after = submit_tasks(folder, *plan, state.missing);
      if (after.empty()) return SlurmStep::under_way;
    }
    folder.set_submitted(state.blocks);
  }
  submit_merge(folder, *plan, after);
  return SlurmStep::submitted;
}

int render_on_slurm(SlurmFolder& folder, SlurmRender render) {
  slurm::need_slurm();
  std::error_code none;
  fs::create_directories(folder.path(), none);
  if (none) throw Error("cannot make {}: {}", folder.path().string(), none.message());
  const SlurmPlan plan = settle_plan(folder, render);
  const SlurmStep step = advance_on_slurm(folder, true);
  const auto tell = [&](const std::string& text) {
    if (!render.quiet) fmt::print("{}", text);
  };
  if (step != SlurmStep::done) {
    tell(fmt::format("  {:<16} {} shards, {}; jobs are called {} and {}\n", "slurm", plan.shards,
                     step == SlurmStep::submitted ? "submitted" : "under way already", plan.jobs,
                     merge_name(plan)));
  }
  if (!render.wait && step != SlurmStep::done) {
    tell(
        fmt::format("  {:<16} the same command, without --no-wait or again with it, tells how far "
                    "it is and continues after failures\n",
                    "later"));
    return 0;
  }
  const auto report = Waiting(folder, plan, render.quiet).run();
  if (!report) {
    fmt::print(stderr,
               "no longer waiting; the jobs continue: the same command waits again, scancel --me "
               "--name {},{} ends them\n",
               plan.jobs, merge_name(plan));
    return 130;
  }
  tell(*report);
  return 0;
}

}  // namespace carlo
