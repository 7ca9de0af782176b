#include "course/cli/command_line.h"
#include "course/cli/wrap.h"

#include <fmt/core.h>

#include <algorithm>

namespace carlo {
namespace {

/// The column where descriptions begin, unless an option's name is longer.
constexpr std::size_t column = 28;

/// "-o, --output TEXT"
std::string left_side(const CommandLineOption& option) {
  std::string text = option.names;
  if (const std::size_t comma = text.find(','); comma != std::string::npos)
    text.insert(comma + 1, " ");
  if (option.most == 0 || option.has_place()) return text;
  const std::string& type = option.variable.type;
  text += option.least == 0 ? " [" + type + "]" : " " + type;
  return text + (option.is_list && option.separator == 0 ? " ..." : "");
}

/// Describes an option: what it does, its limits and its default.
std::string right_side(const CommandLineOption& option) {
  std::string text = option.about;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (!option.limits.empty()) add(option.limits);
  if (option.default_text && !option.default_text->empty()) add("default: " + *option.default_text);
  if (option.is_required) add("required");
  return text;
}

/// Joins both sides into lines that fit the terminal and 100 columns.
std::string line(const std::string& left, const std::string& right) {
  const std::string head = "  " + left;
  if (right.empty()) return head + "\n";
  const int terminal = stdout_columns();
  const std::string text =
      wrapped_to(std::string(column, ' ') + right, terminal > 0 ? std::min(terminal, 100) : 100);
  if (head.size() + 2 > column) return head + "\n" + text;
  return head + text.substr(head.size());
}

template <class Wanted>
std::string lines(const char* heading, const CommandLineVerb& verb, const Wanted& wanted) {
  std::string text;
  for (const CommandLineOption& option : verb.options)
    if (!option.is_hidden && wanted(option)) text += line(left_side(option), right_side(option));
  return text.empty() ? text : fmt::format("\n{}:\n{}", heading, text);
}

std::string usage(const CommandLineVerb& verb, const std::string& program) {
  std::string text = "usage: " + program;
  if (!verb.verbs.empty()) return text + " VERB [options]\n";
  if (!verb.options.empty()) text += " [options]";
  for (const CommandLineOption& option : verb.options) {
    if (!option.has_place() || option.is_hidden) continue;
    const std::string name = option.names + (option.is_list ? " ..." : "");
    text += option.is_required ? " " + name : " [" + name + "]";
  }
  return text + "\n";
}

}  // namespace

void print_help(const CommandLineVerb& verb, const std::string& program) {
  std::string text = usage(verb, program) + "\n" + verb.about + "\n";
  std::string verbs;
  for (const CommandLineVerb& one : verb.verbs)
    verbs += line(one.name, one.about);
  if (!verbs.empty()) text += "\nVerbs:\n" + verbs;
  text += lines("In this order", verb, [](const auto& option) { return option.has_place(); });
  text += lines("Options", verb, [](const auto& option) { return !option.has_place(); });
  if (!verb.footer.empty()) text += "\n" + verb.footer + "\n";
  fmt::print("{}", wrapped(text));
}

}  // namespace carlo
