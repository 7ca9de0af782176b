#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace renderer {

/// One property of many surfaces or lights, 0 at first. It is never so short that kernels, which
/// read whole registers, read past its end.
template <class T>
class Column {
 public:
  static constexpr std::size_t least = 128;

  explicit Column(std::size_t size = least) : entries_(std::max(size, least)) {}

  T& operator[](std::size_t i) { return entries_[i]; }
  const T& operator[](std::size_t i) const { return entries_[i]; }
  const T* data() const { return entries_.data(); }

 private:
  std::vector<T> entries_;
};

}  // namespace renderer
