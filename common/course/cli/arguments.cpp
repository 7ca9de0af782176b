#include "course/cli/arguments.h"

#include "course/cli/command_line.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <type_traits>

namespace carlo {
namespace {

namespace fs = std::filesystem;

template <class T>
bool read_one(const std::string& word, T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    const std::optional<T> number = number_of<T>(word);
    if (number) value = *number;
    return number.has_value();
  } else {
    value = word;
    return true;
  }
}

template <class T>
bool read_words(const std::vector<std::string>& words, T& value) {
  return read_one(words.empty() ? "" : words.back(), value);
}

template <class T>
bool read_words(const std::vector<std::string>& words, std::optional<T>& value) {
  return read_words(words, value.emplace());
}

template <class T>
bool read_words(const std::vector<std::string>& words, std::vector<T>& list) {
  list.resize(words.size());
  for (std::size_t i = 0; i < words.size(); ++i)
    if (!read_one(words[i], list[i])) return false;
  return true;
}

std::string shown(const std::string& value) {
  return value;
}

std::string shown(const fs::path& value) {
  return value.string();
}

template <class T>
std::string shown(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) return fmt::format("{}", value);
  return "";
}

/// Formats an end of a range briefly: 1e+15.
template <class Number>
std::string shown_end(Number value) {
  if constexpr (std::is_floating_point_v<Number>) return fmt::format("{:g}", value);
  return fmt::format("{}", value);
}

/// The element type of a list or optional; any other type itself.
template <class T>
struct Held {
  using type = T;
};
template <class T>
struct Held<std::optional<T>> {
  using type = T;
};
template <class T>
struct Held<std::vector<T>> {
  using type = T;
};

template <class One>
std::string expected() {
  if constexpr (std::is_floating_point_v<One>) return "a number";
  // A number beyond the largest is described as a whole number from 0, too.
  if constexpr (std::is_unsigned_v<One>)
    return fmt::format("a whole number from 0 to {}", std::numeric_limits<One>::max());
  return std::is_integral_v<One> ? "a whole number" : "text";
}

template <class T>
CommandLineOption::Variable variable(T& value) {
  using One = typename Held<T>::type;
  CommandLineOption::Variable result;
  result.place = &value;
  result.read = [](const std::vector<std::string>& words, void* place) {
    return read_words(words, *static_cast<T*>(place));
  };
  result.shown = [](const void* place) { return shown(*static_cast<const T*>(place)); };
  result.type = std::is_floating_point_v<One> ? "NUMBER" : std::is_integral_v<One> ? "N" : "TEXT";
  result.expected = expected<One>();
  return result;
}

}  // namespace

Argument Argument::required() {
  option_->is_required = true;
  return *this;
}

Argument Argument::show_default() {
  option_->default_text = option_->variable.shown(option_->variable.place);
  return *this;
}

Argument Argument::default_value(const std::string& text) {
  option_->default_text = text;
  if (!option_->variable.read({text}, option_->variable.place)) {
    throw std::logic_error(option_->called() + " cannot be " + text);
  }
  return *this;
}

template <class Number>
Argument Argument::range(Number lowest, Number highest) {
  const auto holds = [lowest, highest](const std::string& word) {
    Number value{};
    return read_one(word, value) && lowest <= value && value <= highest;
  };
  option_->limits = fmt::format("from {} to {}", shown_end(lowest), shown_end(highest));
  option_->checks.push_back(
      {holds, fmt::format("{} {}", std::is_integral_v<Number> ? "a whole number" : "a number",
                          option_->limits)});
  return *this;
}

template Argument Argument::range(int, int);
template Argument Argument::range(unsigned, unsigned);
template Argument Argument::range(std::int64_t, std::int64_t);
template Argument Argument::range(double, double);

Argument Argument::one_of(const std::vector<std::string>& words) {
  const auto holds = [words](const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  option_->variable.type = fmt::format("{}", fmt::join(words, "|"));
  option_->checks.push_back({holds, fmt::format("one of {}", fmt::join(words, ", "))});
  return *this;
}

Argument Argument::existing_file() {
  option_->checks.push_back(
      {[](const std::string& word) { return fs::is_regular_file(word); }, "an existing file"});
  return *this;
}

Argument Argument::existing_folder() {
  option_->checks.push_back(
      {[](const std::string& word) { return fs::is_directory(word); }, "a folder that is there"});
  return *this;
}

Argument Argument::list(char separator, bool more) {
  option_->separator = separator;
  if (!more) option_->most = 1;
  return *this;
}

Argument Argument::words(int least, int most) {
  option_->least = least;
  option_->most = most;
  return *this;
}

Argument Argument::type_name(const std::string& name) {
  option_->variable.type = name;
  return *this;
}

Argument Argument::excludes(Argument other) {
  option_->excluded.push_back(other.option_);
  return *this;
}

Argument Argument::hidden() {
  option_->is_hidden = true;
  return *this;
}

bool Argument::given() const {
  return option_->count > 0;
}

CommandLine::CommandLine(const std::string& about, const std::string& program)
    : own_(std::make_unique<CommandLineVerb>()), verb_(own_.get()) {
  verb_->about = about;
  verb_->name = program;
}

CommandLine::CommandLine(CommandLineVerb& verb) : verb_(&verb) {}

CommandLine::CommandLine(CommandLine&&) noexcept = default;
CommandLine& CommandLine::operator=(CommandLine&&) noexcept = default;
CommandLine::~CommandLine() = default;

template <class T>
Argument CommandLine::option(std::string_view name, T& value, std::string_view about) {
  CommandLineOption& option = verb_->options.emplace_back();
  option.names = name;
  option.about = about;
  option.variable = variable(value);
  option.is_list = !std::is_same_v<typename Held<T>::type, T> &&
                   !std::is_same_v<std::optional<typename Held<T>::type>, T>;
  if (option.is_list) option.most = 1 << 30;
  return Argument(option);
}

// The types that the programs of this tree need; a missing one is a linker error.
#define CARLO_OPTION(...) \
  template Argument CommandLine::option(std::string_view, __VA_ARGS__&, std::string_view)
CARLO_OPTION(std::string);
CARLO_OPTION(std::filesystem::path);
CARLO_OPTION(int);
CARLO_OPTION(unsigned);
CARLO_OPTION(std::int64_t);
CARLO_OPTION(std::uint64_t);
CARLO_OPTION(double);
CARLO_OPTION(std::optional<std::string>);
CARLO_OPTION(std::optional<int>);
CARLO_OPTION(std::optional<unsigned>);
CARLO_OPTION(std::optional<std::uint64_t>);
CARLO_OPTION(std::optional<double>);
CARLO_OPTION(std::vector<std::string>);
CARLO_OPTION(std::vector<int>);
CARLO_OPTION(std::vector<std::uint64_t>);
#undef CARLO_OPTION

Argument CommandLine::flag(std::string_view name, bool& value, std::string_view about) {
  CommandLineOption& option = verb_->options.emplace_back();
  option.names = name;
  option.about = about;
  option.variable.place = &value;
  option.variable.read = [](const std::vector<std::string>&, void* place) {
    return *static_cast<bool*>(place) = true;
  };
  option.variable.shown = [](const void*) { return std::string(); };
  option.least = option.most = 0;
  return Argument(option);
}

CommandLine CommandLine::verb(std::string_view name, std::string_view about) {
  CommandLineVerb& added = verb_->verbs.emplace_back();
  added.name = name;
  added.about = about;
  return CommandLine(added);
}

bool CommandLine::chosen() const {
  return verb_->chosen;
}

void CommandLine::footer(const std::string& text) {
  verb_->footer = text;
}

std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
  if (verb_->name.empty() && argc > 0) verb_->name = argv[0];
  const auto program = [&] {
    const auto verb = std::find_if(verb_->verbs.begin(), verb_->verbs.end(),
                                   [](const CommandLineVerb& one) { return one.chosen; });
    return verb_->name + (verb == verb_->verbs.end() ? "" : " " + verb->name);
  };
  try {
    const CommandLineVerb* asked = parse_words(*verb_, {argv + std::min(argc, 1), argv + argc});
    if (asked == nullptr) return std::nullopt;
    print_help(*asked, program());
    return 0;
  } catch (const Error& error) {
    throw Error("{} (see {} --help)", error.what(), program());
  }
}

}  // namespace carlo
