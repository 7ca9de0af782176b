#pragma once

#include <cstdint>

namespace carlo {

/// Side, in pixels, of the square tiles that are rendered at once; all pixels of a tile have the
/// same number of blocks.
constexpr int driver_tile_size = 16;

/// The most passes that are rendered at once, tile by tile: by so many blocks tiles may differ
/// after an interruption.
constexpr std::uint32_t most_passes_at_once = 8;

/// The samples of a render, handed out in blocks (film.h) of tiles (driver.h). Blocks are numbered
/// pass by pass: number p * tiles + t is the p-th block of each pixel of tile t.
struct BlockGrid {
  int width = 0, height = 0;
  std::uint32_t block = 1;   ///< samples per pixel
  std::uint32_t passes = 0;  ///< blocks per pixel

  /// The numbers of tiles across, and in all.
  int columns() const { return tiles_along(width); }
  std::uint64_t tiles() const {
    return static_cast<std::uint64_t>(columns()) * static_cast<std::uint64_t>(tiles_along(height));
  }
  std::uint64_t blocks() const { return tiles() * passes; }
  friend bool operator==(const BlockGrid&, const BlockGrid&) = default;

 private:
  static int tiles_along(int side) { return (side + driver_tile_size - 1) / driver_tile_size; }
};

/// The blocks [begin, end).
struct BlockRange {
  std::uint64_t begin = 0, end = 0;

  std::uint64_t count() const { return end - begin; }
  bool contains(std::uint64_t number) const { return begin <= number && number < end; }
  /// The first pass whose block of this tile has a number of at least `begin`.
  std::uint64_t first_pass(std::uint64_t tile, std::uint64_t tiles) const {
    return begin <= tile ? 0 : (begin - tile + tiles - 1) / tiles;
  }
  friend bool operator==(const BlockRange&, const BlockRange&) = default;
};

}  // namespace carlo
