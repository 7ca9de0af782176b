#include "course/cli/command_line.h"

#include "support/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

namespace carlo {
namespace {

bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

/// Assigns the words of a command line to the options of a verb.
class Parser {
 public:
  Parser(CommandLineVerb& verb, std::vector<std::string> words)
      : verb_(verb), words_(std::move(words)) {}

  /// Returns the verb that --help asks about, if one does.
  const CommandLineVerb* parse() {
    while (at_ < words_.size()) {
      const std::string& word = words_[at_];
      if (options_end_ || !looks_like_option(word)) {
        take_place(word);
      } else if (word == "--") {
        options_end_ = true;
        ++at_;
      } else if (word == "-h" || word == "--help") {
        return &verb_;
      } else {
        take_option(word);
      }
      if (chosen_ != nullptr) {
        return Parser(*chosen_, {words_.begin() + static_cast<std::ptrdiff_t>(at_), words_.end()})
            .parse();
      }
    }
    if (!verb_.verbs.empty()) throw Error("which verb? There are {}", names_of(verb_.verbs));
    for (CommandLineOption& option : verb_.options)
      finish(option);
    return nullptr;
  }

 private:
  void take_option(const std::string& word) {
    std::string name = word, value;
    bool has_value = false;
    if (const std::size_t equals = word.find('='); word[1] == '-' && equals != std::string::npos) {
      name = word.substr(0, equals);
      value = word.substr(equals + 1);
      has_value = true;
    } else if (word[1] != '-' && word.size() > 2) {
      name = word.substr(0, 2);
      value = word.substr(2);
      has_value = true;
    }
    CommandLineOption* option = verb_.find(name);
    if (option == nullptr) throw Error("there is no option {}", name);
    ++at_;
    if (option->count++ > 0 && !option->is_list && option->most > 0) {
      throw Error("{}: given twice", name);
    }
    if (has_value) {
      if (option->most == 0) throw Error("{}: takes no value, got {}", name, value);
      add(*option, value);
    }
    take_values(*option, has_value ? 1 : 0);
  }

  /// Takes the words after an option that belong to it.
  void take_values(CommandLineOption& option, int taken) {
    const bool alone = taken > 0 && option.least <= 1;  // as in --labs=1 FOLDER
    while (!alone && taken < option.most && at_ < words_.size() &&
           !looks_like_option(words_[at_])) {
      add(option, words_[at_++]);
      ++taken;
    }
    if (taken < option.least) {
      throw Error("{}: expected {}, got {}", option.called(),
                  option.least == 1 ? "a value" : fmt::format("{} values", option.least),
                  taken == 0 ? "none" : std::to_string(taken));
    }
  }

  void take_place(const std::string& word) {
    ++at_;
    for (CommandLineVerb& verb : verb_.verbs) {
      if (verb.name == word) {
        verb.chosen = true;
        chosen_ = &verb;
        return;
      }
    }
    if (!verb_.verbs.empty()) {
      throw Error("there is no verb {}; there are {}", word, names_of(verb_.verbs));
    }
    for (CommandLineOption& option : verb_.options) {
      if (!option.has_place() || (option.count > 0 && !option.is_list)) continue;
      ++option.count;
      add(option, word);
      return;
    }
    throw Error("unexpected argument: {}", word);
  }

  static void add(CommandLineOption& option, const std::string& word) {
    for (std::size_t begin = 0; begin <= word.size();) {
      const std::size_t end = option.separator == 0
                                  ? word.size()
                                  : std::min(word.find(option.separator, begin), word.size());
      option.words.push_back(word.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  static void finish(CommandLineOption& option) {
    if (option.count == 0) {
      if (option.is_required) throw Error("{} is missing: {}", option.called(), option.about);
      return;
    }
    for (const CommandLineOption* other : option.excluded)
      if (other->count > 0)
        throw Error("{} and {} cannot be used together", option.called(), other->called());
    for (const std::string& word : option.words)
      for (const CommandLineOption::Check& check : option.checks)
        if (!check.holds(word)) fail(option, check.expected, word);
    if (!option.variable.read(option.words, option.variable.place)) {
      fail(option, option.variable.expected, fmt::format("{}", fmt::join(option.words, " ")));
    }
  }

  [[noreturn]] static void fail(const CommandLineOption& option, const std::string& expected,
                                const std::string& got) {
    throw Error("{}: expected {}, got {}", option.called(), expected,
                got.empty() ? "nothing" : got);
  }

  static std::string names_of(const std::list<CommandLineVerb>& verbs) {
    std::vector<std::string> names;
    std::transform(verbs.begin(), verbs.end(), std::back_inserter(names),
                   [](const CommandLineVerb& verb) { return verb.name; });
    return fmt::format("{}", fmt::join(names, ", "));
  }

  CommandLineVerb& verb_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  bool options_end_ = false;
  CommandLineVerb* chosen_ = nullptr;
};

}  // namespace

CommandLineOption* CommandLineVerb::find(const std::string& wanted) {
  const auto found =
      std::find_if(options.begin(), options.end(), [&](const CommandLineOption& option) {
        return !option.has_place() &&
               ("," + option.names + ",").find("," + wanted + ",") != std::string::npos;
      });
  return found == options.end() ? nullptr : &*found;
}

const CommandLineVerb* parse_words(CommandLineVerb& verb, const std::vector<std::string>& words) {
  return Parser(verb, words).parse();
}

}  // namespace carlo
