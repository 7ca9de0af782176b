#pragma once

#include "course/cli/program.h"
#include "course/verbs/words.h"

#include <filesystem>
#include <functional>
#include <string>

// Starting other programs from a verb, and ending a verb.

namespace carlo::verbs {

/// Thrown when everything has been said: only the exit code is left.
struct Leave {
  int code;
};

/// Thrown by a verb whose last step is another program: it replaces this process once everything
/// that the verb holds has been cleaned up.
struct HandOver {
  Words command;
};

/// From now on Ctrl-C reaches the programs that we run but leaves us alive to clean up; SIGTERM and
/// SIGHUP are passed on to them and end us afterwards. Signals that the caller ignores stay
/// ignored.
void outlive_signals();

/// True if Ctrl-C was pressed.
bool interrupted();

/// Runs a program to its end. Returns its exit code, or 128 + the signal's number if a signal ended
/// it.
int run(const Words& command, const ProgramStart& how = {});

/// The same without showing its output.
int run_silently(const Words& command);

/// The same; appends its output, stdout and stderr, to `said`.
int run_gathering(const Words& command, const ProgramStart& how, std::string& said);

/// The same; calls `said` for each line of output, and `waiting` each second without any.
int run_listening(
    const Words& command, const ProgramStart& how,
    const std::function<void(const std::string& line)>& said,
    const std::function<void()>& waiting = [] {});

/// True if a program of that name is in PATH.
bool is_installed(const std::string& program);

/// A folder below BUILD/run for this process, removed at its end: for copies of the programs that
/// it runs and for what it writes about them.
class OwnFolder {
 public:
  explicit OwnFolder(const std::filesystem::path& build);
  ~OwnFolder();
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace carlo::verbs
