#include "grader/replay/pick.h"

#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>

namespace carlo::grader {
namespace {

std::string ending(const Asked& asked) {
  if (asked.status != Status::passed) return asked.problem;
  const std::size_t values = asked.columns;
  if (asked.rows == 1) return fmt::format("{} {}", values, values == 1 ? "value" : "values");
  return values == 1 ? fmt::format("{} values", asked.rows)
                     : fmt::format("{} rows of {} values", asked.rows, values);
}

std::string names(const std::vector<Asked>& asked) {
  std::vector<std::string> seen;
  std::string out;
  for (const Asked& one : asked) {
    if (std::find(seen.begin(), seen.end(), one.probe) != seen.end()) continue;
    seen.push_back(one.probe);
    out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", one.probe);
  }
  return out;
}

}  // namespace

std::string listing(const std::vector<Asked>& asked) {
  std::size_t probes = 0;
  for (const Asked& one : asked)
    probes = std::max(probes, one.probe.size());
  std::string out;
  const std::string* sentence = nullptr;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Asked& one = asked[i];
    if (sentence == nullptr || *sentence != one.sentence) out += one.sentence + "\n";
    sentence = &one.sentence;
    out += fmt::format("{:>4}  {:<{}}  {}{}{}\n", i + 1, one.probe, probes, one.question,
                       one.question.empty() ? "" : ": ", ending(one));
  }
  return out;
}

const Asked& pick(const std::vector<Asked>& asked, const std::string& what) {
  if (asked.empty()) throw Error("the judge asked nothing");
  if (const auto number = carlo::number_of<std::size_t>(what)) {
    if (*number >= 1 && *number <= asked.size()) return asked[*number - 1];
    throw Error("there is no probe number {}, only 1 to {}", what, asked.size());
  }
  const auto find = [&](bool without_values) {
    return std::find_if(asked.begin(), asked.end(), [&](const Asked& one) {
      return one.probe == what && (!without_values || one.status != Status::passed);
    });
  };
  auto found = find(true);
  if (found == asked.end()) found = find(false);
  if (found == asked.end()) throw Error("no probe \"{}\"; there are: {}", what, names(asked));
  return *found;
}

std::size_t number_of(const std::vector<Asked>& asked, const Asked& one) {
  return static_cast<std::size_t>(&one - asked.data()) + 1;
}

}  // namespace carlo::grader
