#include "grader/judge/process.h"

#include "grader/judge/kinship.h"
#include "grader/judge/spawn.h"
#include "grader/judge/waits.h"
#include "grader/judge/watch.h"
#include "support/error.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>
#include <thread>

namespace carlo::grader {
namespace {

using Clock = std::chrono::steady_clock;

/// Reads everything available. Returns false if more than `most` bytes have come; stores only
/// `kept` of them. Closes the descriptor at its end.
class Reader {
 public:
  Reader(Descriptor fd, std::size_t most, std::size_t kept)
      : fd_(std::move(fd)), most_(most), kept_(kept) {}

  bool drain() {
    while (fd_.open() && seen_ <= most_) {
      const ssize_t got = ::read(fd_.get(), block_.data(), block_.size());
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) break;
      if (got == 0) fd_.close();
      const auto bytes = static_cast<std::size_t>(got);
      seen_ += bytes;
      const std::size_t fit = std::min(bytes, kept_ - std::min(kept_, text_.size()));
      text_.append(block_.data(), fit);
      if (fit > 0) last_ = text_.back();
      for (const char c : std::string_view(block_.data(), bytes).substr(fit)) {
        lost_lines_ += last_ == '\n' ? 1 : 0;
        last_ = c;
      }
    }
    return seen_ <= most_;
  }

  int fd() const { return fd_.get(); }
  bool open() const { return fd_.open(); }
  std::string take() { return std::move(text_); }
  /// Returns how many lines began in the part that was not stored.
  std::size_t lost_lines() const { return lost_lines_; }

 private:
  Descriptor fd_;
  std::size_t most_, kept_;
  std::size_t seen_ = 0, lost_lines_ = 0;
  char last_ = '\n';  ///< of all bytes read
  std::string text_;
  std::array<char, 65536> block_{};
};

/// Returns whether the child has ended, and how. It is not reaped yet, so its process group keeps
/// its id.
bool ended(pid_t pid, Outcome& outcome) {
  siginfo_t info{};
  if (::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0) {
    throw Error("lost sight of the program that was started: {}", std::strerror(errno));
  }
  if (info.si_pid != pid) return false;
  const bool exited = info.si_code == CLD_EXITED;
  outcome.end = exited ? Outcome::End::exited : Outcome::End::signalled;
  outcome.code = info.si_status;
  return true;
}

/// Returns the limit that the processes together exceed, if any; no limit of a single process
/// detects that.
std::optional<Outcome::End> broken_together(const Family& family, const Command& command,
                                            const Limits& limits) {
  const std::optional<std::string>& folder = command.confinement.measured;
  if (folder && fuller_than(*folder, family, limits.scratch_bytes)) {
    return Outcome::End::flooded_disk;
  }
  const bool counted = limits.memory_bytes != unlimited && !address_sanitizer();
  if (counted && memory_bytes(family) > limits.memory_bytes) return Outcome::End::flooded_memory;
  // The system counts them per user, together with those of others who have the same user.
  constexpr std::size_t sandbox_own = 16;
  const bool few =
      limits.processes == unlimited || threads_of(family) <= limits.processes + sandbox_own;
  if (!few) return Outcome::End::flooded_processes;
  return {};
}

/// The seconds since a child was started, except those in which it waited for a processor that
/// others used, or for the disk from which its pages come.
class Charge {
 public:
  double taken() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Call on every pass. The watcher sleeps for hundredths of a second and looks every tenth: if it
  /// comes much later, without having waited for a processor, everything stood still (a frozen
  /// control group, a migrated virtual machine).
  void beat() {
    const double now = taken(), waited = held_up();
    const double gap = (now - last_beat_) - (waited - last_wait_);
    if (gap > longest_beat) frozen_ += gap;
    last_beat_ = now;
    last_wait_ = waited;
  }

  /// Inspects all its processes.
  void look(const Family& family) {
    const double now = taken(), held = held_up(), passed = now - last_.taken;
    const double worked = (processor_seconds(family) + reaped() - reaped_) / processors_;
    // The current state is taken as that since the last look.
    if (blocked(family)) blocked_ += passed;
    // The process that starts it and takes it down waits too, on its behalf.
    const double longest = std::max(waits_.look(family, passed), held - last_.held_up);
    const double most = passed - (frozen_ - last_.frozen) - (worked - worked_);
    waited_ += std::clamp(longest, 0., std::max(0., most));
    worked_ = worked;
    last_ = {now, held, frozen_};
  }

  /// A program can make itself wait for a disk, and so gains up to two deadlines.
  double waited(std::chrono::duration<double> deadline) const {
    return waited_ + frozen_ + std::min(blocked_, 2 * deadline.count());
  }
  double ran() const { return waits_.longest_run(); }
  Pressure pressure() const { return {taken(), held_up() + frozen_, worked_}; }

  /// Returns whether its time was over at the last beat, and whether that is its own fault. Whether
  /// everything has stood still since then is not known yet.
  std::optional<Outcome::End> over(std::chrono::duration<double> deadline) const {
    const bool enough = last_beat_ - waited(deadline) >= deadline.count();
    // Many processes that compete with one another run little each, but together as long as one
    // may.
    const bool ran = this->ran() >= deadline.count() || worked_ >= deadline.count();
    const bool proven = ran || !pressure().is_high();
    if (enough && proven) return Outcome::End::deadline;
    if (last_beat_ - frozen_ >= patience * deadline.count()) return Outcome::End::starved;
    return {};
  }

 private:
  static constexpr double longest_beat = 1;  ///< seconds

  double held_up() const { return own_times().waited - own_wait_; }

  /// Returns the processor seconds of children that have been reaped.
  static double reaped() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }

  Clock::time_point start_ = Clock::now();
  double processors_ = std::max(1U, std::thread::hardware_concurrency());
  double reaped_ = reaped(), own_wait_ = own_times().waited;
  double waited_ = 0, worked_ = 0;
  double frozen_ = 0, last_beat_ = 0, last_wait_ = 0;
  double blocked_ = 0;
  Waits waits_;
  struct {
    double taken = 0, held_up = 0, frozen = 0;
  } last_;  ///< values at the last look
};

/// Watches the child until it ends or exceeds a limit.
void follow(pid_t pid, Reader& result, Reader& output, const Command& command, const Limits& limits,
            Charge& charge, Outcome& outcome) {
  Clock::time_point next_look = Clock::now() + std::chrono::milliseconds(100);
  while (true) {
    charge.beat();
    const bool over = ended(pid, outcome);  // checked first: all that it wrote is available by now
    if (!result.drain()) outcome.end = Outcome::End::flooded_result;
    if (!output.drain()) outcome.end = Outcome::End::flooded_output;
    if (over || outcome.end != Outcome::End::not_started) return;
    if (const Clock::time_point begun = Clock::now(); begun >= next_look) {
      const Family family = descendants_of(::getpid());
      charge.look(family);
      charge.beat();
      if (const auto over_time = charge.over(limits.deadline)) {
        outcome.end = *over_time;
        return;
      }
      if (const auto broken = broken_together(family, command, limits)) {
        outcome.end = *broken;
        return;
      }
      // When many are watched at a time, the watchers must not use up the machine.
      const Clock::duration cost = Clock::now() - begun;
      next_look =
          Clock::now() + std::clamp<Clock::duration>(10 * cost, std::chrono::milliseconds(100),
                                                     std::chrono::milliseconds(500));
    }
    // Closed descriptors are -1, which poll() skips. The short wait bounds how late we notice an
    // end that a surviving grandchild hides by holding the pipes.
    std::array<pollfd, 2> waiting{pollfd{result.fd(), POLLIN, 0}, pollfd{output.fd(), POLLIN, 0}};
    ::poll(waiting.data(), waiting.size(), result.open() || output.open() ? 10 : 1);
  }
}

}  // namespace

Outcome run_limited(const Command& command, const Limits& limits) {
  adopt_orphans();
  Charge charge;
  Spawned child = spawn(command, limits);
  if (!child.problem.empty()) {
    end_orphans();
    Outcome none;
    none.output = child.problem;
    return none;
  }
  Reader result(std::move(child.result), limits.result_bytes, limits.result_bytes);
  Reader output(std::move(child.output), limits.output_bytes, limits.output_kept);
  Outcome outcome;
  follow(child.pid, result, output, command, limits, charge, outcome);
  ::kill(-child.pid, SIGKILL);
  outcome.peak_bytes = end_orphans();
  charge.look({});
  outcome.waited = charge.waited(limits.deadline);
  outcome.ran = charge.ran();
  outcome.pressure = charge.pressure();
  outcome.result = result.take();
  outcome.output = output.take();
  outcome.lost_lines = output.lost_lines();
  outcome.seconds = charge.taken();
  return outcome;
}

Pressure& Pressure::operator+=(const Pressure& other) {
  seconds += other.seconds;
  held_up += other.held_up;
  worked += other.worked;
  return *this;
}

std::string signal_name(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "segmentation fault";
    case SIGABRT:
      return "abort";
    case SIGFPE:
      return "division of a whole number by zero";
    case SIGILL:
      return "illegal instruction";
    case SIGBUS:
      return "bus error";
    case SIGKILL:
      return "killed";
    case SIGXCPU:
      return "too much processor time";
    case SIGXFSZ:
      return "too large a file";
    case SIGPIPE:
      return "broken pipe";
    default:
      return fmt::format("signal {}", signal);
  }
}

bool address_sanitizer() {
#if defined(__SANITIZE_ADDRESS__)
  return true;
#elif defined(__has_feature)
  return __has_feature(address_sanitizer);
#else
  return false;
#endif
}

}  // namespace carlo::grader
