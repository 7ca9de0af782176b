#pragma once

#include <nettle/sha2.h>

#include <string>
#include <string_view>

namespace carlo::grader {

/// SHA-256 of what is added piece by piece. It tells whether a submission, the grader or the secret
/// has changed since a mark was given.
class Sha256 {
 public:
  Sha256() { sha256_init(&state_); }

  void add(std::string_view bytes);
  /// Adds a text so that it cannot run into the next one.
  void add_text(std::string_view text);
  /// The digest of all that was added, in hexadecimal. To be called once, at the end.
  std::string hex();

 private:
  sha256_ctx state_{};
};

/// The digest of one text.
std::string sha256(std::string_view text);

}  // namespace carlo::grader
