#pragma once

#include "renderer/production/block_set.h"
#include "renderer/production/settings.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// A render on a cluster has a folder beside its image, IMAGE.slurm, on a file system that all nodes
// share. Its files record what is done; Slurm knows what is running (course/slurm/array_job.h).
//
//   plan.json     what is rendered, and the latest command line
//   carlo_render  a copy of the program: a later build would render other bits
//   kernel        the kernel that the first task's processor chose: the others must use the same
//   I.exr         the part of shard I, perhaps unfinished
//   round, R.exr  with a target error: the number R of the current round; the common state before
//   it R.I.exr       shard I's part of round R; R.I.begun.exr: the same, unfinished submitted the
//   number of finished blocks of samples when jobs were last submitted tasks, merge  the output of
//   the jobs done          exists once the image is written and the parts are removed

namespace carlo {

/// The content of plan.json.
struct SlurmPlan {
  RenderSettings settings;  ///< of the whole render; the kernel is chosen by the first task
  std::string scene;        ///< path of its file
  int width = 0, height = 0;
  int spp = 0;              ///< of the whole render; with a target error the limit
  double target_error = 0;  ///< 0: none
  bool lamps = false;       ///< whether paths from lamps are traced: decided once, for all shards
  int shards = 1;
  std::string jobs = {};  ///< name of the job array; the merge's is NAME_merge
  // The latest command line.
  std::vector<std::string> words;  ///< arguments of `render`
  std::string start;               ///< folder that their paths are relative to
  int threads = 1;
  std::string time = {}, partition = {};  ///< empty: the cluster's default

  bool adaptive() const { return target_error > 0; }
  /// Only without a target error, as is share().
  BlockGrid grid() const;
  BlockRange share(int shard) const;
  /// What SlurmFolder::look() counts at the end; with a target error, an upper bound.
  double all_blocks() const;
};

class SlurmFolder {
 public:
  /// The folder of an image, given by its stem.
  static SlurmFolder beside(const std::filesystem::path& stem);
  explicit SlurmFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path program() const { return path_ / "carlo_render"; }
  std::filesystem::path part(int shard) const;
  /// With a target error: the current round, from 0 on, and the files of a round.
  int round() const;
  std::filesystem::path round_state(int round) const;
  std::filesystem::path round_part(int round, int shard) const;
  std::filesystem::path round_part_begun(int round, int shard) const;
  /// Moves on to the next round, whose state has been written.
  void next_round(const SlurmPlan& plan) const;

  std::filesystem::path output_of_tasks() const { return path_ / "tasks"; }
  std::filesystem::path output_of_merge() const { return path_ / "merge"; }

  /// Returns nothing if no render was begun. Throws Error if the plan cannot be read.
  std::optional<SlurmPlan> plan() const;
  /// Begins a render, removing everything of an earlier one. Throws Error.
  void begin(const SlurmPlan& plan);
  /// Writes a new plan of the same render. Throws Error.
  void write(const SlurmPlan& plan) const;

  /// Returns the kernel for all tasks, that of the first task that asks. Throws Error.
  std::string settle_kernel(const std::string& mine) const;

  /// The unfinished shards, and the number of finished blocks of samples; with a target error the
  /// unfinished shards of the current round, and the number of finished shares of rounds. look()
  /// reads the headers of parts that were unfinished when it looked last; unreadable parts count as
  /// having no blocks.
  struct State {
    std::vector<int> missing;
    std::uint64_t blocks = 0;
  };
  State look(const SlurmPlan& plan);

  /// The number of blocks that look() counted when jobs were last submitted; nothing if none were.
  std::optional<std::uint64_t> submitted() const;
  void set_submitted(std::uint64_t blocks) const;

  /// Records that the image is written, and removes the parts. `report` is for the reader.
  void finish(const SlurmPlan& plan, const std::filesystem::path& image,
              const std::string& report) const;
  /// Returns the report if the image is still the one that was written; nothing if there is none.
  /// Throws Error if the image has changed.
  std::optional<std::string> done() const;

 private:
  State look_at_round(const SlurmPlan& plan) const;
  void remove_round(const SlurmPlan& plan, int round) const;

  std::filesystem::path path_;
  std::vector<bool> finished_;  ///< by shard, from look()
};

}  // namespace carlo
