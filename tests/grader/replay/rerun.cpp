#include "grader/replay/rerun.h"

#include "course/cli/descriptor.h"
#include "course/cli/program.h"
#include "grader/judge/crash.h"
#include "grader/judge/process.h"
#include "support/error.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace carlo::grader {
namespace {

/// Makes sanitizers show the origin and callers of an abort(); leaks are no fault of an answer.
/// Keeps the user's settings.
void ask_sanitizers() {
  ::setenv("ASAN_OPTIONS", "detect_leaks=0:handle_abort=1", 0);
  ::setenv("UBSAN_OPTIONS", "print_stacktrace=1", 0);
}

/// Copies `from` to our stderr and returns its start; a sanitizer's report is small compared to
/// that.
std::string pass_on(int from) {
  constexpr std::size_t kept = std::size_t{1} << 20;
  std::string text;
  std::array<char, 4096> block{};
  while (true) {
    const ssize_t got = ::read(from, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    const std::string_view part(block.data(), static_cast<std::size_t>(got));
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, part.data(), part.size());
    if (text.size() < kept) text += part;
  }
}

}  // namespace

std::vector<std::string> command(const std::string& worker, const Asked& asked, std::size_t rows) {
  return {worker,    "--probe",           asked.probe, "--params", to_text(asked.params),
          "--print", std::to_string(rows)};
}

Rerun rerun(const std::vector<std::string>& command) {
  ask_sanitizers();
  Pipe pipe = make_pipe();
  const pid_t pid = start_program(command, {.error = pipe.write.get()});
  pipe.write.close();
  const std::string said = pass_on(pipe.read.get());
  const int status = wait_for(pid);

  Rerun result;
  if (WIFSIGNALED(status)) result.how = signal_name(WTERMSIG(status));
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  if (code == 127) throw Error("{} cannot be run", command.front());
  // A sanitizer ends the program with exit code 1 after its report.
  if (code != 0 && has_report(said)) result.how = "the sanitizer's report above";
  if (code != 0 && code != 1) result.how = fmt::format("exit code {}", code);
  result.values = status == 0;
  result.crashed = !result.how.empty();
  if (result.crashed) result.place = place_in(said);
  return result;
}

void debug(const std::string& debugger, const std::vector<std::string>& command) {
  ask_sanitizers();
  std::vector<std::string> words{debugger, "-q", "--args"};
  words.insert(words.end(), command.begin(), command.end());
  const std::vector<char*> argv = pointers(words);
  ::execvp(argv[0], argv.data());
  throw Error("{} cannot be run: {} (as root: apt-get install gdb)", debugger,
              std::strerror(errno));
}

}  // namespace carlo::grader
