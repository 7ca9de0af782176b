#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// One option of a CommandLine.
struct CommandLineOption {
  /// The variable that takes an option's values, whatever its type.
  struct Variable {
    void* place = nullptr;
    /// Parses the words and sets the variable. Returns false if they do not suit the type.
    bool (*read)(const std::vector<std::string>& words, void* place) = nullptr;
    std::string (*shown)(const void* place) = nullptr;
    std::string type;      ///< in --help
    std::string expected;  ///< in error messages
  };
  struct Check {
    std::function<bool(const std::string& word)> holds;
    std::string expected;
  };

  std::string names;  ///< "-o,--output", or "scene" if positional
  std::string about;
  Variable variable;
  std::vector<Check> checks;
  std::string limits;                       ///< what the checks allow, in --help
  std::optional<std::string> default_text;  ///< in --help
  std::vector<const CommandLineOption*> excluded;
  int least = 1, most = 1;  ///< number of words after it
  char separator = 0;       ///< between several values in one word
  bool is_list = false, is_required = false, is_hidden = false;

  int count = 0;  ///< how often it was on the command line, and with which words
  std::vector<std::string> words;

  bool has_place() const { return names[0] != '-'; }
  /// Returns the longest of its names.
  std::string called() const { return names.substr(names.rfind(',') + 1); }
};

/// A program, or one of its verbs.
struct CommandLineVerb {
  std::string name, about, footer;
  std::list<CommandLineOption> options;  ///< a list, because Arguments point at the elements
  std::list<CommandLineVerb> verbs;
  bool chosen = false;

  /// Finds an option by one of its names; null if there is none.
  CommandLineOption* find(const std::string& name);
};

/// Assigns a command line's words, without the program's name, to the verb's options and sets their
/// variables. Returns the verb whose --help is requested; null if none is. Throws Error.
const CommandLineVerb* parse_words(CommandLineVerb& verb, const std::vector<std::string>& words);

/// Prints to stdout what the verb does, its positional arguments and its options. `program`: how it
/// is called.
void print_help(const CommandLineVerb& verb, const std::string& program);

}  // namespace carlo
