#include "grader/calibrate/runner.h"

#include "course/cli/descriptor.h"
#include "course/cli/program.h"
#include "course/cli/scratch_folder.h"
#include "course/verdict/verdict_json.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <map>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// Returns the path of a judge's output: "12.json" for the twelfth job.
fs::path file_of(const ScratchFolder& scratch, std::size_t job, const char* what) {
  return scratch.path() / fmt::format("{}.{}", job, what);
}

std::vector<std::string> command(const Job& job, const fs::path& verdicts) {
  // A busy machine must not look like a slow answer; processor time is limited in any case.
  // Solutions and mistakes are the tree's own: a sandbox around each of their workers changes no
  // verdict, and takes a third of all processor time.
  std::vector<std::string> words{job.subject.judge,
                                 "--lab",
                                 job.subject.lab_json,
                                 "--worker",
                                 job.subject.worker,
                                 "--seed",
                                 std::to_string(job.key.seed),
                                 "--deadline",
                                 "120",
                                 "--sandbox",
                                 "limits",
                                 "--json",
                                 verdicts};
  if (!job.subject.exercise.empty()) {
    words.emplace_back("--exercise");
    words.push_back(job.subject.exercise);
  }
  return words;
}

/// Starts a judge that ends with this program; its output goes to `said`.
pid_t start(const std::vector<std::string>& words, const fs::path& said) {
  const Descriptor output(::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  if (output.get() < 0) throw Error("cannot write {}: {}", said.string(), std::strerror(errno));
  return start_program(words,
                       {.output = output.get(), .error = output.get(), .ends_with_us = true});
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// The running judges, by process; those left at the end are killed.
class Judges {
 public:
  ~Judges() {
    for (const auto& [pid, job] : jobs_) {
      ::kill(pid, SIGKILL);
      ::waitpid(pid, nullptr, 0);
    }
  }
  Judges() = default;
  Judges(const Judges&) = delete;
  Judges& operator=(const Judges&) = delete;

  std::size_t count() const { return jobs_.size(); }
  void add(pid_t pid, std::size_t job) { jobs_[pid] = job; }

  /// Waits for one to end and sets `status` and `usage`. Returns its job.
  std::size_t next(int& status, rusage& usage) {
    const pid_t pid = ::wait4(-1, &status, 0, &usage);
    const auto found = jobs_.find(pid);
    if (found == jobs_.end()) throw Error("lost sight of a judge: {}", std::strerror(errno));
    const std::size_t job = found->second;
    jobs_.erase(found);
    return job;
  }

 private:
  std::map<pid_t, std::size_t> jobs_;
};

/// Returns when the programs of a subject were last built.
fs::file_time_type built(const Subject& subject) {
  return std::max(fs::last_write_time(subject.judge), fs::last_write_time(subject.worker));
}

Record record_of(const Job& job, int status, const rusage& usage, const fs::path& verdicts,
                 const fs::path& said) {
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code != 0 && code != 1) throw Error("a judge ended badly: {}", read_file(said));
  if (!fs::exists(verdicts)) throw Error("a judge gave no verdicts: {}", read_file(said));
  constexpr double kilobytes = 1024;
  LabResult result = lab_result_from_text(read_file(verdicts));
  if (result.cut) throw Error("a judge's verdicts are too large to be kept whole");
  return {job.key, code, seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<double>(usage.ru_maxrss) / kilobytes, kept_of(std::move(result))};
}

}  // namespace

void run_jobs(const std::vector<Job>& jobs, int at_once,
              const std::function<void(const Record&)>& done) {
  ::setpriority(PRIO_PROCESS, 0, 19);
  const ScratchFolder scratch;
  const fs::file_time_type begun = fs::file_time_type::clock::now();
  Judges judges;
  for (std::size_t next = 0; next < jobs.size() || judges.count() > 0;) {
    if (next < jobs.size() && judges.count() < static_cast<std::size_t>(at_once)) {
      const fs::path verdicts = file_of(scratch, next, "json");
      judges.add(start(command(jobs[next], verdicts), file_of(scratch, next, "said")), next);
      ++next;
      continue;
    }
    int status = 0;
    rusage usage{};
    const std::size_t ended = judges.next(status, usage);
    const fs::path verdicts = file_of(scratch, ended, "json"),
                   said = file_of(scratch, ended, "said");
    if (built(jobs[ended].subject) > begun) {
      throw Error("{} or its judge was built anew meanwhile: start again",
                  jobs[ended].subject.worker.string());
    }
    done(record_of(jobs[ended], status, usage, verdicts, said));
    fs::remove(verdicts);
    fs::remove(said);
  }
}

}  // namespace carlo::grader
