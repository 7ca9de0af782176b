#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// A render's samples, as they are handed out: in blocks (film.h) of tiles (driver.h). They are
/// counted pass by pass: number p * tiles + t is the p-th block of each pixel of tile t.
struct BlockGrid {
  int width = 0, height = 0;
  std::uint32_t block = 1;   ///< samples of a pixel
  std::uint32_t passes = 0;  ///< blocks of a pixel

  int columns() const;  ///< of tiles
  std::uint64_t tiles() const;
  std::uint64_t blocks() const { return tiles() * passes; }
  friend bool operator==(const BlockGrid&, const BlockGrid&) = default;
};

/// The blocks [begin, end).
struct BlockRange {
  std::uint64_t begin = 0, end = 0;

  std::uint64_t count() const { return end - begin; }
  bool contains(std::uint64_t number) const { return begin <= number && number < end; }
  /// The first pass of which the tile has a block at `begin` or beyond.
  std::uint64_t first_pass(std::uint64_t tile, std::uint64_t tiles) const {
    return begin <= tile ? 0 : (begin - tile + tiles - 1) / tiles;
  }
  friend bool operator==(const BlockRange&, const BlockRange&) = default;
};

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

}  // namespace carlo
