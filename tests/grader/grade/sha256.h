#pragma once

#include <nettle/sha2.h>

#include <string>
#include <string_view>

namespace carlo::grader {

/// SHA-256 of what is added piece by piece. It shows whether a submission, the grader or the secret
/// has changed since marks were given.
class Sha256 {
 public:
  Sha256() { sha256_init(&state_); }

  void add(std::string_view bytes);
  /// Adds a text so that it cannot merge with the next one.
  void add_text(std::string_view text);
  /// Returns the digest of everything added, in hexadecimal. Call once, at the end.
  std::string hex();

 private:
  sha256_ctx state_{};
};

/// Returns the digest of one text.
std::string sha256(std::string_view text);

}  // namespace carlo::grader
