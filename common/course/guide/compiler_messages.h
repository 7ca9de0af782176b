#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// One message of the compiler or the linker.
struct CompilerMessage {
  enum class Whose {
    own,       ///< in a file that a student writes
    caused,    ///< elsewhere, but caused by a line of such a file
    elsewhere  ///< neither
  };
  bool error = true;  ///< else a warning
  Whose whose = Whose::elsewhere;
  std::string file;  ///< relative to the tree if inside it; for `caused`: the student's
  std::size_t line = 0, column = 0;  ///< from 1; 0 when unknown
  std::string text;                  ///< without most of the templates' noise
  std::string found_in;              ///< for `caused`: the other file and line
  std::vector<std::string> excerpt;  ///< the source line and the marker line below it
};

/// Returns the messages worth showing from a build's output (GCC's or Clang's, GNU ld's and lld's),
/// each once: errors before warnings, missing returns before other warnings, those in a student's
/// files first, otherwise in order. Empty if nothing is recognised.
std::vector<CompilerMessage> compiler_messages(std::string_view log,
                                               const std::filesystem::path& root);

/// Formats the first `most` messages in full and counts the rest; shows warnings only if there is
/// no error. In colour if stdout shows it.
std::string compiler_text(const std::vector<CompilerMessage>& messages, std::size_t most);

/// Returns the last lines of a build log without its commands, for when nothing in it is
/// recognised.
std::string plain_log(std::string_view log, std::size_t lines);

}  // namespace carlo
