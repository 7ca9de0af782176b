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

/// The paths that a session needs.
struct WatchPlaces {
  std::filesystem::path root;     ///< of the tree
  std::filesystem::path build;    ///< where ninja builds it
  std::filesystem::path scratch;  ///< an own folder for files that child processes leave behind
  std::filesystem::path own;      ///< a folder for the worker that is judged while others are built

  /// Returns the script that makes builds take turns (see its header).
  std::filesystem::path in_turn() const { return root / "common/course/in_turn.sh"; }
  std::filesystem::path labs() const { return root / "labs"; }
  std::filesystem::path state(const char* name) const { return root / ".carlo" / name; }
};

/// One student at one lab: builds and judges an exercise whenever the files have changed, and
/// reports the result. Independent of terminals: its owner waits for the child's output, for files
/// and for keys.
class WatchSession {
 public:
  WatchSession(WatchPlaces places, const Lab& lab);

  /// Handles changed files: builds, and judges the exercises whose part has changed (the whole lab
  /// if there are many), else the current one. Does nothing if the text is the same.
  void files_changed();
  /// Builds and judges the current exercise (or all, if those were requested last).
  void run();
  /// Handles the child's output or end. Returns whether to redraw.
  bool child_spoke();
  /// Handles a key. Returns whether to redraw.
  bool key(char pressed);

  const Child* child() const { return child_.get(); }
  bool busy() const { return child_ != nullptr; }
  bool quits() const { return quits_; }

  /// Returns the current activity in a few words; empty if there is none.
  std::string activity() const;
  /// Returns the lab and its exercises, in two lines.
  std::string heading() const;
  /// Returns the result of the last run or key.
  std::string body() const;
  /// Returns whether to cut the body to the screen.
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
  /// Returns the first exercise after the current one, wrapping around, that has not passed.
  const Exercise* next_open() const;
  void move_by(int step);
  void show_hint();

  LabStatus status() const;
  /// Returns whether its code differs from the code that was judged.
  bool changed_since(const Exercise& exercise) const;
  std::string verdict_text(const Exercise& exercise) const;
  /// Names the next open exercise after the current one; the current one itself if it is open and
  /// `from_current`.
  std::string next_text(bool from_current = false) const;
  std::string list_text(bool from_current = false) const;
  std::string verdicts_text() const;
  std::string last_run() const;

  WatchPlaces places_;
  const Lab& lab_;
  HintState hints_;
  VerdictBook book_;
  OwnCode code_;                        ///< the code being judged, or last judged
  const Exercise* current_;             ///< of the lab
  bool all_ = false;                    ///< all exercises are judged
  std::vector<const Exercise*> which_;  ///< otherwise these, in order; includes the current one
  std::size_t at_ = 0;                  ///< index of the one being judged

  std::unique_ptr<Child> child_;
  Phase phase_ = Phase::idle;
  WallClock build_clock_, judge_clock_;
  double build_seconds_ = 0, judge_seconds_ = 0;
  bool has_run_ = false;

  std::vector<CompilerMessage> messages_;
  std::string trouble_;  ///< trouble that neither the compiler nor the judge reports
  bool compiles_ = true;

  Panel panel_ = Panel::verdict;
  std::string hint_;
  bool whole_ = false, quits_ = false;
};

}  // namespace carlo
