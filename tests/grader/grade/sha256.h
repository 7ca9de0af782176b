#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace carlo::grader {

/// SHA-256 (FIPS 180-4) of what is added piece by piece. It tells whether a submission, the grader
/// or the secret has changed since a mark was given.
class Sha256 {
 public:
  void add(std::string_view bytes);
  /// Adds a text so that it cannot run into the next one.
  void add_text(std::string_view text);
  /// The digest of all that was added, in hexadecimal. To be called once, at the end.
  std::string hex();

 private:
  void block(const unsigned char* bytes);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::uint64_t length_ = 0;
  std::string rest_;
};

/// The digest of one text.
std::string sha256(std::string_view text);

}  // namespace carlo::grader
