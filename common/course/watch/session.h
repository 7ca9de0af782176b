#pragma once

#include "course/guide/compiler_messages.h"
#include "course/guide/hints.h"
#include "course/guide/status.h"
#include "course/guide/verdicts.h"
#include "course/watch/child.h"
#include "support/wall_clock.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace carlo {

/// Where a session finds everything.
struct WatchPlaces {
  std::filesystem::path root;     ///< of the tree
  std::filesystem::path build;    ///< where ninja builds it
  std::filesystem::path scratch;  ///< a folder of our own for what children leave behind
  std::filesystem::path own;      ///< one for the worker that is judged, while others are built

  /// What builds alone (its own first lines say how).
  std::filesystem::path in_turn() const { return root / "common/course/in_turn.sh"; }
  std::filesystem::path labs() const { return root / "labs"; }
  std::filesystem::path state(const char* name) const { return root / ".carlo" / name; }
};

/// One student at one lab: builds and judges an exercise whenever the files have changed, and says
/// what came of it. Knows nothing of terminals; whoever owns it waits for its child's words, for
/// files and for keys.
class WatchSession {
 public:
  WatchSession(WatchPlaces places, const Lab& lab);

  /// The exercises' code may have changed: builds, and judges those whose part has (all of the lab
  /// when they are many), else the current one. Nothing happens when the text is the same.
  void files_changed();
  /// Builds and judges the current exercise (or all, when they were asked for last).
  void run();
  /// The child's words are there, or its end. True when something is to be shown anew.
  bool child_spoke();
  /// A key: true when something is to be shown anew.
  bool key(char pressed);

  const Child* child() const { return child_.get(); }
  bool busy() const { return child_ != nullptr; }
  bool quits() const { return quits_; }

  /// What is being done, in a few words; empty when nothing is.
  std::string activity() const;
  /// The lab and its exercises, in two lines.
  std::string heading() const;
  /// What the last run, or key, has to tell.
  std::string body() const;
  /// Whether the body should be cut to the screen.
  bool in_short() const { return !whole_; }

 private:
  enum class Panel { verdict, hint, list };
  enum class Phase { idle, building, judging };

  std::string program(const char* what) const;
  std::filesystem::path judged_file() const { return places_.scratch / "verdicts.json"; }
  void start(Phase phase, const std::vector<std::string>& command);
  void stop();
  void built();
  void judge_next();
  void judged();
  void take_verdicts();
  void go_to(const Exercise* exercise);
  /// The first exercise behind the current one, or from the beginning, that has not passed.
  const Exercise* next_open() const;
  void go_on(int step);
  void show_hint();

  LabStatus status() const;
  /// Whether its code is another than the one that has its verdict.
  bool changed_since(const Exercise& exercise) const;
  std::string verdict_text(const Exercise& exercise) const;
  /// The next open exercise behind the current one; the current one itself where it is open and
  /// `from_current`.
  std::string what_next(bool from_current = false) const;
  std::string list_text(bool from_current = false) const;
  std::string verdicts_text() const;
  std::string last_run() const;

  WatchPlaces places_;
  const Lab& lab_;
  HintState hints_;
  VerdictBook book_;
  OwnCode code_;                        ///< what is being, or was, judged
  const Exercise* current_;             ///< of the lab
  bool all_ = false;                    ///< all exercises are judged
  std::vector<const Exercise*> which_;  ///< else these, in order; the current one is among them
  std::size_t at_ = 0;                  ///< which of them is being judged

  std::unique_ptr<Child> child_;
  Phase phase_ = Phase::idle;
  WallClock build_clock_, judge_clock_;
  double build_seconds_ = 0, judge_seconds_ = 0;
  bool has_run_ = false;

  std::vector<CompilerMessage> messages_;
  std::string trouble_;  ///< what neither the compiler nor the judge has words for
  bool compiles_ = true;

  Panel panel_ = Panel::verdict;
  std::string hint_;
  bool whole_ = false, quits_ = false;
};

}  // namespace carlo
