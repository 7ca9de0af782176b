#pragma once

#include "renderer/production/block_set.h"
#include "renderer/production/resume.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// A render on a cluster is a folder beside its image, IMAGE.slurm, on a file system that all nodes
// share. Its files record what is done; Slurm knows what is running (course/slurm/array_job.h).
//
//   plan.json     the render, and the options of the last call
//   carlo_render  a copy of the program, since a later build may round differently
//   kernel        the kernel that the first task chose; all others must use the same
//   I.part        the part of shard I, perhaps incomplete
//   round, R.exr  with a target error: the number R of the current round; the state before it
//   R.I.exr       shard I's share of round R; R.I.begun.exr: incomplete
//   submitted     the number of finished blocks of samples when jobs were last submitted
//   tasks, merge  the output of the jobs
//   done          exists once the image is written and the parts are removed

namespace carlo {

/// The content of plan.json.
struct SlurmPlan {
  /// The settings of the whole render, except for the kernel, which the first task chooses.
  RenderSettings settings;
  std::string scene;  ///< its file
  int width = 0, height = 0;
  int spp = 0;               ///< samples per pixel; with a target error their largest number
  double target_error = 0;   ///< 0: none
  bool light_paths = false;  ///< whether light paths are traced: tried once, for all shards
  int shards = 1;
  std::string jobs = {};  ///< name of the array; the merge's has "_merge" behind it
  // The options of the last call.
  std::vector<std::string> words;  ///< arguments of `render`
  std::string start;               ///< folder that relative paths start from
  int threads = 1;
  std::string time = {}, partition = {};  ///< empty: the cluster's default

  bool adaptive() const { return target_error > 0; }
  // Only without a target error:
  BlockGrid grid() const;
  BlockRange share(int shard) const;
  /// Returns the number of blocks that SlurmFolder::look() finds at the end; with a target error,
  /// an upper bound.
  double all_blocks() const;
};

class SlurmFolder {
 public:
  /// Returns the folder of the image with this stem.
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
  /// Starts the next round, whose state has been written.
  void next_round(const SlurmPlan& plan) const;

  std::filesystem::path output_of_tasks() const { return path_ / "tasks"; }
  std::filesystem::path output_of_merge() const { return path_ / "merge"; }

  /// Empty if no render was begun. Throws Error if it cannot be read.
  std::optional<SlurmPlan> plan() const;
  /// Begins a render, and removes all files of an earlier one. Throws Error.
  void begin(const SlurmPlan& plan);
  /// Replaces the plan of the same render. Throws Error.
  void write(const SlurmPlan& plan) const;

  /// Returns the kernel of the first task that called this. Throws Error.
  std::string settle_kernel(const std::string& mine) const;

  /// The unfinished shards, and the number of finished blocks of samples; with a target error, the
  /// unfinished shards of the current round, and the number of finished shares of rounds. Only the
  /// headers of parts that were unfinished at the last call are read; unreadable parts count as
  /// empty.
  struct State {
    std::vector<int> missing;
    std::uint64_t blocks = 0;
  };
  State look(const SlurmPlan& plan);

  /// The number of blocks when jobs were last submitted; empty if none were.
  std::optional<std::uint64_t> submitted() const;
  void set_submitted(std::uint64_t blocks) const;

  /// Records that the image is written, and removes the parts. `report` is a message for users.
  void finish(const SlurmPlan& plan, const std::filesystem::path& image,
              const std::string& report) const;
  /// Returns the report if the image is unchanged; empty if there is none. Throws Error if it has
  /// changed.
  std::optional<std::string> done() const;

 private:
  State look_at_round(const SlurmPlan& plan) const;
  void remove_round(const SlurmPlan& plan, int round) const;

  std::filesystem::path path_;
  std::vector<bool> finished_;  ///< the shards that look() found finished
};

}  // namespace carlo
