#include "renderer/production/merge.h"

#include "renderer/production/state_file.h"
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
    const StateFile file(path);
    if (!file.part())
      throw Error("cannot merge {}: it is no part of a render, which --shard writes",
                  path.string());
    if (places_.empty()) {
      settings_ = file.settings();
      grid_ = file.grid();
      scene_ = file.setting("scene");
      part_ = *file.part();
      counts_ = file.counts();
      lamp_ties_ = file.lamp_ties();
    } else {
      if (const auto difference = difference_of(file.settings(), settings_)) {
        throw Error("{} is of another render than {}: its {} is {}, the other's {}", path.string(),
                    paths[0].string(), difference->name, difference->a, difference->b);
      }
      take_in(file);
    }
    places_.push_back({path, file.part()->blocks});
  }
  take_in_blocks();
}

void Merge::take_in(const StateFile& file) {
  const Part& part = *file.part();
  take_least(scene_, file.setting("scene"));
  take_least(part_.needs, part.needs);
  take_least(settings_["definitions"], file.setting("definitions"));
  if (part.shard && part_.shard && part.shard->count == part_.shard->count) {
    part_.shard->index = 0;
  } else {
    part_.shard.reset();
  }
  part_.lamps = part_.lamps || part.lamps;
  part_.parts += part.parts;
  part_.microseconds += part.microseconds;
  part_.threads = std::max(part_.threads, part.threads);
  counts_ += file.counts();
  lamp_ties_.add(file.lamp_ties());
}

void Merge::take_in_blocks() {
  std::vector<std::pair<BlockRange, std::size_t>> all;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    for (const BlockRange& range : places_[i].blocks.ranges())
      all.emplace_back(range, i);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.begin, a.second) < std::pair(b.first.begin, b.second);
  });
  std::vector<BlockRange> ranges;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i].first.begin < all[i - 1].first.end) {
      const auto [one, other] = std::minmax(all[i - 1].second, all[i].second);
      refuse_overlap(places_[one], places_[other]);
    }
    ranges.push_back(all[i].first);
  }
  part_.blocks = BlockSet(ranges);
}

void Merge::refuse_overlap(const Place& one, const Place& other) const {
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
  throw Error("{} overlaps with {}: {} of its {} blocks of samples are in that, too",
              other.path.string(), one.path.string(), shared, other.blocks.count());
}

double Merge::share() const {
  return static_cast<double>(part_.blocks.count()) / static_cast<double>(grid_.blocks());
}

std::string Merge::missing() const {
  const BlockSet gaps = part_.blocks.missing(grid_.blocks());
  std::string text = fmt::format("{:.3g} % of the samples", 100 * (1 - share()));
  if (!part_.shard) return text;
  std::size_t listed = 0, more = 0;
  auto gap = gaps.ranges().begin();
  for (std::uint32_t index = 1; index <= part_.shard->count; ++index) {
    const Shard shard{index, part_.shard->count};
    const BlockRange range = share_of(shard, grid_, part_.lamps);
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
  RenderResult result{.film = Film(grid_.width, grid_.height, grid_.block),
                      .counts = counts_,
                      .lamp_ties = lamp_ties_,
                      .seconds = 1e-6 * static_cast<double>(part_.microseconds),
                      .threads = part_.threads};
  result.counts.lamp_ties = lamp_ties_.value() / static_cast<double>(grid_.tiles());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const StateFile file(places_[i].path);
    if (difference_of(file.settings(), settings_) || !file.part() ||
        file.part()->blocks != places_[i].blocks) {
      throw Error("{} has become another part meanwhile", places_[i].path.string());
    }
    file.add_to(result.film);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(places_.size()));
  }
  return result;
}

}  // namespace carlo
