#include "grader/judge/sandbox.h"

#include "cli/error.h"
#include "cli/scratch_folder.h"
#include "grader/judge/bubblewrap.h"
#include "grader/judge/landlock.h"

#include <unistd.h>

#include <csignal>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr Level all_levels[] = {Level::bubblewrap, Level::landlock, Level::user, Level::limits};

/// Leaks are no fault of an answer, and the leak checker cannot trace inside a sandbox. The memory
/// limit holds here too, where the address space cannot be limited.
std::vector<std::string> environment(const fs::path& scratch, const Limits& limits) {
  std::vector<std::string> variables{"PATH=/usr/bin:/bin", "LANG=C.UTF-8",
                                     "TMPDIR=" + scratch.string()};
  if (address_sanitizer()) {
    // An abort() too says where it came from: a student is told the line.
    variables.push_back(
        fmt::format("ASAN_OPTIONS=detect_leaks=0:handle_abort=1:hard_rss_limit_mb={}",
                    limits.memory_bytes >> 20));
    variables.emplace_back("UBSAN_OPTIONS=print_stacktrace=1");
  }
  return variables;
}

LandlockRules landlock_rules(const View& view, const fs::path& scratch) {
  LandlockRules rules;
  for (const fs::path& path : system_paths())
    rules.allow_reading(path);
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom"})
    rules.allow_device(device);
  for (const fs::path& path : view.readable)
    rules.allow_reading(path);
  // The sanitizers find their options there; marks are not given with them.
  if (address_sanitizer()) rules.allow_reading("/proc");
  rules.allow_writing(scratch);
  return rules;
}

/// The user ids to try at a level, best first.
std::vector<std::optional<uid_t>> users_for(Level level) {
  if (::geteuid() != 0 || level == Level::limits) return {std::nullopt};
  // A tree below a folder of root's alone cannot be shown by bubblewrap as another user.
  if (level == Level::bubblewrap) return {unused_user(), std::nullopt};
  return {unused_user()};
}

}  // namespace

std::string to_string(Level level) {
  switch (level) {
    case Level::limits:
      return "limits";
    case Level::user:
      return "user";
    case Level::landlock:
      return "landlock";
    case Level::bubblewrap:
      return "bubblewrap";
  }
  throw Error("unknown level");
}

Level level_of(const std::string& name) {
  for (const Level level : all_levels) {
    if (to_string(level) == name) return level;
  }
  throw Error("there is no sandbox level \"{}\": bubblewrap, landlock, user or limits", name);
}

std::string Sandbox::description() const {
  if (level_ == Level::limits) return "limits only";
  return to_string(level_) + (user_ ? ", own user" : "");
}

Sandbox Sandbox::at(Level level, const View& view) {
  // As anybody but root there is no own user, and the level would promise more than it holds.
  const bool possible = level != Level::user || ::geteuid() == 0;
  for (const std::optional<uid_t> user : users_for(level)) {
    const Sandbox sandbox(level, user);
    if (possible && sandbox.works(view)) return sandbox;
  }
  throw Error("the sandbox level \"{}\" does not work on this machine", to_string(level));
}

Sandbox Sandbox::strongest(const View& view) {
  for (const Level level : all_levels) {
    try {
      return at(level, view);
    } catch (const Error&) {
      if (level == Level::limits) throw;
    }
  }
  throw Error("no sandbox works");
}

bool Sandbox::works(const View& view) const {
  if (level_ == Level::bubblewrap && ::access(bubblewrap_program, X_OK) != 0) return false;
  try {
    return run({"/usr/bin/true"}, view, {}).succeeded();
  } catch (const Error&) {
    return false;
  }
}

Outcome Sandbox::run(const std::vector<std::string>& argv, const View& view,
                     const Limits& limits) const {
  std::optional<ScratchFolder> own;
  if (view.scratch.empty()) own.emplace();
  const fs::path scratch = own ? own->path() : view.scratch;
  if (user_ && ::chown(scratch.c_str(), *user_, *user_) != 0) {
    throw Error("{}: cannot be given to the sandbox's user", scratch.string());
  }
  Command command{argv, environment(scratch, limits)};
  Confinement& confinement = command.confinement;
  confinement.user = user_;
  confinement.measured = scratch.string();
  confinement.folder = scratch.string();
  std::optional<LandlockRules> rules;
  std::optional<Descriptor> filter;
  if (level_ == Level::bubblewrap) {
    filter = filter_file(SyscallFilter(false));
    confinement.inherited = filter->get();
    command.argv = bubblewrap(argv, view, scratch);
  } else if (level_ != Level::limits) {
    confinement.filter = SyscallFilter(true);
  }
  if (level_ == Level::landlock) {
    rules = landlock_rules(view, scratch);
    confinement.landlock_rules = rules->descriptor();
  }
  Outcome outcome = run_limited(command, limits);
  // bubblewrap reports a child's death by signal as exit code 128 + signal, as shells do.
  const bool by_signal = outcome.code > 128 && outcome.code <= 128 + SIGRTMAX;
  if (level_ == Level::bubblewrap && outcome.end == Outcome::End::exited && by_signal) {
    outcome.end = Outcome::End::signalled;
    outcome.code -= 128;
  }
  return outcome;
}

}  // namespace carlo::grader
