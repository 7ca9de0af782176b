#include "support/progress.h"

#include "support/terminal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace carlo {

void RemainingTime::update(double fraction, double now) {
  const double before = std::exchange(fraction_, std::clamp(fraction, 0.0, 1.0));
  if (fraction_ <= before) return;
  last_step_ = fraction_ - before;
  last_step_at_ = now;
}

std::optional<double> RemainingTime::estimate(double now) const {
  if (!(fraction_ > 0.01)) return std::nullopt;
  // Work in a few large steps is not slower while one of them goes on: the estimate of the last
  // report runs down, until even a step that ends now would be late. The last one is half done.
  const double left = last_step_at_ / fraction_ - now;
  const double next = std::max(fraction_, std::min(fraction_ + last_step_, 1 - last_step_ / 2));
  return std::max(left, now * (1 - next) / next);
}

Progress::Progress(std::string label, bool enabled, std::chrono::milliseconds line_every)
    : label_(std::move(label)), enabled_(enabled), bar_(stderr_is_interactive()) {
  if (!enabled_) return;
  watcher_ = std::thread([this, line_every] { bar_ ? keep_drawing() : print_lines(line_every); });
}

Progress::~Progress() {
  finish();
  if (watcher_.joinable()) watcher_.join();
}

void Progress::draw(const std::string& more, int width) {
  last_draw_ = Clock::now();
  drawn_ = true;
  const int filled = static_cast<int>(std::lround(time_.fraction() * width));
  // Not fmt::print(), which throws if the terminal is gone: nobody would catch that in the watcher
  // thread.
  std::fputs(fmt::format("\r\x1b[K{} [{:=<{}}{: <{}}] {:3.0f} %  {}", label_, "", filled, "",
                         width - filled, 100 * time_.fraction(), more)
                 .c_str(),
             stderr);
  std::fflush(stderr);
}

void Progress::erase() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

void Progress::update(double fraction) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  last_report_ = now;
  time_.update(fraction, seconds());
  if (!bar_ || (drawn_ && now - last_draw_ < std::chrono::milliseconds(100))) return;
  draw(remaining());
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::string Progress::remaining() const {
  const std::optional<double> left = time_.estimate(seconds());
  return left ? format_seconds(*left) + " left" : "estimating";
}

void Progress::clear() {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  last_report_ = Clock::now();
  erase();
}

void Progress::report_stalls() {
  const std::lock_guard lock(mutex_);
  stalls_ = true;
}

void Progress::finish() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
    erase();
  }
  woken_.notify_all();
}

void Progress::print_lines(std::chrono::milliseconds every) {
  std::unique_lock lock(mutex_);
  while (!woken_.wait_for(lock, every, [this] { return finished_; })) {
    std::fputs(
        fmt::format("{}: {:.0f} %, {}\n", label_, 100 * time_.fraction(), remaining()).c_str(),
        stderr);
    std::fflush(stderr);
  }
}

void Progress::keep_drawing() {
  constexpr std::chrono::seconds patience{4};
  std::unique_lock lock(mutex_);
  while (!woken_.wait_for(lock, std::chrono::milliseconds(200), [this] { return finished_; })) {
    const auto still = Clock::now() - last_report_;
    if (std::min(still, Clock::now() - last_draw_) < std::chrono::seconds(1)) continue;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(still).count();
    if (stalls_ && still >= patience)  // with a short bar, to fit 80 columns
      draw(fmt::format("nothing new for {} s: a loop without end?", seconds), 10);
    else
      draw(remaining());
  }
}

std::string format_seconds(double seconds) {
  if (seconds < 1) return fmt::format("{:.0f} ms", 1000 * seconds);
  if (seconds < 100) return fmt::format("{:.3g} s", seconds);
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace carlo
