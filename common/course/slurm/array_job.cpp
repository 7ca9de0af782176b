#include "course/slurm/array_job.h"

#include "course/cli/program.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/quotes.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <sstream>

namespace carlo::slurm {
namespace {

namespace fs = std::filesystem;

/// Escapes a path so that Slurm replaces nothing in it.
std::string literal(const fs::path& path) {
  std::string text;
  for (const char c : path.string())
    text += c == '%' ? "%%" : std::string(1, c);
  return text;
}

bool is_program(const std::string& name) {
  std::istringstream folders(std::getenv("PATH") == nullptr ? "" : std::getenv("PATH"));
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((fs::path(folder) / name).c_str(), X_OK) == 0) return true;
  }
  return false;
}

/// Returns the options that no variable may override, for the command line.
std::vector<std::string> sbatch_words(const ArrayJob& job, const fs::path& script) {
  std::vector<std::string> words{
      "sbatch",
      "--parsable",
      "--requeue",
      "--open-mode=append",
      "--job-name=" + job.name,
      "--array=" + (job.numbers.empty() ? fmt::format("1-{}", job.tasks) : job.numbers),
      "--output=" + literal(job.folder) + "/%a.txt",
      "--chdir=" + (job.start.empty() ? job.folder : job.start).string()};
  if (!job.time.empty()) words.push_back("--time=" + job.time);
  if (!job.partition.empty()) words.push_back("--partition=" + job.partition);
  if (!job.signal.empty()) words.push_back("--signal=B:" + job.signal);
  if (!job.excluded.empty())
    words.push_back(fmt::format("--exclude={}", fmt::join(job.excluded, ",")));
  if (!job.after.empty()) words.push_back("--dependency=afterany:" + job.after);
  words.push_back(script.string());
  return words;
}

}  // namespace

std::string script_of(const ArrayJob& job) {
  std::string text = "#!/bin/sh\n";
  text += fmt::format("#SBATCH --ntasks=1 --cpus-per-task={}\n", job.processors);
  if (job.megabytes > 0) text += fmt::format("#SBATCH --mem-per-cpu={}M\n", job.megabytes);
  text += "exec";
  for (const std::string& word : job.command)
    text += " " + shell_word(word);
  return text + "\n";
}

std::string submit(const ArrayJob& job) {
  const fs::path script = job.folder / (job.name + ".sh");
  write_file(script, script_of(job));
  std::string id = output_of(sbatch_words(job, script));
  id = id.substr(0, id.find_first_of(";\n"));  // a federation's cluster name follows
  if (id.empty()) throw Error("sbatch named no job");
  return id;
}

Jobs parse_jobs(const std::string& lines) {
  Jobs jobs;
  std::istringstream text(lines);
  for (std::string id, state, reason;
       text >> id >> state && std::getline(text >> std::ws, reason);) {
    const bool waits = state == "PENDING" || state == "REQUEUED" || state == "REQUEUE_HOLD" ||
                       state == "SPECIAL_EXIT";
    ++(waits ? jobs.waiting : jobs.running);
    if (waits) jobs.reason = reason;
    if (std::find(jobs.ids.begin(), jobs.ids.end(), id) == jobs.ids.end()) jobs.ids.push_back(id);
  }
  return jobs;
}

Jobs jobs_named(const std::string& name) {
  // %F: the array's number, the same for each of its tasks.
  return parse_jobs(output_of(
      {"squeue", "--me", "--noheader", "--array", "--name=" + name, "--format=%F %T %r"}));
}

void cancel(const std::string& id) {
  output_of({"scancel", id});
}

std::string array_numbers(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1)
      ++end;
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[i]);
    if (end - i > 1) text += fmt::format("-{}", numbers[end - 1]);
    i = end;
  }
  return text;
}

void need_slurm() {
  for (const char* program : {"sbatch", "squeue"}) {
    if (!is_program(program))
      throw Error("there is no {} here: --slurm is for a machine from which jobs are submitted",
                  program);
  }
}

std::string job_name(const std::string& kind, const fs::path& folder) {
  // FNV-1a: the same on every machine.
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : fs::weakly_canonical(folder).string())
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return fmt::format("{}_{:016x}", kind, hash);
}

}  // namespace carlo::slurm
