#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

struct CommandLineOption;
struct CommandLineVerb;

/// One option of a CommandLine, for further settings. An invalid value is reported in one line that
/// names the option, the value and what was expected.
class Argument {
 public:
  explicit Argument(CommandLineOption& option) : option_(&option) {}

  Argument required();
  /// Shows the variable's value in --help as the default.
  Argument show_default();
  /// Shows `text` in --help as the default, not the variable's value.
  Argument default_value(const std::string& text);
  /// Accepts numbers from `lowest` to `highest`, inclusive.
  template <class Number>
  Argument range(Number lowest, Number highest);
  Argument one_of(const std::vector<std::string>& words);
  Argument existing_file();
  Argument existing_folder();
  /// Accepts a list in one word, its values separated by `separator`; several words only if `more`.
  Argument list(char separator, bool more = true);
  /// The number of words that follow, and their names in --help.
  Argument words(int least, int most);
  Argument type_name(const std::string& name);
  Argument excludes(Argument other);
  /// Hides the option from --help.
  Argument hidden();

  /// Returns whether the option was on the command line.
  bool given() const;

 private:
  CommandLineOption* option_;
};

/// A program's options: their names, the variables that take their values, and --help. Accepts
/// "--name value" or "--name=value", "-o value" or "-ovalue"; a word that begins with a dash and a
/// letter is a value only in "--name=value". Words after "--" are positional only.
///
/// Not a library: every student's first verdict waits until this is compiled, and a library took
/// most of that time.
class CommandLine {
 public:
  /// `program` is the command that a user types to start it.
  explicit CommandLine(const std::string& about, const std::string& program = "");
  CommandLine(CommandLine&&) noexcept;
  CommandLine& operator=(CommandLine&&) noexcept;
  ~CommandLine();

  /// `names` is such as "--seed" or "-o,--output"; without dashes the option is positional. T:
  /// text, bool, a number, std::optional of these, or a std::vector for a list.
  template <class T>
  Argument option(std::string_view name, T& value, std::string_view about = "");
  Argument flag(std::string_view name, bool& value, std::string_view about);

  /// Adds a verb with options of its own. If there are verbs, one must be named.
  CommandLine verb(std::string_view name, std::string_view about);
  /// Returns whether this verb was named.
  bool chosen() const;

  /// Sets the last line of --help.
  void footer(const std::string& text);

  /// Parses. Returns an exit code if the program is already done (after --help). Throws Error for
  /// an invalid command line: one line that ends with how to get help.
  std::optional<int> parse(int argc, const char* const* argv);

 private:
  explicit CommandLine(CommandLineVerb& verb);

  std::unique_ptr<CommandLineVerb> own_;  ///< null for a verb: its program owns it
  CommandLineVerb* verb_;
};

}  // namespace carlo
