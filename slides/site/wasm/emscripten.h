#pragma once

// What the C++20 library of Debian 12's Emscripten lacks; included ahead of every file.

#include <type_traits>
#include <utility>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

/// Without threads: runs at once, in the caller's.
struct jthread {
  template <class F, class... Args>
  explicit jthread(F&& f, Args&&... args) {
    std::forward<F>(f)(std::forward<Args>(args)...);
  }
};

}  // namespace std
