#include "course/watch/watch.h"

#include "course/cli/descriptor.h"
#include "course/cli/scratch_folder.h"
#include "course/cli/wrap.h"
#include "course/watch/file_events.h"
#include "course/watch/keyboard.h"
#include "course/watch/session.h"
#include "support/error.h"
#include "support/terminal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// One save causes several events, and an editor may write twice.
constexpr std::chrono::milliseconds calm{40};

/// Makes signals pollable: each writes its number into a pipe. One object at a time.
class Signals {
 public:
  Signals() : pipe_(make_pipe()) {
    for (const int end : {pipe_.read.get(), pipe_.write.get()})
      ::fcntl(end, F_SETFL, O_NONBLOCK);
    into_ = pipe_.write.get();
    struct sigaction tell {};
    tell.sa_handler = [](int signal) {
      const int error = errno;
      const auto number = static_cast<unsigned char>(signal);
      // If the pipe is full, it already holds more than anybody will read.
      [[maybe_unused]] const ssize_t written = ::write(into_, &number, 1);
      errno = error;
    };
    tell.sa_flags = SA_RESTART;
    ::sigemptyset(&tell.sa_mask);
    for (std::size_t i = 0; i < awaited.size(); ++i)
      ::sigaction(awaited[i], &tell, &before_[i]);
  }
  ~Signals() {
    for (std::size_t i = 0; i < awaited.size(); ++i)
      ::sigaction(awaited[i], &before_[i], nullptr);
  }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  int fd() const { return pipe_.read.get(); }
  /// Returns the next pending signal; 0 if there is none.
  int next() const {
    unsigned char number = 0;
    return ::read(fd(), &number, 1) == 1 ? number : 0;
  }

 private:
  static constexpr std::array<int, 6> awaited{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGWINCH};
  static inline volatile std::sig_atomic_t into_ = -1;

  Pipe pipe_;
  std::array<struct sigaction, awaited.size()> before_{};
};

/// Makes every line dim and removes other colours, since the text belongs to the previous run.
std::string faded(const std::string& text) {
  std::istringstream lines(without_escapes(text));
  std::string out;
  for (std::string line; std::getline(lines, line);)
    out += (line.empty() ? "" : coloured(Colour::dim, line)) + "\n";
  return out;
}

/// Shows the session: on a redrawn screen, or as lines.
class Display {
 public:
  explicit Display(bool whole_screen) : whole_screen_(whole_screen) {}

  void show(const WatchSession& session) {
    if (whole_screen_) {
      draw(session);
    } else if (!session.busy()) {
      fmt::print("{}\n", session.body());
    } else if (session.activity() != said_) {
      said_ = session.activity();
      fmt::print("{}\n", said_);
    }
    (void)std::fflush(stdout);
  }

 private:
  static void draw(const WatchSession& session) {
    const ScreenSize size = screen_size();
    const std::string keys =
        "h hint  n next  p previous  a all  r run again  l list  v in full  q quit";
    const std::string head = wrapped_to(session.heading(), size.columns);
    const std::string activity = session.activity();
    const std::string foot = wrapped_to(
        activity.empty() ? coloured(Colour::dim, keys) : coloured(Colour::blue, activity),
        size.columns);
    const auto lines = [](const std::string& text) {
      return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    };
    std::string body = wrapped_to(session.body(), size.columns);
    if (session.busy()) body = faded(body);
    // Less two empty lines and the line of the cursor.
    const int room = std::max(size.rows - lines(head) - lines(foot) - 3, 3);
    if (session.in_short()) body = first_rows(body, room, "press v");
    // Clears the rest while drawing, to avoid flicker.
    std::string screen = "\x1b[H";
    for (const char c : fmt::format("{}\n{}\n{}", head, body, foot)) {
      if (c == '\n') screen += "\x1b[K";
      screen += c;
    }
    fmt::print("{}\x1b[J", screen);
  }

  bool whole_screen_;
  std::string said_;
};

class Watch {
 public:
  Watch(const WatchPlaces& places, const Lab& lab, bool look)
      : session_(places, lab), events_(folders(places, lab), look), display_(at_terminal()) {
    if (at_terminal()) keyboard_.emplace();
    if (keyboard_) fmt::print("\x1b[2J");
    if (!keyboard_) {
      fmt::print("watching lab {}{}; Ctrl-C ends\n", lab.number,
                 events_.polls() ? fmt::format(" (looking every {} ms)", events_.interval_ms) : "");
    }
  }

  int run() {
    session_.run();
    display_.show(session_);
    while (!session_.quits() && code_ == 0)
      step();
    keyboard_.reset();
    return code_;
  }

 private:
  static std::vector<fs::path> folders(const WatchPlaces& places, const Lab& lab) {
    std::vector<fs::path> list;
    for (const fs::path& file : own_files(places.labs(), lab))
      list.push_back(file.parent_path());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  void step() {
    // poll() ignores descriptors below 0.
    std::array<pollfd, 4> wait{{{signals_.fd(), POLLIN, 0},
                                {session_.child() ? session_.child()->fd() : -1, POLLIN, 0},
                                {events_.fd(), POLLIN, 0},
                                {keyboard_ ? STDIN_FILENO : -1, POLLIN, 0}}};
    if (::poll(wait.data(), wait.size(), timeout()) < 0 && errno != EINTR) {
      throw Error("cannot wait: {}", std::strerror(errno));
    }
    if (wait[0].revents != 0) handle_signals();
    if (wait[1].revents != 0 && session_.child_spoke()) display_.show(session_);
    if (wait[2].revents != 0 || events_.polls()) look_at_files();
    if (wait[3].revents != 0) handle_keys();
    if (changed_ && Clock::now() - *changed_ >= calm) {
      changed_.reset();
      session_.files_changed();
      display_.show(session_);
    }
  }

  int timeout() const {
    if (changed_) return static_cast<int>(calm.count());
    return events_.polls() ? FileEvents::interval_ms : -1;
  }

  void look_at_files() {
    if (events_.happened()) changed_ = Clock::now();
  }

  void handle_keys() {
    const std::optional<std::string> keys = keyboard_->keys();
    if (!keys) {
      code_ = 128 + SIGHUP;
      return;
    }
    bool anew = false;
    for (const char key : *keys) {
      if (!session_.quits()) anew = session_.key(key) || anew;
    }
    if (anew) display_.show(session_);
  }

  void handle_signals() {
    while (const int signal = signals_.next()) {
      if (signal == SIGTSTP) {
        if (keyboard_) keyboard_->release();
        ::raise(SIGSTOP);
        if (keyboard_) keyboard_->acquire();
      } else if (signal != SIGWINCH) {
        code_ = 128 + signal;
        return;
      }
      if (keyboard_) {
        fmt::print("\x1b[2J");
        display_.show(session_);
      }
    }
  }

  Signals signals_;
  WatchSession session_;
  FileEvents events_;
  Display display_;
  std::optional<Keyboard> keyboard_;
  std::optional<Clock::time_point> changed_;
  int code_ = 0;
};

}  // namespace

int watch(const WatchOptions& options) {
  const ScratchFolder scratch;
  // Files that child processes leave behind go there too.
  ::setenv("TMPDIR", scratch.path().c_str(), 1);
  const fs::path run = options.build / "run";
  fs::create_directories(run);
  const ScratchFolder own(run);
  ::setenv("CARLO_TURN_OF",
           fmt::format("./carlo watch {} (process {})", options.lab, ::getpid()).c_str(), 1);
  const WatchPlaces places{options.root, options.build, scratch.path(), own.path()};
  const std::vector<Lab> labs = load_labs(places.labs());
  return Watch(places, find_lab(labs, options.lab), options.look).run();
}

}  // namespace carlo
