#include "grader/grade/class.h"

#include "cli/error.h"
#include "grader/grade/outputs.h"
#include "grader/judge/guardian.h"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

enum ExitCode { graded = 0, there_already = 10, failed = 1 };

/// The work of one child: a submission, from its files to its marks. Archives of strangers are
/// unpacked here, so that a spoilt one can end this process and no other.
ExitCode grade_one(const Course& course, const Source& source, const fs::path& out) {
  const Intake intake = take_in(source, course.labs);
  const std::optional<Record> earlier = load_record(out / source.name);
  if (earlier && earlier->complete() && earlier->name == source.name &&
      earlier->key == record_key(course, source.name, intake)) {
    return there_already;
  }
  // Nobody else may find it, and nobody else may pass: grade() opens it to this one's sandbox.
  std::string name = course.clean.path() / "at_work_XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw Error("{}: {}", name, std::strerror(errno));
  const fs::path folder = name;
  const Record record = grade(course, source.name, intake, folder);
  std::error_code ec;
  fs::remove_all(folder, ec);
  write_outputs(record, out / source.name);
  return graded;
}

/// Starts the process for one submission; it and all that it starts end when we do.
pid_t start(const Course& course, const Source& source, const fs::path& out) {
  return start_guarded([&]() -> int {
    // Ends what no other limit does, such as an archive that is slow to read.
    ::alarm(static_cast<unsigned>(3600 * (1 + course.labs.size())));
    try {
      return grade_one(course, source, out);
    } catch (const std::exception& error) {
      fmt::print(stderr, "carlo: {}: {}\n", source.name, error.what());
      return failed;
    }
  });
}

/// The record that a child has left, or one that tells of its failure.
Finished result_of(const Course& course, const Source& source, const fs::path& out, int status) {
  const bool again = WIFEXITED(status) && WEXITSTATUS(status) == there_already;
  if (again || (WIFEXITED(status) && WEXITSTATUS(status) == graded)) {
    if (std::optional<Record> record = load_record(out / source.name)) return {*record, again, 0};
  }
  const std::string why = WIFSIGNALED(status)
                              ? "its grader was killed: " + signal_name(WTERMSIG(status))
                              : std::string("its grader failed");
  const Record record = failed_record(course, source.name, why);
  write_outputs(record, out / source.name);
  return {record, false, 0};
}

}  // namespace

std::vector<Record> grade_class(const Course& course, const std::vector<Source>& sources,
                                const fs::path& out, int workers,
                                const std::function<void(const Finished&)>& tell) {
  struct Job {
    std::size_t index;
    Clock::time_point begun;
  };
  std::map<pid_t, Job> running;
  std::vector<Record> records(sources.size());
  std::size_t next = 0;
  while (next < sources.size() || !running.empty()) {
    while (next < sources.size() && running.size() < static_cast<std::size_t>(workers)) {
      running[start(course, sources[next], out)] = {next, Clock::now()};
      ++next;
    }
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, 0);
    const auto job = running.find(ended);
    if (job == running.end()) continue;
    Finished finished = result_of(course, sources[job->second.index], out, status);
    finished.record.source = sources[job->second.index].handed_in();
    finished.seconds = std::chrono::duration<double>(Clock::now() - job->second.begun).count();
    records[job->second.index] = finished.record;
    running.erase(job);
    tell(finished);
  }
  return records;
}

}  // namespace carlo::grader
