#include "grader/grade/class.h"

#include "grader/grade/outputs.h"
#include "grader/judge/guardian.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/wall_clock.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;
enum ExitCode { graded = 0, there_already = 10, not_there = 11, failed = 1 };

/// A file server's client may cache a folder's content for a minute; opening the folder makes it
/// ask again.
void refresh(const fs::path& folder) {
  std::error_code ec;
  const fs::directory_iterator opened(folder, ec);
}

/// Returns whether this submission has its marks.
bool has_marks(const Course& course, const Source& source, const Intake& intake,
               const fs::path& out) {
  refresh(out / source.name);
  const std::optional<Record> earlier = load_record(out / source.name);
  return earlier && earlier->complete() && earlier->name == source.name &&
         earlier->key == record_key(course, source.name, intake);
}

/// The work of one child: a submission, from its files to its marks. Strangers' archives are
/// unpacked here, so that a corrupt one can only end this process.
int grade_one(const Course& course, const Source& source, const fs::path& out) {
  const Intake intake = take_in(source, course.labs);
  if (has_marks(course, source, intake, out)) return there_already;
  // Nobody else may find or enter it: grade() opens it to this submission's sandbox.
  std::string name = course.clean.path() / "at_work_XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw Error("{}: {}", name, std::strerror(errno));
  const fs::path folder = name;
  const Record record = grade(course, source.name, intake, folder);
  std::error_code ec;
  fs::remove_all(folder, ec);
  write_outputs(record, out / source.name);
  return graded;
}

/// The work of one child that only reads.
int look_at(const Course& course, const Source& source, const fs::path& out) {
  return has_marks(course, source, take_in(source, course.labs), out) ? there_already : not_there;
}

/// The same for the texts that are compared. What is no UTF-8 is replaced.
int write_text(const Course& course, const Source& source, const fs::path& to) {
  const Intake intake = take_in(source, course.labs);
  nlohmann::json text;
  for (const CourseLab& lab : course.labs) {
    const auto found = intake.labs.find(lab.lab.number);
    const LabFiles files = found == intake.labs.end() ? LabFiles{} : found->second;
    text[lab.folder] = {{"files", files.files}, {"refused", !files.problems.empty()}};
  }
  write_file(to / ("of_" + source.name + ".json"),
             text.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
  return graded;
}

using Work = int (*)(const Course&, const Source&, const fs::path&);

/// Starts the process for one submission; it and all that it starts end with this process.
pid_t start(Work work, const Course& course, const Source& source, const fs::path& out) {
  return start_guarded([&]() -> int {
    // Ends what no other limit covers, such as an archive that is slow to read.
    ::alarm(static_cast<unsigned>(3600 * (1 + course.labs.size())));
    try {
      return work(course, source, out);
    } catch (const std::exception& error) {
      fmt::print(stderr, "carlo: {}: {}\n", source.name, error.what());
      return failed;
    }
  });
}

/// Returns the record that a child has left, or one that reports its failure.
Finished result_of(const Course& course, const Source& source, const fs::path& out, int status) {
  const bool again = WIFEXITED(status) && WEXITSTATUS(status) == there_already;
  if (again || (WIFEXITED(status) && WEXITSTATUS(status) == graded)) {
    if (std::optional<Record> record = load_record(out / source.name)) return {*record, again, 0};
  }
  const std::string why = WIFSIGNALED(status)
                              ? "its grader was killed: " + signal_name(WTERMSIG(status))
                              : std::string("its grader failed");
  const Record record = failed_record(course, source.name, why);
  try {
    write_outputs(record, out / source.name);
  } catch (const std::exception& error) {
    // A full disk, for instance. The others' marks may still find room; this one has none in either
    // case.
    fmt::print(stderr, "carlo: {}: {}\n", source.name, error.what());
  }
  return {record, false, 0};
}

/// Processes some of the submissions, `workers` at a time.
class Round {
 public:
  /// Called for each submission with its index, its child's status and the seconds that it took.
  using Tell = std::function<void(std::size_t, int, double)>;

  Round(Work work, const Course& course, const std::vector<Source>& sources, const fs::path& out)
      : work_(work), course_(course), sources_(sources), out_(out) {}

  void run(const std::vector<std::size_t>& indices, std::size_t workers, const Tell& tell) {
    std::size_t next = 0;
    while (next < indices.size() || !running_.empty()) {
      while (next < indices.size() && running_.size() < workers && begin(indices[next]))
        ++next;
      end_one(tell);
    }
  }

 private:
  struct Job {
    std::size_t index;
    WallClock clock;
  };

  /// Returns false if the machine has no process left for it; then one of ours must end first.
  bool begin(std::size_t index) {
    try {
      running_[start(work_, course_, sources_[index], out_)] = {index, {}};
      return true;
    } catch (const Error&) {
      if (running_.empty()) throw;
      return false;
    }
  }

  void end_one(const Tell& tell) {
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, 0);
    const auto job = running_.find(ended);
    if (job == running_.end()) return;
    const auto [index, clock] = job->second;
    running_.erase(job);
    tell(index, status, clock.seconds());
  }

  Work work_;
  const Course& course_;
  const std::vector<Source>& sources_;
  fs::path out_;
  std::map<pid_t, Job> running_;
};

std::vector<std::size_t> all_of(const std::vector<Source>& sources) {
  std::vector<std::size_t> all(sources.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

std::vector<Record> grade_class(const Course& course, const std::vector<Source>& sources,
                                const fs::path& out, int workers,
                                const std::function<void(const Finished&)>& tell) {
  Round round(grade_one, course, sources, out);
  std::vector<Record> records(sources.size());
  std::vector<std::size_t> again;
  const auto finish = [&](std::size_t i, int status, double seconds) {
    Finished finished = result_of(course, sources[i], out, status);
    finished.record.source = sources[i].handed_in();
    finished.seconds = seconds;
    records[i] = finished.record;
    return finished;
  };
  round.run(all_of(sources), static_cast<std::size_t>(workers),
            [&](std::size_t i, int status, double seconds) {
              const Finished finished = finish(i, status, seconds);
              if (finished.record.complete()) {
                tell(finished);
              } else {
                again.push_back(i);
              }
            });
  // The machine may have enough resources for fewer at a time.
  const auto fewer = static_cast<std::size_t>(std::max(1, workers / 8));
  round.run(again, fewer,
            [&](std::size_t i, int status, double seconds) { tell(finish(i, status, seconds)); });
  return records;
}

std::vector<std::optional<Record>> survey_class(const Course& course,
                                                const std::vector<Source>& sources,
                                                const fs::path& out, int workers) {
  refresh(out);
  std::vector<std::optional<Record>> records(sources.size());
  Round(look_at, course, sources, out)
      .run(all_of(sources), static_cast<std::size_t>(workers),
           [&](std::size_t i, int status, double) {
             if (!WIFEXITED(status) || WEXITSTATUS(status) != there_already) return;
             records[i] = load_record(out / sources[i].name);
             if (records[i]) records[i]->source = sources[i].handed_in();
           });
  return records;
}

void write_texts(const Course& course, const std::vector<Source>& sources, const fs::path& to,
                 int workers) {
  Round(write_text, course, sources, to)
      .run(all_of(sources), static_cast<std::size_t>(workers), [](std::size_t, int, double) {});
}

}  // namespace carlo::grader
