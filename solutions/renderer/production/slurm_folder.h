#pragma once

#include "renderer/production/block_set.h"
#include "renderer/production/resume.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// A render on a cluster is a folder beside its image, IMAGE.slurm, on a file system that all nodes
// share. What is done is what its files say; what is at work is what Slurm says
// (course/slurm/array_job.h).
//
//   plan.json     what is rendered, and how it was asked for last
//   carlo_render  the program as it was then: a later build would have other bits
//   kernel        what the first task's processor made of the scene: others must do the same
//   I.part        of shard I, perhaps not all yet
//   round, R.exr  with a target error: the number R of the round at work; what all know before it
//   R.I.exr       of round R, shard I's share; R.I.begun.exr: not all of it yet
//   submitted     how many blocks of samples there were when jobs were submitted last
//   tasks, merge  what the jobs said
//   done          the image is written; the parts are gone

namespace carlo {

/// What plan.json says.
struct SlurmPlan {
  RenderSettings settings;  ///< of the whole render, but for its kernel (settled by the first task)
  std::string scene;        ///< its file
  int width = 0, height = 0;
  int spp = 0;               ///< of the whole render; at most, with a target error
  double target_error = 0;   ///< 0: none
  bool light_paths = false;  ///< whether light paths are traced: tried once, for all shards
  int shards = 1;
  std::string jobs = {};  ///< name of the array; the merge's has "_merge" behind it
  // How it was asked for last.
  std::vector<std::string> words;  ///< arguments of `render`
  std::string start;               ///< folder from which their paths count
  int threads = 1;
  std::string time = {}, partition = {};  ///< empty: the cluster's

  bool adaptive() const { return target_error > 0; }
  /// The rest without a target error.
  BlockGrid grid() const;
  BlockRange share(int shard) const;
  /// What SlurmFolder::look() finds in the end, with a target error at most.
  double all_blocks() const;
};

class SlurmFolder {
 public:
  /// Of an image, by its stem.
  static SlurmFolder beside(const std::filesystem::path& stem);
  explicit SlurmFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path program() const { return path_ / "carlo_render"; }
  std::filesystem::path part(int shard) const;
  /// With a target error: the round at work, from 0 on; the files of a round.
  int round() const;
  std::filesystem::path round_state(int round) const;
  std::filesystem::path round_part(int round, int shard) const;
  std::filesystem::path round_part_begun(int round, int shard) const;
  /// The state of the next round is written: goes on to it.
  void next_round(const SlurmPlan& plan) const;

  std::filesystem::path output_of_tasks() const { return path_ / "tasks"; }
  std::filesystem::path output_of_merge() const { return path_ / "merge"; }

  /// None where nothing was begun. Throws Error if it cannot be read.
  std::optional<SlurmPlan> plan() const;
  /// Begins a render: nothing of an earlier one is left. Throws Error.
  void begin(const SlurmPlan& plan);
  /// Of the same render. Throws Error.
  void write(const SlurmPlan& plan) const;

  /// The kernel of the first task that asks, for all. Throws Error.
  std::string settle_kernel(const std::string& mine) const;

  /// Shards that are not finished, and how many blocks of samples there are; with a target error
  /// those of the round at work, and how many shares of rounds there are. Reads the headers of
  /// parts that were not finished when it looked last; those that cannot be read have no blocks.
  struct State {
    std::vector<int> missing;
    std::uint64_t blocks = 0;
  };
  State look(const SlurmPlan& plan);

  /// What look() found when jobs were submitted last; none if none were.
  std::optional<std::uint64_t> submitted() const;
  void set_submitted(std::uint64_t blocks) const;

  /// Says that the image is written, and removes the parts. `report` is for people.
  void finish(const SlurmPlan& plan, const std::filesystem::path& image,
              const std::string& report) const;
  /// The report, where the image is there as it was written. Throws Error if it is another now.
  std::optional<std::string> done() const;

 private:
  State look_at_round(const SlurmPlan& plan) const;
  void remove_round(const SlurmPlan& plan, int round) const;

  std::filesystem::path path_;
  std::vector<bool> finished_;  ///< what look() knows of shards
};

}  // namespace carlo
