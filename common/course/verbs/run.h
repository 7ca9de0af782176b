#pragma once

#include "course/cli/program.h"
#include "course/verbs/words.h"

#include <filesystem>
#include <functional>
#include <string>

// How a verb starts other programs, and how it ends.

namespace carlo::verbs {

/// Thrown where everything has been said: the exit code is left.
struct Leave {
  int code;
};

/// Thrown by a verb whose last step is another program: that takes this process over, once all that
/// the verb holds has been cleared away.
struct HandOver {
  Words command;
  std::filesystem::path folder = {};  ///< where it starts, if not here
};

/// From now on Ctrl-C reaches the programs that we run and leaves us to clear away; so do SIGTERM
/// and SIGHUP, which end us then. One that the caller has us ignore stays ignored.
void outlive_signals();

/// Whether Ctrl-C was pressed.
bool interrupted();

/// Runs a program to its end. Returns its exit code, 128 + its number after a signal.
int run(const Words& command, const ProgramStart& how = {});

/// The same, with nothing that it says shown.
int run_silently(const Words& command);

/// The same; what it says, on whichever stream, goes behind `said`.
int run_gathering(const Words& command, const ProgramStart& how, std::string& said);

/// The same; `said` gets each line.
int run_listening(const Words& command, const ProgramStart& how,
                  const std::function<void(const std::string& line)>& said);

/// Whether a program of that name is in PATH.
bool is_installed(const std::string& program);

/// A folder below BUILD/run for this process, gone at its end: for copies of the programs that it
/// runs, and for what it writes about them.
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
