#include "course/verbs/run.h"

#include "course/cli/descriptor.h"
#include "support/error.h"
#include "support/number.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t last_signal = 0;
volatile std::sig_atomic_t running = 0;  ///< the program to which signals are passed on

extern "C" void note_signal(int number) {
  last_signal = number;
  // Ctrl-C has reached the program already.
  if (number != SIGINT && running > 0) ::kill(running, number);
}

int exit_code_of(pid_t child) {
  running = child;
  const int status = wait_for(child);
  running = 0;
  if (last_signal != 0 && last_signal != SIGINT) throw Leave{128 + last_signal};
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// True if a killed process left the folder behind: not written to for a day, and no process has
/// its number.
bool is_forgotten(const fs::path& folder) {
  using namespace std::chrono_literals;
  std::error_code ec;
  const auto written = fs::last_write_time(folder, ec);
  if (ec || fs::file_time_type::clock::now() - written < 24h) return false;
  const auto process = number_of<int>(folder.filename().string());
  return !process || *process <= 0 || (::kill(*process, 0) != 0 && errno == ESRCH);
}

}  // namespace

void outlive_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(number, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action.sa_handler = note_signal;
    action.sa_flags = 0;
    ::sigaction(number, &action, nullptr);
  }
}

bool interrupted() {
  return last_signal == SIGINT;
}

int run(const Words& command, const ProgramStart& how) {
  return exit_code_of(start_program(command, how));
}

int run_silently(const Words& command) {
  const Descriptor nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  return run(command, {.output = nowhere.get(), .error = nowhere.get()});
}

int run_gathering(const Words& command, const ProgramStart& how, std::string& said) {
  return run_listening(command, how, [&](const std::string& line) { (said += line) += '\n'; });
}

int run_listening(const Words& command, const ProgramStart& how,
                  const std::function<void(const std::string& line)>& said,
                  const std::function<void()>& waiting) {
  Pipe pipe = make_pipe();
  Descriptor write = pipe.write.lifted();
  const Descriptor read = pipe.read.lifted();
  pipe.write.close();
  ProgramStart start = how;
  start.output = start.error = write.get();
  const pid_t child = start_program(command, start);
  write.close();
  std::string rest;
  std::array<char, 4096> piece{};
  for (;;) {
    pollfd output{read.get(), POLLIN, 0};
    if (::poll(&output, 1, 1000) == 0) {
      waiting();
      continue;
    }
    const ssize_t n = ::read(read.get(), piece.data(), piece.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    rest.append(piece.data(), static_cast<std::size_t>(n));
    for (std::size_t end = 0; (end = rest.find('\n')) != std::string::npos;) {
      said(rest.substr(0, end));
      rest.erase(0, end + 1);
    }
  }
  if (!rest.empty()) said(rest);
  return exit_code_of(child);
}

bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "/usr/bin:/bin" : path;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const fs::path file = fs::path(folders.substr(0, end)) / program;
    if (::access(file.c_str(), X_OK) == 0 && !fs::is_directory(file)) return true;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return false;
}

OwnFolder::OwnFolder(const fs::path& build) : path_(build / "run" / std::to_string(::getpid())) {
  std::error_code ec;
  fs::remove_all(path_, ec);
  fs::create_directories(path_, ec);
  if (ec) fail({"cannot write into ", path_.string()});
  for (const auto& entry : fs::directory_iterator(build / "run", ec))
    if (is_forgotten(entry.path())) fs::remove_all(entry.path(), ec);
}

OwnFolder::~OwnFolder() {
  std::error_code ec;
  fs::remove_all(path_, ec);
}

}  // namespace carlo::verbs
