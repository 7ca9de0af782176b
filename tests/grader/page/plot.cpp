#include "grader/page/plot.h"

#include "grader/page/text.h"
#include "report/format.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace carlo::grader {
namespace {

/// Round numbers, some five of them, within the interval.
std::vector<double> linear_ticks(Interval on) {
  const double rough = (on.last - on.first) / 4.5;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double lead = rough / power;
  const double step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
  std::vector<double> ticks;
  const double start = std::ceil(on.first / step);
  for (int i = 0; i < 12; ++i) {
    const double tick = (start + i) * step;
    if (tick > on.last * (1 + 1e-12)) break;
    ticks.push_back(std::abs(tick) < 1e-9 * step ? 0 : tick);
  }
  return ticks;
}

/// Powers of ten within the interval, thinned to six; of short intervals their ends.
std::vector<double> log_ticks(Interval on) {
  const int low = static_cast<int>(std::ceil(std::log10(on.first) - 1e-9));
  const int high = static_cast<int>(std::floor(std::log10(on.last) + 1e-9));
  if (high <= low) return {on.first, on.last};
  std::vector<double> ticks;
  const int stride = std::max(1, (high - low + 5) / 6);
  for (int e = low; e <= high; e += stride)
    ticks.push_back(std::pow(10, e));
  return ticks;
}

std::vector<double> ticks_of(Interval on) {
  return on.log ? log_ticks(on) : linear_ticks(on);
}

/// 0 at the interval's first end, 1 at its last.
double share(Interval on, double value) {
  if (!on.log) return (value - on.first) / (on.last - on.first);
  return value > 0 ? std::log(value / on.first) / std::log(on.last / on.first) : -1;
}

double place(Interval on, double value, double from, double to) {
  return from + std::clamp(share(on, value), -0.2, 1.2) * (to - from);
}

}  // namespace

std::string path_step(char command, double x, double y) {
  return fmt::format("{}{:.1f} {:.1f}", command, x, y);
}

Plot::Plot(Interval x, Interval y, std::string x_label, std::string y_label)
    : x_(x), y_(y), x_label_(std::move(x_label)), y_label_(std::move(y_label)) {}

double Plot::x(double value) const {
  return place(x_, value, left, right);
}

double Plot::y(double value) const {
  return place(y_, value, bottom, top);
}

bool Plot::shows(double x_value, double y_value) const {
  const double a = share(x_, x_value), b = share(y_, y_value);
  return a >= -1e-9 && a <= 1 + 1e-9 && b >= -1e-9 && b <= 1 + 1e-9;
}

void Plot::bar(double from, double to, double height_of, const std::string& title) {
  const double x0 = x(from), x1 = x(to), y1 = y(height_of), y0 = y(y_.first);
  add(
      fmt::format("<rect class=\"m\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">"
                  "<title>{}</title></rect>\n",
                  x0, y1, std::max(0.0, x1 - x0 - 0.5), std::max(0.0, y0 - y1), html(title)));
}

void Plot::line(const std::string& path, const char* style) {
  add(fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, path));
}

std::string Plot::svg(const std::string& description) const {
  std::string out =
      fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", width,
                  height, html(description));
  for (const double tick : ticks_of(y_)) {
    out += fmt::format(
        "<path class=\"grid\" d=\"M{:.0f} {:.1f}H{:.0f}\"/>"
        "<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
        left, y(tick), right, left - 5, y(tick) + 3.5, number_text(tick, 3));
  }
  for (const double tick : ticks_of(x_)) {
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n",
                       x(tick), bottom + 14, number_text(tick, 3));
  }
  // A picture within the picture cuts off what is outside of the axes.
  out += fmt::format(
      "<svg x=\"{0:.0f}\" y=\"{1:.0f}\" width=\"{2:.0f}\" height=\"{3:.0f}\" viewBox=\"{0:.0f} "
      "{1:.0f} {2:.0f} {3:.0f}\">\n{4}</svg>\n",
      left, top, right - left, bottom - top + 1, body_);
  out += fmt::format("<path class=\"axis\" d=\"M{:.0f} {:.0f}H{:.0f}\"/>\n", left, bottom, right);
  out += fmt::format(
      "<text class=\"label\" x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n",
      (left + right) / 2, height - 8, html(x_label_));
  if (!y_label_.empty()) {
    out += fmt::format(
        "<text class=\"label\" transform=\"translate(9 {:.0f}) rotate(-90)\" "
        "text-anchor=\"middle\">{}</text>\n",
        (top + bottom) / 2, html(y_label_));
  }
  return out + "</svg>\n";
}

}  // namespace carlo::grader
