#pragma once

#include "random/hash.h"

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace carlo {

/// A digest that detects contents spoilt by a disk or a network: a change within one word of eight
/// bytes always, others except once in 2^64 times. It does not protect against collisions made on
/// purpose. Depends on how the content is split into calls of add().
class Digest {
 public:
  void add(std::string_view bytes) { add_bytes(bytes.data(), bytes.size()); }
  template <class T>
  void add(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_bytes(values.data(), values.size_bytes());
  }

  /// 16 hexadecimal digits.
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  void add_bytes(const void* from, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(from);
    std::size_t at = 0;
    for (; at + sizeof(std::uint64_t) <= size; at += sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, bytes + at, sizeof word);
      add_word(word);
    }
    std::uint64_t rest = 0;
    std::memcpy(&rest, bytes + at, size - at);
    add_word(rest);
    add_word(size);
  }

  /// Bijective in the word and in the value, so that a difference stays to the end.
  void add_word(std::uint64_t word) { value_ = mix(value_ ^ word); }

  std::uint64_t value_ = 0;
};

}  // namespace carlo
