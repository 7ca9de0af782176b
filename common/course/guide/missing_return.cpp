// What exercises are compiled to call (-fsanitize=return) where a function that owes a value comes
// to its end without one: else the program would run on into whatever lies behind. The sanitizers'
// library does the same, but costs far more to link; this is its name for it.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

/// As GCC and Clang hand it over.
struct Place {
  const char* file;
  std::uint32_t line, column;
};

}  // namespace

// The compilers choose the name.
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
extern "C" [[noreturn]] void __ubsan_handle_missing_return(void* place) {
  const Place& at = *static_cast<const Place*>(place);
  std::fprintf(stderr, "%s:%u:%u: runtime error: a function came to its end without a return\n",
               at.file, at.line, at.column);
  std::abort();
}
