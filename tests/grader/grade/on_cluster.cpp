#include "grader/grade/on_cluster.h"

#include "course/slurm/array_job.h"
#include "grader/grade/class.h"
#include "support/error.h"
#include "support/progress.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <system_error>
#include <thread>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;
using slurm::FolderLock;
using slurm::Jobs;
using Clock = std::chrono::steady_clock;

/// A submission, the files that it writes, its judge and its compiler.
constexpr int megabytes_of_one = 2500;

/// Starting a task costs a node some seconds and reads the build, so a task has ten submissions if
/// there are many; Slurm's default (MaxArraySize) allows no more tasks than this.
int good_tasks(std::size_t submissions) {
  const auto count = static_cast<int>(submissions);
  return std::min({count, std::max(16, (count + 9) / 10), 1000});
}

/// The controller may be away for a while: retries for some minutes.
Jobs ask(const std::string& name) {
  for (int attempt = 0;; ++attempt) {
    try {
      return slurm::jobs_named(name);
    } catch (const Error&) {
      if (attempt == 20) throw;
      if (attempt == 0) fmt::print(stderr, "carlo: Slurm does not answer; it is asked again ...\n");
      std::this_thread::sleep_for(std::chrono::seconds(10));
    }
  }
}

/// Determines which of an array's submissions have been graded since it was planned.
class Fresh {
 public:
  explicit Fresh(const fs::path& out) : out_(out) {
    std::error_code ec;
    planned_at_ = fs::last_write_time(plan_file(out), ec);
    for (const Source& source : read_plan(plan_file(out)).sources)
      left_.insert(source.name);
    total_ = left_.size();
  }

  std::size_t total() const { return total_; }

  std::size_t count() {
    std::erase_if(left_, [&](const std::string& name) {
      std::error_code ec;
      const auto written = fs::last_write_time(out_ / name / "record.json", ec);
      return !ec && written >= planned_at_;
    });
    return total_ - left_.size();
  }

 private:
  fs::path out_;
  fs::file_time_type planned_at_;
  std::set<std::string> left_;
  std::size_t total_ = 0;
};

std::string in_words(const Jobs& jobs) {
  std::string text = fmt::format("{} tasks at work", jobs.running);
  if (jobs.waiting > 0) text += fmt::format(", {} wait ({})", jobs.waiting, jobs.reason);
  return text;
}

/// Waits until no job of that name is left.
void wait_for_jobs(const std::string& name, const fs::path& out) {
  constexpr std::chrono::seconds quiet{30};
  constexpr std::chrono::duration<double> least_pause{0.5}, longest_pause{10};
  Fresh fresh(out);
  Progress progress("grading", true);
  std::string told;
  Clock::time_point told_at = Clock::now() - quiet;
  const Clock::time_point begun = Clock::now();
  for (;;) {
    const Jobs jobs = ask(name);
    if (!jobs.any()) return;
    const std::size_t done = fresh.count();
    const std::string line =
        fmt::format("{} of {} graded; {}", done, fresh.total(), in_words(jobs));
    if (line != told && Clock::now() - told_at >= quiet) {
      progress.clear();
      fmt::print(stderr, "carlo: {}\n", line);
      told = line;
      told_at = Clock::now();
    }
    progress.update(static_cast<double>(done) /
                    static_cast<double>(std::max<std::size_t>(1, fresh.total())));
    // Short classes should not be delayed, and long ones should not keep Slurm busy.
    const std::chrono::duration<double> waited = Clock::now() - begun;
    std::this_thread::sleep_for(std::clamp(waited / 20, least_pause, longest_pause));
  }
}

/// Takes the folder's exclusive lock, waiting for its holder.
FolderLock take_alone(const fs::path& out) {
  for (bool told = false;; told = true) {
    if (std::optional<FolderLock> lock = FolderLock::take(out, FolderLock::Use::alone))
      return std::move(*lock);
    if (!told)
      fmt::print(stderr, "carlo: waiting for {}, which is at work in {} ...\n",
                 FolderLock::holder(out), out.string());
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
}

void tell_refused(const std::vector<RefusedNode>& nodes) {
  for (const RefusedNode& node : nodes)
    fmt::print(stderr, "carlo: {} has graded nobody: {}\n", node.name, node.why);
}

/// The work left when an array was submitted.
struct Before {
  std::size_t missing = 0, refused = 0;
};

class Rounds {
 public:
  Rounds(const Course& course, const Settings& settings, const std::vector<Source>& sources,
         const ClusterOptions& options)
      : course_(course),
        settings_(settings),
        sources_(sources),
        options_(options),
        name_(slurm::job_name("carlo_grade", settings.out)) {}

  std::optional<ClusterClass> run() {
    std::optional<Before> before;
    for (;;) {
      if (!wait()) return later();
      FolderLock lock = take_alone(settings_.out);
      // Another process may have submitted while we waited for the lock.
      if (ask(name_).any()) continue;
      const Survey survey = look();
      const std::vector<RefusedNode> refused = refused_nodes(settings_.out);
      const bool nothing_new =
          before && survey.missing.size() >= before->missing && refused.size() <= before->refused;
      if (survey.missing.empty() || nothing_new) {
        tell_refused(refused);
        return ClusterClass{std::move(lock), with_failures(survey)};
      }
      submit(survey.missing, refused);
      if (!options_.wait) return later();
      before = {survey.missing.size(), refused.size()};
    }
  }

 private:
  struct Survey {
    std::vector<std::optional<Record>> records;
    std::vector<Source> missing;
  };

  /// Prints the command for later, when there is nothing to wait for now.
  std::nullopt_t later() const {
    fmt::print("the same command, later, writes {}, or submits what is missing then\n",
               (settings_.out / "class.csv").string());
    return std::nullopt;
  }

  /// Waits until no task is left. Returns false if some are left, but waiting is off.
  bool wait() const {
    const Jobs jobs = ask(name_);
    if (!jobs.any()) return true;
    if (!options_.wait) {
      fmt::print("job {}: {}\n", fmt::join(jobs.ids, ", "), in_words(jobs));
      return false;
    }
    fmt::print(stderr,
               "carlo: waiting for job {} (Ctrl-C leaves it at work, scancel {} then ends it)\n",
               fmt::join(jobs.ids, ", "), fmt::join(jobs.ids, " "));
    wait_for_jobs(name_, settings_.out);
    return true;
  }

  Survey look() const {
    const int workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    Survey survey{survey_class(course_, sources_, settings_.out, workers), {}};
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (!survey.records[i]) survey.missing.push_back(sources_[i]);
    }
    return survey;
  }

  void submit(const std::vector<Source>& missing, const std::vector<RefusedNode>& refused) const {
    ClusterPlan plan{settings_, course_.toolchain, course_.digest, 1, options_.workers, missing};
    plan.settings.sandbox = to_string(course_.sandbox.level());
    plan.tasks = std::min(static_cast<int>(missing.size()),
                          options_.tasks > 0 ? options_.tasks : good_tasks(missing.size()));
    write_plan(plan);
    slurm::ArrayJob job{name_, cluster_folder(settings_.out)};
    job.command = {fs::read_symlink("/proc/self/exe").string(), "--task",
                   plan_file(settings_.out).string()};
    job.tasks = plan.tasks;
    job.processors = options_.workers;
    job.megabytes = megabytes_of_one;
    job.time = options_.time;
    job.partition = options_.partition;
    for (const RefusedNode& node : refused)
      job.excluded.push_back(node.name);
    const std::string id = slurm::submit(job);
    fmt::print("job {}: {} tasks for {} submissions; what they say: {}\n", id, plan.tasks,
               missing.size(), (job.folder / "*.txt").string());
    std::fflush(stdout);
  }

  std::vector<Record> with_failures(const Survey& survey) const {
    std::vector<Record> records;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      records.push_back(survey.records[i].value_or(failed_record(
          course_, sources_[i].name,
          "no task of the cluster has graded it; why not, may stand in .slurm/*.txt")));
      records.back().source = sources_[i].handed_in();
    }
    return records;
  }

  const Course& course_;
  const Settings& settings_;
  const std::vector<Source>& sources_;
  const ClusterOptions& options_;
  std::string name_;
};

}  // namespace

Sandbox sandbox_for_nodes(const Settings& settings, const CleanTree& clean) {
  if (settings.sandbox != "auto") return Sandbox::as_found(level_of(settings.sandbox), {});
  const Sandbox here = sandbox_of(settings, clean);
  if (here.level() == Level::limits) {
    throw Error(
        "no sandbox here to hold the nodes to: say --sandbox bubblewrap or landlock, as "
        "./carlo grade --check-machine says on a node");
  }
  return Sandbox::as_found(here.level(), {});
}

std::optional<ClusterClass> grade_on_cluster(const Course& course, const Settings& settings,
                                             const std::vector<Source>& sources,
                                             const ClusterOptions& options) {
  slurm::need_slurm();
  fs::create_directories(cluster_folder(settings.out));
  return Rounds(course, settings, sources, options).run();
}

}  // namespace carlo::grader
