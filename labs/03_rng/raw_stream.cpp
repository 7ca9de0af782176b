#include "raw_stream.h"

#include "generators.h"
#include "support/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <csignal>
#include <vector>

namespace lab03 {
namespace {

/// Writes all bytes; returns false when nobody reads any more.
bool write_all(const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(STDOUT_FILENO, bytes, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      if (errno == EPIPE) return false;
      throw carlo::Error(fmt::format("standard output: cannot write ({})",
                                     std::generic_category().message(errno)));
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

void little_end_first(std::vector<std::uint32_t>& words) {
  if constexpr (std::endian::native == std::endian::big) {
    for (std::uint32_t& word : words)
      word = word >> 24 | (word >> 8 & 0xFF00) | (word << 8 & 0xFF0000) | word << 24;
  }
}

}  // namespace

void write_raw_stream(const std::string& key, std::uint64_t seed) {
  const Fill fill = find_generator(key).make(seed);
  if (::isatty(STDOUT_FILENO) != 0) {
    throw carlo::Error(
        "--stream writes raw words: send them into a program, such as "
        "`| dieharder -a -g 200`");
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::vector<std::uint32_t> words(1 << 14);
  do {
    fill(words);
    little_end_first(words);
  } while (write_all(reinterpret_cast<const char*>(words.data()), words.size() * sizeof words[0]));
}

}  // namespace lab03
