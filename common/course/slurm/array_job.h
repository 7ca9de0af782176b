#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Slurm's job arrays: submits one and finds it again. Slurm itself records running jobs by the
// job's name, so nothing of ours has to be written at the moment a job is submitted.

namespace carlo::slurm {

/// `tasks` runs of a command, which reads its number, from 1 on, from SLURM_ARRAY_TASK_ID.
struct ArrayJob {
  std::string name;                       ///< jobs_named() finds it by this
  std::filesystem::path folder;           ///< on all nodes: for script and output
  std::vector<std::string> command = {};  ///< a program by its full path, and its arguments
  int tasks = 1;
  int processors = 1;                      ///< per task
  int megabytes = 0;                       ///< of memory per processor; 0: the cluster's default
  std::string time = {}, partition = {};   ///< in sbatch's syntax; empty: the cluster's default
  std::vector<std::string> excluded = {};  ///< nodes that it must not use
  std::string after = {};                  ///< jobs ("12:15") that must end first, in any way
  std::string numbers = {};                ///< task numbers, as "3,7-9"; empty: 1 to `tasks`
  std::string signal = {};           ///< "USR1@60": sent so many seconds before the time limit
  std::filesystem::path start = {};  ///< working folder of the command; empty: `folder`
};

/// Returns the script that each task runs: FOLDER/NAME.sh. The submitting user's SBATCH_* variables
/// override its options (SBATCH_ACCOUNT, SBATCH_MEM_PER_CPU ...).
std::string script_of(const ArrayJob& job);

/// Writes the script and submits it, to be requeued when a node fails or a task is preempted. Task
/// N's output is appended to FOLDER/N.txt. Returns the job's number. Throws Error; sbatch has
/// printed why.
std::string submit(const ArrayJob& job);

/// A user's jobs of one name that have not ended.
struct Jobs {
  std::vector<std::string> ids = {};  ///< of arrays, each once
  int waiting = 0, running = 0;       ///< tasks
  std::string reason = {};            ///< why they wait, in Slurm's wording

  bool any() const { return waiting + running > 0; }
};

/// Throws Error if Slurm does not answer.
Jobs jobs_named(const std::string& name);

/// Parses what squeue printed.
Jobs parse_jobs(const std::string& lines);

/// Ends a job. Throws Error.
void cancel(const std::string& id);

/// Throws Error if Slurm is not installed.
void need_slurm();

/// Returns "3,7-9" for 3, 7, 8, 9.
std::string array_numbers(const std::vector<int>& numbers);

/// Returns the job name for output in a folder: `kind`, and a number derived from the path.
std::string job_name(const std::string& kind, const std::filesystem::path& folder);

}  // namespace carlo::slurm
