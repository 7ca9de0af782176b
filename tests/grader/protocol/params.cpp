#include "grader/protocol/params.h"

#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace carlo::grader {

namespace {

/// Splits a text into its words "name=value".
class Words {
 public:
  explicit Words(std::string_view text) : all_(text), rest_(text) {}

  bool done() const { return rest_.empty(); }

  template <class Number>
  std::pair<std::string, Number> next() {
    const std::string_view word = rest_.substr(0, rest_.find(' '));
    rest_.remove_prefix(std::min(word.size() + 1, rest_.size()));
    const std::size_t equals = word.find('=');
    if (equals == 0 || equals == std::string_view::npos) complain();
    const std::string_view digits = word.substr(equals + 1);
    const std::optional<Number> value = number_of<Number>(digits);
    if (!value) complain();
    return {std::string(word.substr(0, equals)), *value};
  }

  template <class Number>
  Number next(std::string_view expected) {
    const auto [name, value] = next<Number>();
    if (name != expected) complain();
    return value;
  }

  [[noreturn]] void complain() const {
    throw Error("bad parameters \"{}\": expected \"seed=1 n=2 name=0.5\"", all_);
  }

 private:
  std::string_view all_, rest_;
};

}  // namespace

double Params::operator[](const std::string& name) const {
  const auto found = numbers.find(name);
  if (found == numbers.end()) throw Error("the probe needs the number \"{}\"", name);
  return found->second;
}

std::int64_t Params::whole(const std::string& name) const {
  const double value = (*this)[name];
  if (!(std::abs(value) < 0x1p53) || value != std::floor(value)) {
    throw Error("the probe needs a whole number \"{}\", got {}", name, value);
  }
  return static_cast<std::int64_t>(value);
}

std::string to_text(const Params& params) {
  std::string text = fmt::format("seed={} n={}", params.seed, params.n);
  for (const auto& [name, value] : params.numbers) {
    if (name.empty() || name.find_first_of(" =") != std::string::npos) {
      throw Error("a parameter's name is one word without '=', got \"{}\"", name);
    }
    text += fmt::format(" {}={}", name, value);
  }
  return text;
}

Params params_from_text(std::string_view text) {
  Params params;
  Words words(text);
  params.seed = words.next<std::uint64_t>("seed");
  params.n = words.next<std::int64_t>("n");
  while (!words.done()) {
    const auto [name, value] = words.next<double>();
    if (!params.numbers.emplace(name, value).second) words.complain();
  }
  return params;
}

}  // namespace carlo::grader
