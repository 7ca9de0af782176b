#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carlo {

enum class Scale { linear, log };

/// How an axis formats its numbers: as they are, as counts, as durations in seconds, or as angles
/// in degrees.
enum class Unit { number, count, seconds, degrees };

struct Axis {
  std::string label;
  Unit unit = Unit::number;
  Scale scale = Scale::log;

  /// Returns whether the value is finite and, on a logarithmic axis, above 0.
  bool can_show(double value) const;
  /// Formats a value in the axis's unit, for people.
  std::string text(double value) const;
};

struct Point {
  double x = 0, y = 0;
};

/// The part of an axis that is drawn; on a logarithmic axis both ends are above 0.
struct Stretch {
  double first = 0, last = 1;
};

/// Returns a stretch between round numbers that contains all values that the axis can show.
Stretch round_stretch(const Axis& axis, std::span<const double> values);

/// The size of a drawing, in units of which a letter is about 11 high; it is scaled to its place.
struct Size {
  double width = 360, height = 216;
  double right = 16;  ///< part of the width, next to the axes
};

/// Returns the approximate width of a text in these units; its tags take no room.
double text_width(std::string_view text);

/// A drawing with two axes, as SVG for a page, whose style sheet gives colours: `style` names one
/// of its classes, c1 to c8 for the colours of series, "dashed", "dotted". Text is escaped; the
/// argument of add() is not. Everything outside the axes is clipped.
class Plot {
 public:
  Plot(const Axis& x, Stretch across, const Axis& y, Stretch up, Size size = {});
  /// Draws a part of the plane in a frame, without numbers.
  Plot(Stretch across, Stretch up, Size size);

  /// Returns coordinates in the drawing; values far outside the axes are moved closer.
  double x(double value) const;
  double y(double value) const;

  void add(const std::string& svg) { body_ += svg; }
  /// Adds to the region outside the axes, where nothing is clipped.
  void add_around(const std::string& svg) { around_ += svg; }
  /// Returns what has been drawn so far, without the axes: a layer for another plot with the same
  /// axes.
  const std::string& body() const { return body_; }
  /// Draws a line through the points, interrupted where an axis cannot show one.
  void line(std::string_view style, std::span<const Point> points);
  /// Fills between two lines; skips points that an axis cannot show.
  void band(std::string_view style, std::span<const Point> upper, std::span<const Point> lower);
  /// Draws a bar from the lower end of the y axis to `top`; `title` is shown on hovering.
  void bar(std::string_view style, double from, double to, double top, std::string_view title = "");
  /// Draws a line from bottom to top.
  void vertical(std::string_view style, double at);
  /// Draws an error bar from x, y - half_width to x, y + half_width.
  void error_bar(std::string_view style, Point centre, double half_width);
  /// Draws a mark in the shape of a series, 0 for the first.
  void mark(std::string_view style, std::size_t series, Point at, std::string_view title);
  /// Draws many points as dots of this size.
  void dots(std::string_view style, std::span<const Point> points, double size);

  /// Returns the drawing; `description` is for those who cannot see it.
  std::string svg(std::string_view description) const;

 private:
  bool can_show(Point p) const { return x_.can_show(p.x) && y_.can_show(p.y); }
  std::string step(char command, Point p) const;
  std::string numbers() const;

  Axis x_, y_;
  Stretch across_, up_;
  Size size_;
  std::vector<std::pair<double, std::string>> x_ticks_, y_ticks_;  ///< places and labels
  double left_, right_, top_, bottom_;                             ///< where the axes are
  bool framed_ = false;
  std::string body_, around_;
};

/// Returns a function's graph over a stretch.
std::vector<Point> graph(const std::function<double(double)>& f, Stretch across, int steps = 220);

/// Returns the sign of a series in legends: the shape of its marks, 0 for the first.
std::string_view sign_of_series(std::size_t series);

}  // namespace carlo
