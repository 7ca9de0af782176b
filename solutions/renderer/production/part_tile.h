#pragma once

#include "image/film.h"

#include <cstddef>
#include <span>
#include <vector>

namespace carlo {

/// Appends the sums of a tile's pixels as bytes, little-endian. Each number of a sum (ExactSum: a
/// position and three digits; three channels, sums and squares) makes a plane: the least of the
/// tile's numbers in eight bytes; the width, in one byte; and for each pixel its difference from
/// the least in that many bytes.
void append_tile(std::vector<unsigned char>& bytes, std::span<const PixelSums> pixels);

/// Adds the sums (not the numbers of blocks) in such bytes to pixels. Returns false if they are
/// malformed.
bool add_tile(std::span<const unsigned char> bytes, std::span<PixelSums> pixels);

/// The largest number of bytes for a tile of this many pixels.
std::size_t most_tile_bytes(std::size_t pixels);

}  // namespace carlo
