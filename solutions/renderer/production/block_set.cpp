#include "renderer/production/block_set.h"

#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

namespace carlo {

BlockSet::BlockSet(std::vector<BlockRange> ranges) {
  std::sort(ranges.begin(), ranges.end(),
            [](const BlockRange& a, const BlockRange& b) { return a.begin < b.begin; });
  for (const BlockRange& range : ranges) {
    if (range.count() == 0) continue;
    if (!ranges_.empty() && ranges_.back().end == range.begin) {
      ranges_.back().end = range.end;
    } else {
      ranges_.push_back(range);
    }
  }
}

std::uint64_t BlockSet::count() const {
  std::uint64_t count = 0;
  for (const BlockRange& range : ranges_)
    count += range.count();
  return count;
}

BlockSet BlockSet::missing(std::uint64_t end) const {
  std::vector<BlockRange> gaps;
  std::uint64_t begin = 0;
  for (const BlockRange& range : ranges_) {
    gaps.push_back({begin, range.begin});
    begin = range.end;
  }
  gaps.push_back({begin, std::max(begin, end)});
  return BlockSet(gaps);
}

std::uint64_t BlockSet::count_in(const BlockRange& range) const {
  std::uint64_t count = 0;
  for (const BlockRange& own : ranges_) {
    const std::uint64_t begin = std::max(own.begin, range.begin);
    count += std::max(std::min(own.end, range.end), begin) - begin;
  }
  return count;
}

std::vector<std::uint32_t> BlockSet::of_tiles(std::uint64_t tiles) const {
  // The number of blocks that a tile has beyond the tile before it: unsigned, so that a negative
  // difference wraps around.
  std::vector<std::uint32_t> counts(tiles + 1);
  for (const BlockRange& range : ranges_) {
    const std::uint64_t first = range.begin % tiles, end = first + range.count() % tiles;
    counts[0] += static_cast<std::uint32_t>(range.count() / tiles) + (end > tiles ? 1 : 0);
    ++counts[first];
    --counts[end > tiles ? end - tiles : end];
  }
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
  counts.pop_back();
  return counts;
}

std::string BlockSet::text() const {
  std::string text;
  for (const BlockRange& range : ranges_)
    text += fmt::format("{}{}-{}", text.empty() ? "" : " ", range.begin, range.end);
  return text;
}

std::optional<BlockSet> BlockSet::from_text(std::string_view text) {
  BlockSet set;
  if (text.ends_with(' ')) return std::nullopt;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const std::size_t dash = std::min(word.find('-'), word.size());
    const auto begin = number_of<std::uint64_t>(word.substr(0, dash));
    const auto end = number_of<std::uint64_t>(word.substr(std::min(dash + 1, word.size())));
    if (!begin || !end || *begin >= *end) return std::nullopt;
    if (!set.ranges_.empty() && *begin <= set.end()) return std::nullopt;
    set.ranges_.push_back({*begin, *end});
  }
  return set;
}

std::string Shard::text() const {
  return fmt::format("{}/{}", index, count);
}

Shard shard_of(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view all(text);
  const auto index = number_of<std::uint32_t>(all.substr(0, slash));
  const auto count = number_of<std::uint32_t>(all.substr(std::min(slash + 1, all.size())));
  if (!index || !count || *index < 1 || *index > *count || *count > most_shards) {
    throw Error("--shard is I/N with I from 1 to N and N at most {}, for example 3/64, got '{}'",
                most_shards, text);
  }
  return {*index, *count};
}

BlockRange share_of(const Shard& shard, const BlockGrid& grid, bool light_paths) {
  const bool whole_passes = light_paths && shard.count <= grid.passes;
  const std::uint64_t unit = whole_passes ? grid.tiles() : 1, units = grid.blocks() / unit;
  const std::uint64_t each = units / shard.count, more = units % shard.count;
  const auto first = [&](std::uint64_t i) { return (each * i + std::min(i, more)) * unit; };
  return {first(shard.index - 1), first(shard.index)};
}

BlockSet blocks_done(const Film& film, const BlockRange& share) {
  const std::uint64_t tiles = BlockGrid{film.width(), film.height()}.tiles();
  std::vector<std::uint64_t> next;  ///< the next pass of each tile
  for (int y = 0; y < film.height(); y += driver_tile_size) {
    for (int x = 0; x < film.width(); x += driver_tile_size)
      next.push_back(share.first_pass(next.size(), tiles) + film.blocks(x, y));
  }
  const auto [least, most] = std::minmax_element(next.begin(), next.end());
  if (*most - *least > 1 + most_passes_at_once)
    throw Error("its tiles are not those of one render");
  const std::uint64_t all = std::min(*least * tiles, share.end);
  std::vector<BlockRange> ranges{{std::min(share.begin, all), all}};
  for (std::uint64_t pass = *least; pass < *most; ++pass) {
    for (std::uint64_t tile = 0; tile < tiles; ++tile) {
      const std::uint64_t number = pass * tiles + tile;
      if (pass < next[tile] && share.contains(number)) ranges.push_back({number, number + 1});
    }
  }
  return BlockSet(ranges);
}

}  // namespace carlo
