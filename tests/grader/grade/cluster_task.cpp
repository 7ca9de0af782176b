#include "grader/grade/class.h"
#include "grader/grade/on_cluster.h"
#include "grader/grade/summary.h"
#include "support/error.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <thread>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;
using slurm::FolderLock;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

int task_number(const ClusterPlan& plan) {
  const std::string text = variable("SLURM_ARRAY_TASK_ID");
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || *end != 0 || number < 1 || number > plan.tasks) {
    throw Error("SLURM_ARRAY_TASK_ID is '{}', expected a task of the plan, 1 to {}", text,
                plan.tasks);
  }
  return number;
}

/// Returns the node's name in Slurm.
std::string node_name() {
  std::string name = variable("SLURMD_NODENAME");
  if (!name.empty()) return name;
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) throw Error("this node has no name");
  return host.data();
}

/// Takes the lock shared with other tasks, but not while a submitting process holds it alone, which
/// it does only briefly.
FolderLock take_together(const fs::path& out) {
  for (int attempt = 0; attempt < 1200; ++attempt) {
    if (std::optional<FolderLock> lock = FolderLock::take(out, FolderLock::Use::together))
      return std::move(*lock);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
  throw Error("{}: {} is at work there", out.string(), FolderLock::holder(out));
}

/// Ignores a TMPDIR of the submitting machine that does not exist here.
void use_own_temporary_folder() {
  std::error_code ec;
  if (!fs::is_directory(variable("TMPDIR"), ec)) ::unsetenv("TMPDIR");
}

/// Throws Error unless this node sees the files that it must read.
void see_files(const ClusterPlan& plan) {
  std::vector<fs::path> paths{plan.settings.tree, plan.settings.build};
  if (!plan.sources.empty()) paths.push_back(plan.sources.front().path);
  for (const fs::path& path : paths) {
    if (!fs::exists(path)) throw Error("it does not see {}: is the folder shared?", path.string());
  }
}

/// Everything that a node needs to grade.
class Workplace {
 public:
  /// Throws Error about this node.
  explicit Workplace(const ClusterPlan& plan)
      : labs_((see_files(plan), course_labs(plan.settings.tree / "labs", plan.settings.labs))),
        clean_(plan.settings.tree, plan.settings.build, labs_),
        sandbox_(sandbox_of(plan.settings, clean_)),
        course_(course_of(plan.settings, labs_, clean_, sandbox_)) {
    if (course_.toolchain != plan.toolchain) {
      throw Error("it compiles with \"{}\", and the class was submitted with \"{}\"",
                  course_.toolchain, plan.toolchain);
    }
  }

  const Course& course() const { return course_; }

 private:
  std::vector<CourseLab> labs_;
  CleanTree clean_;
  Sandbox sandbox_;
  Course course_;
};

Workplace make_workplace(const ClusterPlan& plan) {
  try {
    return Workplace(plan);
  } catch (const std::exception& error) {
    refuse_node(plan.settings.out, {node_name(), error.what()});
    throw Error("{} grades nobody: {}", node_name(), error.what());
  }
}

}  // namespace

int run_cluster_task(const fs::path& file) {
  use_own_temporary_folder();
  const ClusterPlan plan = read_plan(file);
  const int number = task_number(plan);
  const FolderLock lock = take_together(plan.settings.out);
  const Workplace place = make_workplace(plan);
  const Course& course = place.course();
  if (course.digest != plan.digest) {
    throw Error("the grader was built anew since the class was submitted: type the command again");
  }
  const std::vector<Source> mine = plan.share(number);
  fmt::print("{}: {} submissions, sandbox: {}\n", node_name(), mine.size(),
             course.sandbox.description());
  const auto tell = [](const Finished& finished) {
    fmt::print("{}", line_of(finished));
    std::fflush(stdout);
  };
  const std::vector<Record> records =
      grade_class(course, mine, plan.settings.out, plan.workers, tell);
  return std::all_of(records.begin(), records.end(),
                     [](const Record& record) { return record.complete(); })
             ? 0
             : 1;
}

}  // namespace carlo::grader
