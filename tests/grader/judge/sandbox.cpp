#include "grader/judge/sandbox.h"

#include "cli/error.h"

#include <unistd.h>

#include <csignal>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr const char* bubblewrap_program = "/usr/bin/bwrap";

std::vector<std::string> bubblewrap(const fs::path& worker) {
  return {bubblewrap_program,
          "--unshare-all",
          "--die-with-parent",
          "--new-session",
          "--cap-drop",
          "ALL",
          "--ro-bind",
          "/usr",
          "/usr",
          "--ro-bind-try",
          "/lib",
          "/lib",
          "--ro-bind-try",
          "/lib64",
          "/lib64",
          "--ro-bind-try",
          "/etc/ld.so.cache",
          "/etc/ld.so.cache",
          "--proc",
          "/proc",
          "--dev",
          "/dev",
          "--size",
          "67108864",
          "--tmpfs",
          "/tmp",
          "--chdir",
          "/tmp",
          "--ro-bind",
          worker.string(),
          "/worker",
          "--",
          "/worker"};
}

/// Leaks are no fault of an answer, and the leak checker cannot trace inside a sandbox. The memory
/// limit holds here too, where the address space cannot be limited.
std::vector<std::string> environment(const Limits& limits) {
  std::vector<std::string> variables{"PATH=/usr/bin:/bin", "LANG=C.UTF-8"};
  if (address_sanitizer()) {
    variables.push_back(
        fmt::format("ASAN_OPTIONS=detect_leaks=0:hard_rss_limit_mb={}", limits.memory_bytes >> 20));
  }
  return variables;
}

}  // namespace

std::string to_string(Level level) {
  return level == Level::bubblewrap ? "bubblewrap" : "limits only";
}

Sandbox::Sandbox(const fs::path& worker, Level level) : level_(level) {
  std::error_code ec;
  worker_ = fs::canonical(worker, ec);
  if (ec || ::access(worker_.c_str(), X_OK) != 0 || !fs::is_regular_file(worker_)) {
    throw Error("{}: not a program that can be run", worker.string());
  }
}

Sandbox Sandbox::strongest(const fs::path& worker) {
  if (::access(bubblewrap_program, X_OK) == 0) {
    Sandbox sandbox(worker, Level::bubblewrap);
    std::vector<std::string> trial = bubblewrap(sandbox.worker_);
    trial.back() = "/usr/bin/true";
    const Outcome outcome = run_limited(trial, environment({}), {});
    if (outcome.end == Outcome::End::exited && outcome.code == 0) return sandbox;
  }
  return Sandbox(worker, Level::limits);
}

Outcome Sandbox::run(const std::vector<std::string>& arguments, const Limits& limits) const {
  std::vector<std::string> argv{worker_.string()};
  if (level_ == Level::bubblewrap) argv = bubblewrap(worker_);
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  Outcome outcome = run_limited(argv, environment(limits), limits);
  // bubblewrap reports a child's death by signal as exit code 128 + signal, as shells do.
  const bool by_signal = outcome.code > 128 && outcome.code <= 128 + SIGRTMAX;
  if (level_ == Level::bubblewrap && outcome.end == Outcome::End::exited && by_signal) {
    outcome.end = Outcome::End::signalled;
    outcome.code -= 128;
  }
  return outcome;
}

}  // namespace carlo::grader
