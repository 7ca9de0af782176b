#include "course/watch/session.h"

#include "course/verdict/verdict_json.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/wall_clock.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;

}  // namespace

WatchSession::WatchSession(WatchPlaces places, const Lab& lab)
    : places_(std::move(places)),
      lab_(lab),
      hints_(places_.state("hints.json")),
      book_(places_.state("verdicts.json")),
      code_(places_.labs(), lab),
      current_(next_exercise(status())) {
  if (current_ == nullptr) current_ = &lab.exercises.front();
  which_ = {current_};
}

LabStatus WatchSession::status() const {
  return status_of(lab_, places_.labs(), book_, hints_);
}

std::string WatchSession::program(const char* what) const {
  return fmt::format("lab{:02}_{}", lab_.number, what);
}

void WatchSession::start(Phase phase, const std::vector<std::string>& command) {
  phase_ = phase;
  child_ = std::make_unique<Child>(command);
}

void WatchSession::stop() {
  child_.reset();
  phase_ = Phase::idle;
  // Files that a stopped judge could not remove.
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(places_.scratch, ec))
    fs::remove_all(entry.path(), ec);
}

void WatchSession::run() {
  stop();
  panel_ = Panel::verdict;
  whole_ = false;
  code_ = OwnCode(places_.labs(), lab_);
  build_clock_ = {};
  start(Phase::building, {places_.in_turn().string(), places_.build.string(), "--keep",
                          places_.own.string(), program("worker"), "--", "ninja", "-C",
                          places_.build.string(), program("judge"), program("worker")});
}

void WatchSession::files_changed() {
  const OwnCode now(places_.labs(), lab_);
  if (now.digest() == code_.digest()) return;
  std::vector<const Exercise*> changed = now.changed_since(code_);
  // Adds those that the previous save changed and that are not judged yet.
  if (busy() && !all_) {
    const std::size_t done = phase_ == Phase::judging ? at_ : 0;
    for (std::size_t i = done; i < which_.size(); ++i) {
      if (std::find(changed.begin(), changed.end(), which_[i]) == changed.end()) {
        changed.push_back(which_[i]);
      }
    }
    std::sort(changed.begin(), changed.end());  // all point into one vector
  }
  if (!changed.empty()) {
    // So many changes at once mean that another version was copied here.
    constexpr std::size_t many = 4;
    all_ = changed.size() >= many;
    which_ = changed;
    current_ = changed.front();
  }
  run();
}

bool WatchSession::child_spoke() {
  if (!child_ || !child_->ended()) return false;
  if (phase_ == Phase::building) {
    built();
  } else {
    judged();
  }
  return true;
}

void WatchSession::built() {
  build_seconds_ = build_clock_.seconds();
  messages_ = compiler_messages(child_->output(), places_.root);
  compiles_ = child_->exit_code() == 0;
  trouble_.clear();
  if (!compiles_) {
    if (messages_.empty()) trouble_ = plain_log(child_->output(), 30);
    judge_seconds_ = 0;
    has_run_ = true;
    stop();
    return;
  }
  judge_clock_ = {};
  at_ = 0;
  judge_next();
}

void WatchSession::judge_next() {
  const std::string bin = (places_.build / "bin").string();
  const fs::path folder = places_.labs() / fmt::format("{:02}_{}", lab_.number, lab_.name);
  std::vector<std::string> command{bin + "/" + program("judge"),
                                   "--lab",
                                   (folder / "lab.json").string(),
                                   "--worker",
                                   (places_.own / program("worker")).string(),
                                   "--json",
                                   judged_file().string()};
  if (!all_) {
    current_ = which_[at_];
    command.insert(command.end(), {"--exercise", current_->number()});
  }
  std::error_code ec;
  fs::remove(judged_file(), ec);
  start(Phase::judging, command);
}

void WatchSession::judged() {
  judge_seconds_ = judge_clock_.seconds();
  has_run_ = true;
  std::error_code ec;
  if (!fs::exists(judged_file(), ec)) {
    trouble_ = "the judge did not finish:\n" + plain_log(child_->output(), 30);
  } else if (OwnCode(places_.labs(), lab_).digest() == code_.digest()) {
    take_verdicts();
  }  // otherwise the files were just edited, and the next run has begun or begins at once
  if (!all_ && trouble_.empty() && ++at_ < which_.size()) {
    judge_next();
    return;
  }
  stop();
  // If there are several, the one to continue with.
  const auto passed = [&](const Exercise& exercise) {
    const KeptVerdict* verdict = book_.find(exercise);
    return verdict != nullptr && verdict->passed();
  };
  if (all_) {
    const auto open = std::find_if_not(lab_.exercises.begin(), lab_.exercises.end(), passed);
    if (open != lab_.exercises.end()) current_ = &*open;
  } else {
    const auto open = std::find_if_not(which_.begin(), which_.end(),
                                       [&](const Exercise* exercise) { return passed(*exercise); });
    if (open != which_.end()) current_ = *open;
  }
}

void WatchSession::take_verdicts() {
  try {
    // Another ./carlo may have recorded a verdict meanwhile.
    book_ = VerdictBook(places_.state("verdicts.json"));
    book_.take(lab_result_from_text(read_file(judged_file())), lab_, code_);
    book_.save();
  } catch (const Error& error) {
    trouble_ = fmt::format("cannot save the verdict: {}\n", error.what());
  }
}

void WatchSession::go_to(const Exercise* exercise) {
  current_ = exercise;
  which_ = {exercise};
  all_ = false;
  run();
}

const Exercise* WatchSession::next_open() const {
  const LabStatus now = status();
  const auto place = static_cast<std::size_t>(current_ - lab_.exercises.data());
  for (std::size_t i = 1; i <= now.exercises.size(); ++i) {
    const ExerciseStatus& status = now.exercises[(place + i) % now.exercises.size()];
    if (status.stage != Stage::passed) return status.exercise;
  }
  return nullptr;
}

void WatchSession::move_by(int step) {
  const auto place = current_ - lab_.exercises.data();
  const auto count = static_cast<std::ptrdiff_t>(lab_.exercises.size());
  go_to(&lab_.exercises[static_cast<std::size_t>((place + step + count) % count)]);
}

void WatchSession::show_hint() {
  try {
    hints_ = HintState(places_.state("hints.json"));
    hint_ = hint_text(next_hint(*current_, hints_), Help::by_key);
  } catch (const Error& error) {
    hint_ = fmt::format("{}\n", error.what());
  }
  panel_ = Panel::hint;
  whole_ = false;
}

bool WatchSession::key(char pressed) {
  switch (pressed) {
    case 'h':
      show_hint();
      return true;
    case 'n':
      if (const Exercise* next = next_open(); next != nullptr && next != current_) {
        go_to(next);
      } else {
        move_by(1);
      }
      return true;
    case 'p':
      move_by(-1);
      return true;
    case 'a':
      all_ = true;
      run();
      return true;
    case 'r':
      run();
      return true;
    case 'l':
      panel_ = panel_ == Panel::list ? Panel::verdict : Panel::list;
      return true;
    case 'v':
      whole_ = !whole_;
      return true;
    case 'q':
    case '\x04':
      quits_ = true;
      return false;
    default:
      return false;
  }
}

}  // namespace carlo
