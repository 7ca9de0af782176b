#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// One complaint of the compiler or the linker.
struct CompilerMessage {
  enum class Whose {
    own,       ///< it stands in a file that a student writes
    caused,    ///< elsewhere, but a line of such a file led there
    elsewhere  ///< neither
  };
  bool error = true;  ///< else a warning
  Whose whose = Whose::elsewhere;
  std::string file;  ///< relative to the tree where it lies in it; of `caused`: the student's
  std::size_t line = 0, column = 0;  ///< from 1; 0 when unknown
  std::string text;                  ///< without most of the templates' noise
  std::string found_in;              ///< of `caused`: the other file and line
  std::vector<std::string> excerpt;  ///< the source line and what marks the place below it
};

/// What is worth telling of a build's output (GCC's or Clang's words, GNU ld's and lld's): errors
/// before warnings, missing returns before other warnings, those in a student's files first, each
/// in the order in which they were found and once. Empty when nothing is recognised.
std::vector<CompilerMessage> compiler_messages(std::string_view log,
                                               const std::filesystem::path& root);

/// The first `most` messages in full and how many there are more, warnings only where there is no
/// error; in colour where stdout shows it.
std::string compiler_text(const std::vector<CompilerMessage>& messages, std::size_t most);

/// A build's log as a person wants it when nothing in it is recognised: its last lines, without the
/// commands.
std::string plain_log(std::string_view log, std::size_t lines);

}  // namespace carlo
