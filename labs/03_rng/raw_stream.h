#pragma once

#include <cstdint>
#include <string>

namespace lab03 {

/// Writes the numbers of a generator to standard output for an external battery: 32-bit
/// little-endian words, until the reader closes the pipe. Throws carlo::Error when the generator is
/// unknown, when standard output is a terminal, or when writing fails for any other reason.
void write_raw_stream(const std::string& key, std::uint64_t seed);

}  // namespace lab03
