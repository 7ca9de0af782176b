#include "cli/arguments.h"

#include "cli/error.h"
#include "cli/number.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <type_traits>

namespace carlo {
namespace {

// CLI11 is given words and gives words: its own templates for values would be compiled for each
// type.

template <class Number>
bool read(const std::string& text, Number& value) {
  if constexpr (std::is_arithmetic_v<Number>) {
    const std::optional<Number> number = number_of<Number>(text);
    if (number) value = *number;
    return number.has_value();
  } else {
    value = text;
    return true;
  }
}

template <class T>
bool read(const std::vector<std::string>& words, T& value) {
  return read(words.empty() ? "" : words.back(), value);
}

template <class T>
bool read(const std::vector<std::string>& words, std::optional<T>& value) {
  return read(words.empty() ? "" : words.back(), value.emplace());
}

template <class T>
bool read(const std::vector<std::string>& words, std::vector<T>& list) {
  list.clear();
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return read(word, list.emplace_back()); });
}

template <class T>
std::string shown(const T& value) {
  return fmt::format("{}", value);
}

/// An end of a range, in short: 1e+15.
template <class Number>
std::string shown_end(Number value) {
  if constexpr (std::is_floating_point_v<Number>) return fmt::format("{:g}", value);
  return fmt::format("{}", value);
}

std::string shown(const std::filesystem::path& value) {
  return value.string();
}

template <class T>
std::string shown(const std::optional<T>& value) {
  return value ? shown(*value) : "";
}

template <class T>
std::string shown(const std::vector<T>& list) {
  return fmt::format("[{}]", fmt::join(list, ","));
}

template <class T>
bool is_list(const T&) {
  return false;
}

template <class T>
bool is_list(const std::vector<T>&) {
  return true;
}

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

template <class T>
const char* type_name_of() {
  using Value = typename Held<T>::type;
  if (std::is_floating_point_v<Value>) return "FLOAT";
  if (std::is_unsigned_v<Value>) return "UINT";
  return std::is_integral_v<Value> ? "INT" : "TEXT";
}

}  // namespace

Argument Argument::required() {
  option_->required();
  return *this;
}

Argument Argument::show_default() {
  option_->capture_default_str();
  return *this;
}

Argument Argument::default_value(const std::string& text) {
  option_->default_val(text);
  return *this;
}

template <class Number>
Argument Argument::range(Number lowest, Number highest) {
  option_->check(CLI::Validator(
      [=](const std::string& text) {
        Number value{};
        return read(text, value) && lowest <= value && value <= highest
                   ? std::string()
                   : fmt::format("Value {} not in range {} to {}", text, shown_end(lowest),
                                 shown_end(highest));
      },
      fmt::format("{} in [{} - {}]", type_name_of<Number>(), shown_end(lowest), shown_end(highest)),
      "range"));
  return *this;
}

template Argument Argument::range(int, int);
template Argument Argument::range(unsigned, unsigned);
template Argument Argument::range(std::int64_t, std::int64_t);
template Argument Argument::range(double, double);

Argument Argument::one_of(const std::vector<std::string>& words) {
  const std::string all = fmt::format("{{{}}}", fmt::join(words, ","));
  option_->check(CLI::Validator(
      [words, all](const std::string& text) {
        return std::find(words.begin(), words.end(), text) != words.end()
                   ? std::string()
                   : fmt::format("{} not in {}", text, all);
      },
      all, "words"));
  return *this;
}

Argument Argument::existing_file() {
  option_->check(CLI::ExistingFile);
  return *this;
}

Argument Argument::existing_folder() {
  option_->check(CLI::ExistingDirectory);
  return *this;
}

Argument Argument::list(char separator, bool more) {
  option_->delimiter(separator)->allow_extra_args(more);
  return *this;
}

Argument Argument::words(int least, int most) {
  option_->expected(least, most);
  return *this;
}

Argument Argument::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Argument Argument::excludes(Argument other) {
  option_->excludes(other.option_);
  return *this;
}

Argument Argument::hidden() {
  option_->group("");
  return *this;
}

bool Argument::given() const {
  return option_->count() > 0;
}

CommandLine::CommandLine(const std::string& about, const std::string& program)
    : own_(std::make_unique<CLI::App>(about, program)), app_(own_.get()) {}

CommandLine::CommandLine(CLI::App* verb) : app_(verb) {}

CommandLine::CommandLine(CommandLine&&) noexcept = default;
CommandLine& CommandLine::operator=(CommandLine&&) noexcept = default;
CommandLine::~CommandLine() = default;

template <class T>
Argument CommandLine::option(const std::string& name, T& value, const std::string& about) {
  CLI::Option* option = app_->add_option(
      name, [&value](const std::vector<std::string>& words) { return read(words, value); }, about,
      false, [&value] { return shown(value); });
  option->type_name(type_name_of<T>())->run_callback_for_default();
  if (is_list(value)) option->expected(CLI::detail::expected_max_vector_size);
  return Argument(option);
}

// What the programs of this tree need; a type that is missing is an error of the linker.
#define CARLO_OPTION(...) \
  template Argument CommandLine::option(const std::string&, __VA_ARGS__&, const std::string&)
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

Argument CommandLine::flag(const std::string& name, bool& value, const std::string& about) {
  return Argument(app_->add_flag(name, value, about));
}

CommandLine CommandLine::verb(const std::string& name, const std::string& about) {
  app_->require_subcommand(1);
  return CommandLine(app_->add_subcommand(name, about));
}

bool CommandLine::chosen() const {
  return app_->parsed();
}

void CommandLine::footer(const std::string& text) {
  app_->footer(text);
}

std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app_->exit(request);
  } catch (const CLI::ParseError& error) {
    std::string program = app_->get_name();
    for (const CLI::App* verb : app_->get_subcommands())
      program += " " + verb->get_name();
    throw Error("{} (see {} --help)", error.what(), program);
  }
  return std::nullopt;
}

}  // namespace carlo
