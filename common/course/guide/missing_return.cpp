// Exercises are compiled (-fsanitize=return) to call this where a function reaches its end without
// returning its value; otherwise execution would run on into whatever code follows. The sanitizers'
// library provides the same function but costs far more to link.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

/// As GCC and Clang pass it.
struct Place {
  const char* file;
  std::uint32_t line, column;
};

}  // namespace

// The compilers choose the name.
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
extern "C" [[noreturn]] void __ubsan_handle_missing_return(void* place) {
  const Place& at = *static_cast<const Place*>(place);
  std::fprintf(stderr, "%s:%u:%u: runtime error: a function ended without a return\n", at.file,
               at.line, at.column);
  std::abort();
}
