#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// What a CommandLine knows of one option.
struct CommandLineOption {
  /// Where its values go, whatever the type is.
  struct Variable {
    void* place = nullptr;
    /// Whether the words are as the type wants them; sets the variable.
    bool (*read)(const std::vector<std::string>& words, void* place) = nullptr;
    std::string (*shown)(const void* place) = nullptr;
    std::string type;      ///< in --help
    std::string expected;  ///< in complaints
  };
  struct Check {
    std::function<bool(const std::string& word)> holds;
    std::string expected;
  };

  std::string names;  ///< "-o,--output", or "scene" where its place counts
  std::string about;
  Variable variable;
  std::vector<Check> checks;
  std::string limits;                       ///< what the checks allow, in --help
  std::optional<std::string> default_text;  ///< in --help
  std::vector<const CommandLineOption*> excluded;
  int least = 1, most = 1;  ///< words behind it
  char separator = 0;       ///< of several values in one word
  bool is_list = false, is_required = false, is_hidden = false;

  int count = 0;  ///< how often it stood on the command line, with what words
  std::vector<std::string> words;

  bool has_place() const { return names[0] != '-'; }
  /// The longest of its names.
  std::string called() const { return names.substr(names.rfind(',') + 1); }
};

/// A program, or one of its verbs.
struct CommandLineVerb {
  std::string name, about, footer;
  std::list<CommandLineOption> options;  ///< stay where they are: Arguments point at them
  std::list<CommandLineVerb> verbs;
  bool chosen = false;

  /// By one of its names; null when there is none.
  CommandLineOption* find(const std::string& name);
};

/// Takes a command line's words, without the program's, for the verb's options and sets their
/// variables. Returns the verb whose --help is asked for; null when none is. Throws Error.
const CommandLineVerb* parse_words(CommandLineVerb& verb, const std::vector<std::string>& words);

/// Prints to stdout: what the verb does, its places and its options. `program`: how it is called.
void print_help(const CommandLineVerb& verb, const std::string& program);

}  // namespace carlo
