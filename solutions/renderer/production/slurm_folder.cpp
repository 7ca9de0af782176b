#include "renderer/production/slurm_folder.h"

#include "course/json/json_fields.h"
#include "course/render/outputs.h"
#include "render/driver.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/part.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <cstddef>
#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// The content of `done`: the image's file and the report.
struct Done {
  std::string image, report;
  std::uint64_t bytes = 0;
};

void fields(JsonFields& json, Done& done) {
  json("image", done.image);
  json.as_text("bytes", done.bytes);
  json("report", done.report);
}

/// Parses a number that is a file's whole text.
std::optional<std::uint64_t> number_in(const fs::path& path) {
  if (!fs::exists(path)) return {};
  return number_of<std::uint64_t>(read_file(path));
}

}  // namespace

static void fields(JsonFields& json, SlurmPlan& plan) {
  json("scene", plan.scene);
  json("settings", plan.settings);
  json("width", plan.width);
  json("height", plan.height);
  json("spp", plan.spp);
  json("target_error", plan.target_error);
  json("light_paths", plan.light_paths);
  json("shards", plan.shards);
  json("jobs", plan.jobs);
  json("words", plan.words);
  json("start", plan.start);
  json("threads", plan.threads);
  json("time", plan.time);
  json("partition", plan.partition);
}

BlockGrid SlurmPlan::grid() const {
  const auto samples = static_cast<std::uint32_t>(spp);
  return {width, height, block_size(samples), samples / block_size(samples)};
}

BlockRange SlurmPlan::share(int shard) const {
  return share_of({static_cast<std::uint32_t>(shard), static_cast<std::uint32_t>(shards)}, grid(),
                  light_paths);
}

double SlurmPlan::all_blocks() const {
  return adaptive() ? shards * Levels(static_cast<std::uint32_t>(spp)).count()
                    : static_cast<double>(grid().blocks());
}

SlurmFolder SlurmFolder::beside(const fs::path& stem) {
  return SlurmFolder(fs::absolute(with_suffix(stem, ".slurm")).lexically_normal());
}

fs::path SlurmFolder::part(int shard) const {
  return path_ / fmt::format("{}{}", shard, part_suffix);
}

int SlurmFolder::round() const {
  return static_cast<int>(number_in(path_ / "round").value_or(0));
}

fs::path SlurmFolder::round_state(int round) const {
  return path_ / fmt::format("{}.exr", round);
}

fs::path SlurmFolder::round_part(int round, int shard) const {
  return path_ / fmt::format("{}.{}.exr", round, shard);
}

fs::path SlurmFolder::round_part_begun(int round, int shard) const {
  return path_ / fmt::format("{}.{}.begun.exr", round, shard);
}

void SlurmFolder::next_round(const SlurmPlan& plan) const {
  const int last = round();
  write_file(path_ / "round", fmt::format("{}", last + 1));
  remove_round(plan, last);
}

void SlurmFolder::remove_round(const SlurmPlan& plan, int round) const {
  std::error_code ignored;  // a leftover file does no harm
  fs::remove(round_state(round), ignored);
  for (int i = 1; i <= plan.shards; ++i) {
    fs::remove(round_part(round, i), ignored);
    fs::remove(round_part_begun(round, i), ignored);
  }
}

std::optional<SlurmPlan> SlurmFolder::plan() const {
  const fs::path file = path_ / "plan.json";
  if (!fs::exists(file)) return {};
  return from_json_text<SlurmPlan>(read_file(file), fmt::format("cannot read {}", file.string()));
}

void SlurmFolder::begin(const SlurmPlan& plan) {
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    if (entry.path().filename() != ".lock") fs::remove_all(entry.path());
  }
  finished_.clear();
  fs::create_directories(output_of_tasks());
  fs::create_directories(output_of_merge());
  AtomicFile copy(program());
  fs::copy_file("/proc/self/exe", copy.path());
  copy.commit();
  write(plan);  // last, so that a folder with a plan is complete
}

void SlurmFolder::write(const SlurmPlan& plan) const {
  write_file(path_ / "plan.json", json_text(plan, 1) + "\n");
}

std::string SlurmFolder::settle_kernel(const std::string& mine) const {
  const fs::path file = path_ / "kernel";
  if (!fs::exists(file)) {
    const AtomicFile temporary(file);
    write_file(temporary.path(), mine);
    // Only one process can make the link, on NFS too.
    std::error_code another_was_first;
    fs::create_hard_link(temporary.path(), file, another_was_first);
  }
  return read_file(file);
}

SlurmFolder::State SlurmFolder::look_at_round(const SlurmPlan& plan) const {
  State state;
  const int at = round();
  for (int i = 1; i <= plan.shards; ++i) {
    if (!fs::exists(round_part(at, i))) state.missing.push_back(i);
  }
  state.blocks = static_cast<std::uint64_t>(at) * static_cast<std::uint64_t>(plan.shards) +
                 static_cast<std::uint64_t>(plan.shards) - state.missing.size();
  return state;
}

SlurmFolder::State SlurmFolder::look(const SlurmPlan& plan) {
  if (plan.adaptive()) return look_at_round(plan);
  State state;
  finished_.resize(static_cast<std::size_t>(plan.shards) + 1);
  for (int i = 1; i <= plan.shards; ++i) {
    std::vector<bool>::reference finished = finished_[static_cast<std::size_t>(i)];
    const std::uint64_t whole = plan.share(i).count();
    std::uint64_t there = finished ? whole : 0;
    if (!finished && whole > 0 && fs::exists(part(i))) {
      try {
        there = PartFile(part(i)).header().blocks.count();
      } catch (const Error&) {
        // Its task reports the error and begins again.
      }
    }
    finished = there == whole;
    state.blocks += there;
    if (!finished) state.missing.push_back(i);
  }
  return state;
}

std::optional<std::uint64_t> SlurmFolder::submitted() const {
  return number_in(path_ / "submitted");
}

void SlurmFolder::set_submitted(std::uint64_t blocks) const {
  write_file(path_ / "submitted", fmt::format("{}", blocks));
}

void SlurmFolder::finish(const SlurmPlan& plan, const fs::path& image,
                         const std::string& report) const {
  const Done done{fs::absolute(image).string(), report, fs::file_size(image)};
  write_file(path_ / "done", json_text(done, 1) + "\n");
  remove_round(plan, round());
  std::error_code ignored;  // a leftover part does no harm
  for (int i = 1; i <= plan.shards; ++i)
    fs::remove(part(i), ignored);
}

std::optional<std::string> SlurmFolder::done() const {
  const fs::path file = path_ / "done";
  if (!fs::exists(file)) return {};
  const auto done =
      from_json_text<Done>(read_file(file), fmt::format("cannot read {}", file.string()));
  std::error_code none;
  const std::uintmax_t bytes = fs::file_size(done.image, none);
  if (none || bytes != done.bytes) {
    throw Error("{} was rendered, and {} since; to render it again, remove {}", done.image,
                none ? "is gone" : "has changed", path_.string());
  }
  return done.report;
}

}  // namespace carlo
