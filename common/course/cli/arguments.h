#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

struct CommandLineOption;
struct CommandLineVerb;

/// One option of a CommandLine, for what else is to be said of it. A value that is not as required
/// is told in one line that names the option, the value and what was expected.
class Argument {
 public:
  explicit Argument(CommandLineOption& option) : option_(&option) {}

  Argument required();
  /// The variable's value is the default; --help shows it.
  Argument show_default();
  /// Another default than the variable's value; --help shows it.
  Argument default_value(const std::string& text);
  /// Numbers from `lowest` to `highest`, both among them.
  template <class Number>
  Argument range(Number lowest, Number highest);
  Argument one_of(const std::vector<std::string>& words);
  Argument existing_file();
  Argument existing_folder();
  /// A list in one word, its values apart by `separator`; more words only where `more` says so.
  Argument list(char separator, bool more = true);
  /// How many words follow; what --help calls them.
  Argument words(int least, int most);
  Argument type_name(const std::string& name);
  Argument excludes(Argument other);
  /// Not in --help.
  Argument hidden();

  /// Whether it stood on the command line.
  bool given() const;

 private:
  CommandLineOption* option_;
};

/// A program's options: what they are called, where their values go, and --help. "--name value" or
/// "--name=value", "-o value" or "-ovalue"; a word that begins with a dash and a letter is no value
/// but of "--name=value". What stands behind "--" has its place alone.
///
/// Ours, because every student's first verdict waits until it is compiled; a library took longer
/// than anything else there.
class CommandLine {
 public:
  /// `program` is what a user types to start it.
  explicit CommandLine(const std::string& about, const std::string& program = "");
  CommandLine(CommandLine&&) noexcept;
  CommandLine& operator=(CommandLine&&) noexcept;
  ~CommandLine();

  /// A name such as "--seed" or "-o,--output"; without dashes its place on the line counts. T:
  /// text, bool, a number, std::optional of these, or a std::vector for a list.
  template <class T>
  Argument option(std::string_view name, T& value, std::string_view about = "");
  Argument flag(std::string_view name, bool& value, std::string_view about);

  /// One of several verbs, of which one must be named; it has options of its own.
  CommandLine verb(std::string_view name, std::string_view about);
  /// Whether this verb was named.
  bool chosen() const;

  /// The last line of --help.
  void footer(const std::string& text);

  /// Parses. Returns an exit code when the program is done already (after --help); throws Error,
  /// one line that ends in how to get help, for a bad command line.
  std::optional<int> parse(int argc, const char* const* argv);

 private:
  explicit CommandLine(CommandLineVerb& verb);

  std::unique_ptr<CommandLineVerb> own_;  ///< none for a verb: its program owns it
  CommandLineVerb* verb_;
};

}  // namespace carlo
