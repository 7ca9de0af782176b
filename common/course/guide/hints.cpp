#include "course/guide/hints.h"

#include "course/json/json_fields.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// The content of the file.
struct Seen {
  std::map<std::string, int> hints;  ///< by "1.2"
};

void fields(JsonFields& json, Seen& seen) {
  json("hints", seen.hints);
}

std::string numbers(const Lab& lab) {
  return fmt::format("{} to {}", lab.exercises.front().number(), lab.exercises.back().number());
}

/// Returns the number before the point of "1.2"; 0 if it is no number.
int lab_of(const std::string& number) {
  int lab = 0;
  std::from_chars(number.data(), number.data() + number.size(), lab);
  return lab;
}

std::string heading(const Exercise& exercise) {
  return fmt::format("{}: {}\n", exercise.tag, exercise.title);
}

/// Formats the hint without its exercise.
std::string body(const Hint& hint, const std::string& remark) {
  return fmt::format("hint {} of {}{}\n\n{}\n", hint.number, hint.count, remark,
                     hint.exercise->hints[static_cast<std::size_t>(hint.number - 1)]);
}

std::string remark(const Hint& hint, Help help) {
  switch (hint.more) {
    case Hint::More::unsaid:
      return "";
    case Hint::More::another:
      return help == Help::by_key ? "; h shows the next" : "; run again for the next";
    case Hint::More::none_left:
      return "; the last";
    case Hint::More::was_the_last:
      return fmt::format(
          "; there are no more (all: ./carlo hint {} --all); see the handout and the header",
          hint.exercise->number());
  }
  return "";
}

}  // namespace

HintState::HintState(fs::path file) : file_(std::move(file)) {
  if (!fs::exists(file_)) return;
  const std::string text = read_file(file_);
  try {
    seen_ = from_json_text<Seen>(text, "hints").hints;
  } catch (const Error&) {
    throw Error("{}: not a record of hints; remove it to start afresh", file_.string());
  }
}

int HintState::seen(const Exercise& exercise) const {
  const auto found = seen_.find(exercise.number());
  return found == seen_.end() ? 0 : std::clamp(found->second, 0, 1000);
}

void HintState::set_seen(const Exercise& exercise, int count) {
  seen_[exercise.number()] = count;
  std::error_code ec;
  if (file_.has_parent_path()) fs::create_directories(file_.parent_path(), ec);
  write_file(file_, json_text(Seen{seen_}, 2) + "\n");
}

const Exercise& find_exercise(const std::vector<Lab>& labs, const std::string& typed) {
  const std::string number = typed.rfind("Lab ", 0) == 0 ? typed.substr(4) : typed;
  for (const Lab& lab : labs) {
    if (const Exercise* exercise = lab.find("Lab " + number)) return *exercise;
  }
  if (lab_of(number) == 0) throw Error("an exercise is a number such as 1.2, got \"{}\"", typed);
  const Lab& lab = find_lab(labs, lab_of(number));
  if (number.find('.') == std::string::npos) {
    throw Error("which exercise of lab {}? There are {}", lab.number, numbers(lab));
  }
  throw Error("there is no exercise {}; lab {} has {}", typed, lab.number, numbers(lab));
}

Hint next_hint(const Exercise& exercise, HintState& state) {
  const int count = static_cast<int>(exercise.hints.size());
  if (count == 0) throw Error("{} has no hints", exercise.tag);
  const int seen = state.seen(exercise);
  const int shown = std::min(seen + 1, count);
  if (shown != seen) state.set_seen(exercise, shown);
  return {&exercise, shown, count,
          seen >= count    ? Hint::More::was_the_last
          : shown == count ? Hint::More::none_left
                           : Hint::More::another};
}

Hint seen_hint(const Exercise& exercise, int number, const HintState& state) {
  const int count = static_cast<int>(exercise.hints.size());
  if (number < 1 || number > count) {
    throw Error("{} has hints 1 to {}, got {}", exercise.tag, count, number);
  }
  const int seen = std::min(state.seen(exercise), count);
  if (number > seen) {
    throw Error("hint {} of {} has not been seen yet; ./carlo hint {} shows hint {}", number,
                exercise.tag, exercise.number(), seen + 1);
  }
  return {&exercise, number, count};
}

std::vector<Hint> seen_hints(const Exercise& exercise, const HintState& state) {
  const int count = static_cast<int>(exercise.hints.size());
  const int seen = std::min(state.seen(exercise), count);
  if (seen == 0) {
    throw Error("no hint of {} has been seen yet; ./carlo hint {} shows the first", exercise.tag,
                exercise.number());
  }
  std::vector<Hint> list;
  for (int number = 1; number <= seen; ++number)
    list.push_back({&exercise, number, count});
  return list;
}

std::string hint_text(const Hint& hint, Help help) {
  return heading(*hint.exercise) + body(hint, remark(hint, help));
}

std::string hint_text(const std::vector<Hint>& hints) {
  std::string out = heading(*hints.front().exercise);
  for (const Hint& hint : hints)
    out += (hint.number > 1 ? "\n" : "") + body(hint, "");
  return out;
}

}  // namespace carlo
