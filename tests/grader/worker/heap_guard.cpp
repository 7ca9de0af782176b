// Puts every block that the worker's code gets from operator new between two marks; if a mark has
// changed when the block is freed, somebody has written outside it. So `x[n] = 0` on an array of n
// numbers fails the test in every build, not only with a sanitizer. A block also begins with the
// same pattern as an uninitialised local variable (carlo_lab.cmake), so that `new double[n]` does
// not hold zeros by luck. The sanitizers bring their own operator new: for them this file is empty.

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CARLO_SANITIZER_GUARDS 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define CARLO_SANITIZER_GUARDS 1
#endif

#if !defined(CARLO_SANITIZER_GUARDS)

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <string_view>

namespace {

using Mark = std::array<std::uint64_t, 2>;
/// The fill byte of a block, the same as GCC's for variables: as a double it is -5.3e303. Only the
/// beginning of a large block is filled, so that memory that is reserved and never used stays
/// unused.
constexpr int pattern = 0xFE;
constexpr std::size_t filled_bytes = std::size_t{64} << 10;

constexpr Mark mark_value{0xC4121095A5C3965A, 0x3C69A5C35AC41210};

/// The header before a block; as long as two alignments, so that the block is aligned too.
struct Header {
  std::uint64_t size, unused;
  Mark mark;
};
static_assert(sizeof(Header) % __STDCPP_DEFAULT_NEW_ALIGNMENT__ == 0);

[[noreturn]] void complain() {
  constexpr std::string_view text =
      "memory next to an array or a vector was overwritten: an index is too large or negative\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  std::abort();
}

bool intact(const char* mark) {
  return std::memcmp(mark, mark_value.data(), sizeof(Mark)) == 0;
}

}  // namespace

void* operator new(std::size_t size) {
  constexpr std::size_t around = sizeof(Header) + sizeof(Mark);
  if (size > std::numeric_limits<std::size_t>::max() - around) throw std::bad_alloc();
  auto* const start = static_cast<char*>(std::malloc(size + around));
  if (start == nullptr) throw std::bad_alloc();
  const Header header{size, 0, mark_value};
  std::memcpy(start, &header, sizeof header);
  std::memset(start + sizeof header, pattern, std::min(size, filled_bytes));
  std::memcpy(start + sizeof header + size, mark_value.data(), sizeof(Mark));
  return start + sizeof header;
}

void operator delete(void* block) noexcept {
  if (block == nullptr) return;
  char* const start = static_cast<char*>(block) - sizeof(Header);
  Header header{};
  std::memcpy(&header, start, sizeof header);
  // The size is only trusted if the mark after it is intact.
  if (!intact(start + offsetof(Header, mark))) complain();
  if (!intact(static_cast<char*>(block) + header.size)) complain();
  std::free(start);
}

// The array and the no-throw forms call these two; so must the sized ones.
void operator delete(void* block, std::size_t) noexcept {
  operator delete(block);
}

#endif
