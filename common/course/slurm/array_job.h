#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Slurm's job arrays: submitting one, and finding it again. Slurm itself keeps what is at work, by
// the job's name: nothing of ours has to be written at the same moment as a job is submitted.

namespace carlo::slurm {

/// `tasks` times a command, which learns its number, from 1 on, from SLURM_ARRAY_TASK_ID.
struct ArrayJob {
  std::string name;                       ///< by which jobs_named() finds it
  std::filesystem::path folder;           ///< on all nodes: for its script and its tasks' output
  std::vector<std::string> command = {};  ///< a program by its whole path, and its arguments
  int tasks = 1;
  int processors = 1;                      ///< of a task
  int megabytes = 0;                       ///< of memory a processor; 0: what the cluster gives
  std::string time = {}, partition = {};   ///< in sbatch's words; empty: what the cluster gives
  std::vector<std::string> excluded = {};  ///< nodes that it must not run on
  std::string after = {};                  ///< jobs ("12:15") whose end, good or bad, it waits for
  std::string numbers = {};                ///< its tasks', as "3,7-9"; empty: 1 to `tasks`
  std::string signal = {};  ///< "USR1@60": what the command gets so many seconds before its limit
  std::filesystem::path start = {};  ///< where the command starts; empty: in `folder`
};

/// What each task runs: FOLDER/NAME.sh. SBATCH_* variables of whoever submits go before what stands
/// in it (SBATCH_ACCOUNT, SBATCH_MEM_PER_CPU ...).
std::string script_of(const ArrayJob& job);

/// Writes the script and submits it, to be requeued when a node fails or a task is preempted. Task
/// N's output is appended to FOLDER/N.txt. Returns the job's number. Throws Error; sbatch has said
/// why.
std::string submit(const ArrayJob& job);

/// A user's jobs of one name that have not ended.
struct Jobs {
  std::vector<std::string> ids = {};  ///< of arrays, each once
  int waiting = 0, running = 0;       ///< tasks
  std::string reason = {};            ///< why they wait, in Slurm's word

  bool any() const { return waiting + running > 0; }
};

/// Throws Error when Slurm does not answer.
Jobs jobs_named(const std::string& name);

/// The same from what squeue printed.
Jobs parse_jobs(const std::string& lines);

/// Ends a job. Throws Error.
void cancel(const std::string& id);

/// Throws Error where there is no Slurm.
void need_slurm();

/// "3,7-9" from 3, 7, 8, 9.
std::string array_numbers(const std::vector<int>& numbers);

/// A job's name for what is made in a folder: `kind`, and a number that follows from the path.
std::string job_name(const std::string& kind, const std::filesystem::path& folder);

}  // namespace carlo::slurm
