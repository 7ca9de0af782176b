#include "grader/judge/sandbox.h"

#include "course/cli/scratch_folder.h"
#include "grader/judge/bubblewrap.h"
#include "grader/judge/landlock.h"
#include "support/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string_view>
#include <thread>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr Level all_levels[] = {Level::bubblewrap, Level::landlock, Level::user, Level::limits};

/// Leaks are no fault of an answer, and the leak checker cannot trace inside a sandbox. The memory
/// limit applies here too, where the address space cannot be limited.
std::vector<std::string> environment(const fs::path& scratch, const Limits& limits) {
  std::vector<std::string> variables{"PATH=/usr/bin:/bin", "LANG=C.UTF-8",
                                     "TMPDIR=" + scratch.string()};
  if (address_sanitizer()) {
    // An abort() also reports its origin, so that the student learns the line.
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
  // The sanitizers find their options there; marks are not given with sanitizers.
  if (address_sanitizer()) rules.allow_reading("/proc");
  rules.allow_writing(scratch);
  return rules;
}

/// bubblewrap's messages on its own descriptor. Its exit code comes only if the program was
/// started, and the program cannot reach the descriptor: without the code, bubblewrap itself
/// failed.
class BubblewrapStatus {
 public:
  BubblewrapStatus() {
    const Pipe low = make_pipe();
    read_ = low.read.lifted();
    write_ = low.write.lifted();
    for (const int end : {read_.get(), write_.get()})
      if (::fcntl(end, F_SETFL, O_NONBLOCK) != 0) throw Error("pipe: {}", std::strerror(errno));
  }

  int end_for_child() const { return write_.get(); }

  bool begun() const {
    std::array<char, 4096> text{};
    const ssize_t got = ::read(read_.get(), text.data(), text.size());
    const std::string_view said(text.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return said.find("exit-code") != std::string_view::npos;
  }

 private:
  Descriptor read_, write_;
};

/// bubblewrap reports a child's death by signal as exit code 128 + signal, like a shell.
void tell_signal(Outcome& outcome) {
  if (outcome.end != Outcome::End::exited) return;
  constexpr int last_signal = 64;
  if (outcome.code <= 128 || outcome.code > 128 + last_signal) return;
  outcome.end = Outcome::End::signalled;
  outcome.code -= 128;
}

/// Returns whether the program's libraries could not be loaded, for lack of memory or files: the
/// loader says so before the program starts, with the exit code that shells use for it.
bool loader_failed(const Outcome& outcome, const std::string& program) {
  return outcome.end == Outcome::End::exited && outcome.code == 127 && outcome.result.empty() &&
         outcome.output.starts_with(program + ": error while loading shared libraries: ");
}

/// A program that took less than this was not killed for its own use.
constexpr std::size_t modest_bytes = std::size_t{512} << 20;

/// Returns how often the kernel has killed a process for lack of memory; 0 if it does not say.
long memory_kills() {
  std::ifstream file("/proc/vmstat");
  std::string name;
  for (long value = 0; file >> name >> value;) {
    if (name == "oom_kill") return value;
  }
  return 0;
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

Sandbox Sandbox::with_own_user(Level level) {
  Sandbox sandbox(level, std::nullopt);
  sandbox.claim_.emplace();
  sandbox.user_ = sandbox.claim_->id();
  return sandbox;
}

Sandbox Sandbox::with_new_user() const {
  return user_ ? with_own_user(level_) : *this;
}

Sandbox Sandbox::at(Level level, const View& view) {
  const bool root = ::geteuid() == 0;
  if (root && level != Level::limits) {
    Sandbox sandbox = with_own_user(level);
    if (sandbox.works(view)) return sandbox;
  }
  // Without root there is no own user, and the level "user" would promise more than it holds.
  // Root's processes need one except under bubblewrap, which cannot show another user a tree below
  // a folder of root's alone.
  const bool possible =
      root ? level == Level::limits || level == Level::bubblewrap : level != Level::user;
  Sandbox sandbox(level, std::nullopt);
  if (possible && sandbox.works(view)) return sandbox;
  throw Error("the sandbox level \"{}\" does not work on this machine", to_string(level));
}

std::string Sandbox::trouble_at(Level level) {
  const bool root = ::geteuid() == 0;
  if (level == Level::user && !root) return "only root can give programs a user of their own";
  if (level == Level::bubblewrap && ::access(bubblewrap_program, X_OK) != 0) {
    return std::string(bubblewrap_program) + " is not installed (./carlo setup)";
  }
  try {
    const Sandbox sandbox =
        root && level != Level::limits ? with_own_user(level) : Sandbox(level, std::nullopt);
    const Outcome outcome = sandbox.run_once({"/usr/bin/true"}, {}, {});
    if (outcome.succeeded()) return "";
    return outcome.output.empty() ? "a harmless program failed there"
                                  : outcome.output.substr(0, outcome.output.find('\n'));
  } catch (const Error& error) {
    return error.what();
  }
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
    return run_once({"/usr/bin/true"}, view, {}).succeeded();
  } catch (const Error&) {
    return false;
  }
}

Outcome Sandbox::run(const std::vector<std::string>& argv, const View& view,
                     const Limits& limits) const {
  using End = Outcome::End;
  constexpr int attempts = 6;
  std::chrono::milliseconds pause{100};
  for (int attempt = 1;; ++attempt) {
    const long kills = memory_kills();
    Outcome outcome = run_once(argv, view, limits);
    if (loader_failed(outcome, argv.at(0))) outcome.end = End::not_started;
    if (outcome.end == End::starved) {
      throw Error(
          "the machine was too busy: a program did not get the processor time that it may "
          "have in {} times as long",
          patience);
    }
    // A program that takes little and is killed while the kernel kills for memory is not to blame.
    // Without such a kill it may be: a program can kill itself, and does so again.
    const bool killed = outcome.end == End::signalled && outcome.code == SIGKILL;
    const bool in_need = memory_kills() != kills && outcome.peak_bytes < modest_bytes;
    if (outcome.end != End::not_started && !(killed && in_need)) return outcome;
    if (attempt == attempts) {
      throw Error("{}", killed ? "the machine has no memory left: a program was killed for it"
                               : "the sandbox cannot begin a program: " + outcome.output);
    }
    std::this_thread::sleep_for(pause);
    pause *= 2;
  }
}

Outcome Sandbox::run_once(const std::vector<std::string>& argv, const View& view,
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
  confinement.untrusted = true;
  confinement.measured = scratch.string();
  confinement.folder = scratch.string();
  std::optional<LandlockRules> rules;
  if (level_ == Level::bubblewrap) {
    const Descriptor filter = filter_file(SyscallFilter(false));
    const BubblewrapStatus status;
    confinement.inherited = filter.get();
    confinement.status = status.end_for_child();
    command.argv = bubblewrap(argv, view, scratch);
    Outcome outcome = run_limited(command, limits);
    const bool ended =
        outcome.end == Outcome::End::exited || outcome.end == Outcome::End::signalled;
    if (ended && !status.begun()) outcome.end = Outcome::End::not_started;
    tell_signal(outcome);
    return outcome;
  }
  if (level_ != Level::limits) confinement.filter = SyscallFilter(true);
  if (level_ == Level::landlock) {
    rules = landlock_rules(view, scratch);
    confinement.landlock_rules = rules->descriptor();
  }
  return run_limited(command, limits);
}

}  // namespace carlo::grader
