#pragma once

#include "image/film.h"

#include <cstddef>
#include <span>
#include <vector>

namespace carlo {

/// The sums of a tile's pixels as bytes. Each number that a sum holds (ExactSum: a place and three
/// digits; three channels, sums and squares) makes a plane: the least of the tile's numbers, eight
/// bytes; one byte, how many bytes the greatest needs above it; and what each pixel's is above it,
/// in as many bytes. Little-endian.
void append_tile(std::vector<unsigned char>& bytes, std::span<const PixelSums> pixels);

/// Adds the sums (not the numbers of blocks) of such bytes to pixels. False if they are none.
bool add_tile(std::span<const unsigned char> bytes, std::span<PixelSums> pixels);

/// As many bytes as a tile of so many pixels takes at most.
std::size_t most_tile_bytes(std::size_t pixels);

}  // namespace carlo
