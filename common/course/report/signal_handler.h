#pragma once

#include <unistd.h>

#include <array>
#include <csignal>
#include <initializer_list>
#include <string_view>

namespace carlo {

/// True in a build with AddressSanitizer, which reports crashes itself.
constexpr bool sanitizer_reports_crashes =
#if defined(__SANITIZE_ADDRESS__)
    true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
    true;
#else
    false;
#endif
#else
    false;
#endif

/// Writes to stderr with only what a signal handler may call.
inline void say_in_handler(std::string_view text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

/// Has a crash's signals handled once, by `action`'s handler on a stack of its own, since endless
/// recursion has used up the other; the signal's usual effect follows when the handler raises it
/// again. Other flags of `action` are kept.
inline void handle_crashes(struct sigaction action, std::initializer_list<int> signals) {
  static std::array<char, 16384> stack{};
  stack_t own{};
  own.ss_sp = stack.data();
  own.ss_size = stack.size();
  ::sigaltstack(&own, nullptr);
  action.sa_flags |= static_cast<int>(SA_RESETHAND) | SA_ONSTACK | SA_NODEFER;
  for (const int signal : signals)
    ::sigaction(signal, &action, nullptr);
}

}  // namespace carlo
