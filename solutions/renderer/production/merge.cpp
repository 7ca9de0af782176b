#include "renderer/production/merge.h"

#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// Keeps the lesser of two texts, so that the order of the parts does not matter.
void take_least(std::string& text, const std::string& other) {
  text = std::min(text, other);
}

constexpr std::size_t most_listed = 4;

}  // namespace

Merge::Merge(const std::vector<fs::path>& paths) {
  if (paths.empty()) throw Error("which parts? (see ./carlo merge --help)");
  for (const fs::path& path : paths) {
    const PartFile file(path);
    const PartHeader& part = file.header();
    if (parts_.empty()) {
      header_ = part;
    } else {
      if (const auto difference = difference_of(part, header_)) {
        throw Error("{} is of another render than {}: its {} is {}, the other's {}", path.string(),
                    paths[0].string(), difference->name, difference->a, difference->b);
      }
      take_in(part);
    }
    parts_.push_back({path, part.blocks});
  }
  take_in_blocks();
}

void Merge::take_in(const PartHeader& part) {
  take_least(header_.scene, part.scene);
  take_least(header_.needs, part.needs);
  take_least(header_.settings["definitions"], part.settings.at("definitions"));
  if (part.shard && header_.shard && part.shard->count == header_.shard->count) {
    header_.shard->index = 0;
  } else {
    header_.shard.reset();
  }
  header_.light_paths = header_.light_paths || part.light_paths;
  header_.parts += part.parts;
  header_.counts += part.counts;
  header_.covariance.add(part.covariance);
  header_.microseconds += part.microseconds;
  header_.threads = std::max(header_.threads, part.threads);
}

void Merge::take_in_blocks() {
  std::vector<std::pair<BlockRange, std::size_t>> all;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    for (const BlockRange& range : parts_[i].blocks.ranges())
      all.emplace_back(range, i);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.begin, a.second) < std::pair(b.first.begin, b.second);
  });
  std::vector<BlockRange> ranges;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i].first.begin < all[i - 1].first.end) {
      refuse_overlap(std::min(all[i - 1].second, all[i].second),
                     std::max(all[i - 1].second, all[i].second));
    }
    ranges.push_back(all[i].first);
  }
  header_.blocks = BlockSet(ranges);
}

void Merge::refuse_overlap(std::size_t a, std::size_t b) const {
  const Part& one = parts_[a];
  const Part& other = parts_[b];
  std::error_code none;
  if (fs::equivalent(one.path, other.path, none)) {
    throw Error("{} is given twice", other.path.string());
  }
  if (one.blocks == other.blocks) {
    throw Error("{} holds the same samples as {}: give one of them", other.path.string(),
                one.path.string());
  }
  std::uint64_t shared = 0;
  for (const BlockRange& range : other.blocks.ranges())
    shared += one.blocks.count_in(range);
  throw Error("{} overlaps with {}: {} of its {} blocks of samples are in both",
              other.path.string(), one.path.string(), shared, other.blocks.count());
}

double Merge::share() const {
  return static_cast<double>(header_.blocks.count()) / static_cast<double>(header_.grid.blocks());
}

std::string Merge::missing() const {
  const BlockSet gaps = header_.blocks.missing(header_.grid.blocks());
  std::string text = fmt::format("{:.3g} % of the samples", 100 * (1 - share()));
  if (!header_.shard) return text;
  std::size_t listed = 0, more = 0;
  auto gap = gaps.ranges().begin();
  for (std::uint32_t index = 1; index <= header_.shard->count; ++index) {
    const Shard shard{index, header_.shard->count};
    const BlockRange range = share_of(shard, header_.grid, header_.light_paths);
    std::uint64_t lacks = 0;
    while (gap != gaps.ranges().end() && gap->begin < range.end) {
      lacks += std::min(gap->end, range.end) - std::max(gap->begin, range.begin);
      if (gap->end > range.end) break;
      ++gap;
    }
    if (lacks == 0) continue;
    if (listed == most_listed) {
      ++more;
      continue;
    }
    text += fmt::format("{}{}{}", listed++ == 0 ? " (shards " : ", ", shard.text(),
                        lacks == range.count() ? "" : " in part");
  }
  if (listed == 0) return text;
  return text + (more > 0 ? fmt::format(" and {} more)", more) : ")");
}

RenderResult Merge::run(const std::function<void(double)>& progress) const {
  RenderResult result{.film = Film(header_.grid.width, header_.grid.height, header_.grid.block),
                      .counts = header_.counts,
                      .covariance = header_.covariance,
                      .seconds = 1e-6 * static_cast<double>(header_.microseconds),
                      .threads = header_.threads};
  result.counts.splat_covariance =
      header_.covariance.splats.value() / static_cast<double>(header_.grid.tiles());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const PartFile file(parts_[i].path);
    if (difference_of(file.header(), header_) || file.header().blocks != parts_[i].blocks) {
      throw Error("{} has been replaced by another part meanwhile", parts_[i].path.string());
    }
    file.add_to(result.film);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(parts_.size()));
  }
  return result;
}

}  // namespace carlo
