#include "course/report/plot.h"

#include "course/report/format.h"
#include "course/report/html.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace carlo {
namespace {

constexpr double frame_air = 8;  ///< around a frame, for marks at its edges

using Ticks = std::vector<std::pair<double, std::string>>;

std::string with_minus(std::string number) {
  if (number.starts_with('-')) number.replace(0, 1, "−");
  return number;
}

/// Typesets "2e-5" as 2·10 to the power of −5, and a hyphen as a minus. Few fonts have all
/// superscripts.
std::string typeset(std::string text) {
  const std::size_t e = text.find('e');
  if (e != std::string::npos) {
    const std::string factor = text.substr(0, e), power = text.substr(e + 1);
    text = fmt::format("{}10<tspan dy=\"-4\" font-size=\"8.5\">{}</tspan>",
                       factor == "1" ? "" : factor + "·", with_minus(power));
  }
  return with_minus(text);
}

/// Formats the number at a tick. `step` is the distance to the next tick, a factor on a logarithmic
/// axis; it determines the number of digits.
std::string tick_text(const Axis& axis, double value, double step) {
  if (axis.unit == Unit::seconds) return duration_text(value);
  const double size = std::abs(value);
  if (axis.scale == Scale::log) {
    const bool plain = size < 1e4 && size > (step > 9 ? 0.05 : 0.0009);
    const double power = std::floor(std::log10(size) + 1e-9);
    return plain
               ? number_text(value, 3)
               : typeset(fmt::format("{}e{}", number_text(value / std::pow(10, power), 2), power));
  }
  const double digits = std::floor(std::log10(size)) - std::floor(std::log10(step));
  // Written so that NaN, from a distance that is 0 or too large, gives 0.
  const double kept = digits > 0 ? std::min(digits, 9.0) : 0;
  return typeset(number_text(value, static_cast<int>(kept) + 1));
}

bool whole(double value) {
  return std::abs(value - std::round(value)) < 1e-6;
}

/// Returns possible distances between ticks, increasing, from about a hundredth of the stretch on.
std::vector<double> linear_steps(const Axis& axis, double length) {
  if (axis.unit == Unit::degrees) return {1, 2, 5, 10, 15, 30, 45, 90, 180};
  std::vector<double> steps;
  const double power = std::floor(std::log10(length)) - 2;
  for (int k = 0; k < 4; ++k) {
    for (const double lead : {1, 2, 5})
      steps.push_back(lead * std::pow(10, power + k));
  }
  return steps;
}

std::vector<double> linear_ticks(const Axis& axis, Stretch on, std::size_t most) {
  std::vector<double> best;
  const double length = on.last - on.first;
  for (const double step : linear_steps(axis, length)) {
    if (length / step > static_cast<double>(most)) continue;
    // Ticks that reach both ends make up for slightly fewer ticks.
    const bool to_the_ends = whole(on.first / step) && whole(on.last / step);
    if (!best.empty() && !(to_the_ends && length / step > 1.5)) continue;
    best.clear();
    const double start = std::ceil(on.first / step - 1e-6);
    for (std::size_t i = 0; i <= most; ++i) {
      const double tick = (start + static_cast<double>(i)) * step;
      if (tick <= on.last + 1e-6 * step) best.push_back(tick);
    }
    if (to_the_ends) break;
  }
  return best;
}

/// Returns powers of ten, thinned if there are many; also 2 and 5 times them if there are few.
std::vector<double> log_ticks(Stretch on, std::size_t most) {
  const int low = static_cast<int>(std::ceil(std::log10(on.first) - 1e-9));
  const int high = static_cast<int>(std::floor(std::log10(on.last) + 1e-9));
  std::vector<double> ticks;
  for (int e = low - 1; e <= high && high - low < 3; ++e) {
    for (const double lead : {1, 2, 5}) {
      const double value = lead * std::pow(10, e);
      if (value >= on.first * (1 - 1e-9) && value <= on.last * (1 + 1e-9)) ticks.push_back(value);
    }
  }
  if (ticks.size() >= 2 && ticks.size() <= most + 1) return ticks;
  ticks.clear();
  const int decades = high - low;
  const int least = std::max(1, (decades + static_cast<int>(most) - 1) / static_cast<int>(most));
  // Ticks that reach both ends make up for slightly fewer ticks.
  int stride = least;
  while (decades % stride != 0 && stride <= 2 * least)
    ++stride;
  if (decades % stride != 0) stride = least;
  for (int e = low; e <= high; e += stride)
    ticks.push_back(std::pow(10, e));
  if (ticks.size() < 2) return {on.first, on.last};
  return ticks;
}

Ticks ticks_of(const Axis& axis, Stretch on, std::size_t most) {
  Ticks ticks;
  const bool log = axis.scale == Scale::log;
  const std::vector<double> places = log ? log_ticks(on, most) : linear_ticks(axis, on, most);
  double step = 1;
  if (places.size() > 1) step = log ? places[1] / places[0] : places[1] - places[0];
  for (const double place : places)
    ticks.push_back({place, tick_text(axis, place, step)});
  return ticks;
}

double widest_text(const Ticks& ticks) {
  double widest = 0;
  for (const auto& [place, text] : ticks)
    widest = std::max(widest, text_width(text));
  return widest;
}

/// Returns 0 at the stretch's first end, 1 at its last.
double share(const Axis& axis, Stretch on, double value) {
  if (axis.scale == Scale::linear) return (value - on.first) / (on.last - on.first);
  return std::log(value / on.first) / std::log(on.last / on.first);
}

/// Returns the nearest of 1, 2 and 5 times powers of ten that is not above the value, or not below
/// it.
double round_number(double value, bool up) {
  const double power = std::pow(10, std::floor(std::log10(value) + 1e-9));
  const double lead = value / power;
  if (up) return power * (lead < 1 + 1e-6 ? 1 : lead < 2 + 1e-6 ? 2 : lead < 5 + 1e-6 ? 5 : 10);
  return power * (lead > 5 - 1e-6 ? 5 : lead > 2 - 1e-6 ? 2 : 1);
}

Stretch round_log(double low, double high) {
  if (high > 100 * low) {
    return {std::pow(10, std::floor(std::log10(low) + 1e-6)),
            std::pow(10, std::ceil(std::log10(high) - 1e-6))};
  }
  const Stretch on{round_number(low, false), round_number(high, true)};
  return on.first < on.last ? on : Stretch{on.first / 2, on.last * 2};
}

// The shape of a mark around its place: a path of relative steps.
struct Shape {
  std::string_view sign, path;
};
constexpr std::array<Shape, 7> shapes = {{
    {"●", "m-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0"},
    {"■", "m-2.7-2.7h5.4v5.4h-5.4z"},
    {"▲", "m0-3.6l3.4 6h-6.8z"},
    {"◆", "m0-3.8l3.8 3.8-3.8 3.8-3.8-3.8z"},
    {"✚", "m-1-3.6h2v2.6h2.6v2h-2.6v2.6h-2v-2.6h-2.6v-2h2.6z"},
    {"✖", "m0-1.4l2-2 1.4 1.4-2 2 2 2-1.4 1.4-2-2-2 2-1.4-1.4 2-2-2-2 1.4-1.4z"},
    {"▼", "m0 3.6l3.4-6h-6.8z"},
}};

}  // namespace

double text_width(std::string_view text) {
  constexpr double letter = 6.2;  // on average
  bool in_tag = false;
  return letter * static_cast<double>(std::count_if(text.begin(), text.end(), [&](char c) {
           if (c == '<' || c == '>') in_tag = c == '<';
           return !in_tag && c != '>' && (static_cast<unsigned char>(c) & 0xC0) != 0x80;
         }));
}

bool Axis::can_show(double value) const {
  return std::isfinite(value) && (scale == Scale::linear || value > 0);
}

std::string Axis::text(double value) const {
  if (unit == Unit::seconds) return duration_text(value);
  return number_text(value, unit == Unit::count ? 7 : 4);
}

std::string_view sign_of_series(std::size_t series) {
  return shapes[series % shapes.size()].sign;
}

Stretch round_stretch(const Axis& axis, std::span<const double> values) {
  Stretch on{HUGE_VAL, -HUGE_VAL};
  for (const double value : values) {
    if (!axis.can_show(value)) continue;
    const double near = std::clamp(value, -1e300, 1e300);  // so that differences are finite
    on = {std::min(on.first, near), std::max(on.last, near)};
  }
  if (!(on.first <= on.last)) return {axis.scale == Scale::log ? 0.1 : 0, 1};
  if (axis.scale == Scale::log) return round_log(on.first, on.last);
  if (!(on.last - on.first > 1e-9 * std::abs(on.last))) {
    const double air = on.last == 0 ? 1 : 0.1 * std::abs(on.last);
    on = {on.first - air, on.last + air};
  }
  for (const double step : linear_steps(axis, on.last - on.first)) {
    if ((on.last - on.first) / step > 6) continue;
    return {step * std::floor(on.first / step + 1e-6), step * std::ceil(on.last / step - 1e-6)};
  }
  return on;
}

Plot::Plot(const Axis& x, Stretch across, const Axis& y, Stretch up, Size size)
    : x_(x),
      y_(y),
      across_(across),
      up_(up),
      size_(size),
      y_ticks_(ticks_of(y, up, static_cast<std::size_t>(std::max(6.0, size.height / 34)))),
      right_(size.width - size.right),
      top_(8),
      bottom_(size.height - (x.label.empty() ? 20 : 38)) {
  left_ = widest_text(y_ticks_) + (y.label.empty() ? 8 : 24);
  // As many as fit side by side.
  for (std::size_t most = 8; most > 0; --most) {
    x_ticks_ = ticks_of(x, across, most);
    const double wide = widest_text(x_ticks_) + 8;
    if (std::adjacent_find(x_ticks_.begin(), x_ticks_.end(), [&](const auto& a, const auto& b) {
          return this->x(b.first) - this->x(a.first) < wide;
        }) == x_ticks_.end()) {
      break;
    }
  }
}

Plot::Plot(Stretch across, Stretch up, Size size)
    : x_{"", Unit::number, Scale::linear},
      y_(x_),
      across_(across),
      up_(up),
      size_(size),
      left_(frame_air),
      right_(size.width - frame_air),
      top_(frame_air),
      bottom_(size.height - frame_air),
      framed_(true) {}

double Plot::x(double value) const {
  return left_ + std::clamp(share(x_, across_, value), -9.0, 9.0) * (right_ - left_);
}

double Plot::y(double value) const {
  return bottom_ - std::clamp(share(y_, up_, value), -9.0, 9.0) * (bottom_ - top_);
}

std::string Plot::step(char command, Point p) const {
  return fmt::format("{}{:.1f} {:.1f}", command, x(p.x), y(p.y));
}

void Plot::line(std::string_view style, std::span<const Point> points) {
  std::string path;
  bool pen_down = false;
  for (const Point p : points) {
    if (can_show(p)) path += step(pen_down ? 'L' : 'M', p);
    pen_down = can_show(p);
  }
  add(fmt::format("<path class=\"line {}\" d=\"{}\"/>\n", style, path));
}

void Plot::band(std::string_view style, std::span<const Point> upper,
                std::span<const Point> lower) {
  std::string path;
  for (const Point p : upper)
    if (can_show(p)) path += step(path.empty() ? 'M' : 'L', p);
  for (std::size_t i = lower.size(); i-- > 0;)
    if (can_show(lower[i])) path += step(path.empty() ? 'M' : 'L', lower[i]);
  add(fmt::format("<path class=\"band {}\" d=\"{}Z\"/>\n", style, path));
}

void Plot::bar(std::string_view style, double from, double to, double top, std::string_view title) {
  const double x0 = x(from), y1 = y_.can_show(top) ? std::min(y(top), bottom_) : bottom_;
  add(fmt::format(
      "<rect class=\"bar {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
      "height=\"{:.1f}\"><title>{}</title></rect>\n",
      style, x0, y1, std::max(0.0, x(to) - x0 - 0.5), bottom_ - y1, html_escaped(title)));
}

void Plot::vertical(std::string_view style, double at) {
  if (!(at >= across_.first && at <= across_.last)) return;
  add(fmt::format("<path class=\"line {}\" d=\"M{:.1f} {:.0f}V{:.0f}\"/>\n", style, x(at), top_,
                  bottom_));
}

void Plot::error_bar(std::string_view style, Point centre, double half_width) {
  if (!can_show(centre) || !std::isfinite(half_width)) return;
  add(fmt::format("<path class=\"line {}\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", style, x(centre.x),
                  y(centre.y - half_width), y(centre.y + half_width)));
}

void Plot::mark(std::string_view style, std::size_t series, Point at, std::string_view title) {
  if (!can_show(at)) return;
  add(fmt::format("<path class=\"mark {}\" d=\"{}{}\"><title>{}</title></path>\n", style,
                  step('M', at), shapes[series % shapes.size()].path, html_escaped(title)));
}

void Plot::dots(std::string_view style, std::span<const Point> points, double size) {
  std::string path;  // strokes of length 0 with round ends
  for (const Point p : points)
    if (can_show(p)) path += step('M', p) + "h0";
  add(fmt::format("<path class=\"dots {}\" stroke-width=\"{:.1f}\" d=\"{}\"/>\n", style, size,
                  path));
}

std::vector<Point> graph(const std::function<double(double)>& f, Stretch across, int steps) {
  std::vector<Point> points;
  for (int i = 0; i < steps; ++i) {
    const double x = across.first + (across.last - across.first) * (i + 0.5) / steps;
    points.push_back({x, f(x)});
  }
  return points;
}

std::string Plot::numbers() const {
  std::string grid, texts;
  for (const auto& [place, text] : y_ticks_) {
    grid += fmt::format("M{:.1f} {:.1f}H{:.1f}", left_, y(place), right_);
    texts += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
                         left_ - 5, y(place) + 3.5, text);
  }
  for (const auto& [place, text] : x_ticks_) {
    grid += fmt::format("M{:.1f} {:.1f}V{:.1f}", x(place), top_, bottom_);
    texts += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                         x(place), bottom_ + 14, text);
  }
  return fmt::format("<path class=\"grid\" d=\"{}\"/>\n", grid) + texts;
}

std::string Plot::svg(std::string_view description) const {
  const double air = framed_ ? frame_air : 4;  // for marks on the ends of the axes
  std::string out = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n{}",
      size_.width, size_.height, html_escaped(description), numbers());
  // A nested picture clips everything outside the axes.
  out += fmt::format(
      "<svg x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" viewBox=\"{0:.1f} "
      "{1:.1f} {2:.1f} {3:.1f}\">\n{4}</svg>\n",
      left_ - air, top_ - air, right_ - left_ + 2 * air, bottom_ - top_ + 2 * air, body_);
  out += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.0f}V{:.0f}H{:.0f}{}\"/>\n", left_, top_,
                     bottom_, right_, framed_ ? fmt::format("V{:.0f}Z", top_) : "");
  if (!x_.label.empty()) {
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       (left_ + right_) / 2, size_.height - 6, html_escaped(x_.label));
  }
  if (!y_.label.empty()) {
    out += fmt::format(
        "<text transform=\"translate(10 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (top_ + bottom_) / 2, html_escaped(y_.label));
  }
  return out + around_ + "</svg>\n";
}

}  // namespace carlo
