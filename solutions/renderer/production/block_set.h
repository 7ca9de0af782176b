#pragma once

#include "render/blocks.h"
#include "render/driver.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Any set of blocks.
class BlockSet {
 public:
  BlockSet() = default;
  /// Disjoint ranges in any order, empty ones among them.
  explicit BlockSet(std::vector<BlockRange> ranges);

  /// In order; between each two there is a gap.
  const std::vector<BlockRange>& ranges() const { return ranges_; }
  std::uint64_t count() const;
  /// One past the last.
  std::uint64_t end() const { return ranges_.empty() ? 0 : ranges_.back().end; }
  /// What lacks of all blocks below `end`.
  BlockSet missing(std::uint64_t end) const;
  /// How many of them are in a range.
  std::uint64_t count_in(const BlockRange& range) const;
  /// How many blocks each tile has.
  std::vector<std::uint32_t> of_tiles(std::uint64_t tiles) const;

  /// "0-1024 2048-2050"; nothing if a text is not what text() writes.
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

/// Shares at most.
constexpr std::uint32_t most_shards = 1 << 20;

/// From "3/64". Throws Error.
Shard shard_of(const std::string& text);

/// Its blocks: as many as those of other shards, or one more. Where paths from lamps are traced for
/// all tiles of a pass at once, a share is of whole passes if there are enough: a pass that several
/// shards have is traced by each.
BlockRange share_of(const Shard& shard, const BlockGrid& grid, bool lamps);

/// Which of a share's blocks a film holds, of a render of just these. A tile's blocks are rendered
/// in order; tiles differ by one after an interruption. Throws Error if they differ by more.
BlockSet blocks_done(const Film& film, const BlockRange& share);

}  // namespace carlo
