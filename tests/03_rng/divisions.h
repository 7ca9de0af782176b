#pragma once

#include <csetjmp>
#include <csignal>

namespace lab03_tests {

namespace detail {
inline sigjmp_buf after_division;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
extern "C" inline void leave_division(int) {
  siglongjmp(after_division, 1);
}
}  // namespace detail

/// Calls f; returns false if it divided a whole number by zero, on processors that trap this. f's
/// resources are lost then, so a probe that gets false should do little more than report it.
template <class F>
bool divides_well(const F& f) {
  struct sigaction action {};
  struct sigaction before {};
  action.sa_handler = detail::leave_division;
  sigaction(SIGFPE, &action, &before);
  const bool good = sigsetjmp(detail::after_division, 1) == 0;  // NOLINT(cert-err52-cpp)
  if (good) f();
  sigaction(SIGFPE, &before, nullptr);
  return good;
}

}  // namespace lab03_tests
