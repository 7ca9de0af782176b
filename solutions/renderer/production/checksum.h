#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace carlo {

/// Tells bytes that a disk or a network has spoilt: a change within eight bytes that are taken in
/// at once is always found, others but once in 2^64 times. Nobody is kept from making two that are
/// alike. What is taken in piece by piece must be so again.
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
  /// One to one in the word and in the value, so that what differs once does so to the end.
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0xD6E8FEB86659FD93;
    value_ ^= value_ >> 32;
  }

  std::uint64_t value_ = 0;
};

}  // namespace carlo
