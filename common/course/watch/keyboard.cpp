#include "course/watch/keyboard.h"

#include "support/error.h"

#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace carlo {
namespace {

constexpr std::array crashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr std::string_view hide = "\x1b[?25l", show = "\x1b[?25h";

/// The terminal's former settings and crash handlers; not in an object, so that the handler can
/// reach them.
struct Before {
  termios terminal{};
  std::array<struct sigaction, crashes.size()> handlers{};
  volatile std::sig_atomic_t held = 0;
};
Before before;

void say(std::string_view text) {
  while (!text.empty()) {
    const ssize_t done = ::write(STDOUT_FILENO, text.data(), text.size());
    if (done < 0 && errno != EINTR) return;
    if (done > 0) text.remove_prefix(static_cast<std::size_t>(done));
  }
}

/// Removes escape sequences such as those of arrow keys: ESC, then [ and all up to a letter, or O
/// and a letter.
std::string without_sequences(std::string_view pressed) {
  std::string keys;
  for (std::size_t i = 0; i < pressed.size(); ++i) {
    if (pressed[i] != '\x1b') {
      keys += pressed[i];
      continue;
    }
    ++i;
    if (i >= pressed.size() || (pressed[i] != '[' && pressed[i] != 'O')) continue;
    ++i;
    while (i < pressed.size() && (pressed[i] < '@' || pressed[i] > '~'))
      ++i;
  }
  return keys;
}

/// Restores the terminal. Only calls that a signal handler may make.
void give_back() {
  if (before.held == 0) return;
  before.held = 0;
  ::tcsetattr(STDIN_FILENO, TCSADRAIN, &before.terminal);
  say(show);
}

/// Restores the terminal, then the former crash handlers, or the system's default.
extern "C" void watch_crashed(int signal) {
  give_back();
  for (std::size_t i = 0; i < crashes.size(); ++i) {
    if (crashes.at(i) == signal) ::sigaction(signal, &before.handlers.at(i), nullptr);
  }
  ::raise(signal);
}

}  // namespace

bool at_terminal() {
  const char* term = std::getenv("TERM");
  return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1 && term != nullptr &&
         std::string_view(term) != "dumb";
}

Keyboard::Keyboard() {
  if (::tcgetattr(STDIN_FILENO, &before.terminal) != 0) {
    throw Error("cannot read the terminal's settings: {}", std::strerror(errno));
  }
  struct sigaction action {};
  action.sa_handler = watch_crashed;
  for (std::size_t i = 0; i < crashes.size(); ++i)
    ::sigaction(crashes.at(i), &action, &before.handlers.at(i));
  acquire();
}

Keyboard::~Keyboard() {
  release();
  for (std::size_t i = 0; i < crashes.size(); ++i)
    ::sigaction(crashes.at(i), &before.handlers.at(i), nullptr);
}

void Keyboard::acquire() {
  termios raw = before.terminal;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  before.held = 1;
  ::tcsetattr(STDIN_FILENO, TCSADRAIN, &raw);
  say(hide);
}

void Keyboard::release() {
  give_back();
}

std::optional<std::string> Keyboard::keys() {
  std::array<char, 256> buffer{};
  const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
  if (got < 0 && (errno == EINTR || errno == EAGAIN)) return "";
  // Reading nothing from a readable terminal means that it is gone.
  if (got <= 0) return std::nullopt;
  return without_sequences({buffer.data(), static_cast<std::size_t>(got)});
}

ScreenSize screen_size() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    return {};
  }
  return {size.ws_col, size.ws_row};
}

}  // namespace carlo
