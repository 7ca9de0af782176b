#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace carlo {

/// Detects bytes corrupted by a disk or a network, not deliberate changes: always if all changed
/// bytes are among eight that are added as one word, otherwise with probability 1 - 2^-64. Depends
/// on how the bytes are divided among calls of add().
class Checksum {
 public:
  void add(std::span<const unsigned char> bytes) {
    std::size_t at = 0;
    for (; at + sizeof(std::uint64_t) <= bytes.size(); at += sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, &bytes[at], sizeof word);
      add(word);
    }
    std::uint64_t rest = 0;
    if (at < bytes.size()) std::memcpy(&rest, &bytes[at], bytes.size() - at);
    add(rest);
    add(std::uint64_t{bytes.size()});
  }

  std::uint64_t value() const { return value_; }

 private:
  /// A bijection both of the word and of the value, so that a difference in one word is never lost.
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0xD6E8FEB86659FD93;
    value_ ^= value_ >> 32;
  }

  std::uint64_t value_ = 0;
};

}  // namespace carlo
