#pragma once

#include "render/blocks.h"
#include "render/driver.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// A set of blocks.
class BlockSet {
 public:
  BlockSet() = default;
  /// Disjoint ranges in any order; some may be empty.
  explicit BlockSet(std::vector<BlockRange> ranges);

  /// In order, with a gap between each two.
  const std::vector<BlockRange>& ranges() const { return ranges_; }
  std::uint64_t count() const;
  /// One past the last block.
  std::uint64_t end() const { return ranges_.empty() ? 0 : ranges_.back().end; }
  /// Returns the blocks below `end` that are not in the set.
  BlockSet missing(std::uint64_t end) const;
  /// The number of its blocks in a range.
  std::uint64_t count_in(const BlockRange& range) const;
  /// The number of its blocks for each tile.
  std::vector<std::uint32_t> of_tiles(std::uint64_t tiles) const;

  /// Formats the set as "0-1024 2048-2050"; from_text() returns nothing for any text that text()
  /// does not write.
  std::string text() const;
  static std::optional<BlockSet> from_text(std::string_view text);

  friend bool operator==(const BlockSet&, const BlockSet&) = default;

 private:
  std::vector<BlockRange> ranges_;
};

/// The I-th of N shares of a render's samples.
struct Shard {
  std::uint32_t index = 1, count = 1;

  std::string text() const;  ///< "3/64"
  friend bool operator==(const Shard&, const Shard&) = default;
};

/// The largest number of shares.
constexpr std::uint32_t most_shards = 1 << 20;

/// Parses "3/64". Throws Error.
Shard shard_of(const std::string& text);

/// Returns the blocks of a shard: equally many for all shards, give or take one. If light
/// paths are traced for all tiles of a pass at once, shares consist of whole passes as long as
/// there are enough, because a pass split between shards is traced by each of them.
BlockRange share_of(const Shard& shard, const BlockGrid& grid, bool light_paths);

/// Returns the blocks of a share that a film holds, rendered from this share alone. A tile's blocks
/// are rendered in order; tiles differ by `most_passes_at_once` after an interruption. Throws Error
/// if they differ by more.
BlockSet blocks_done(const Film& film, const BlockRange& share);

}  // namespace carlo
