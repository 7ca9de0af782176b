#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carlo {

enum class Scale { linear, log };

/// How an axis writes its numbers: as they are, as counts, as durations given in seconds, or as
/// angles in degrees.
enum class Unit { number, count, seconds, degrees };

struct Axis {
  std::string label;
  Unit unit = Unit::number;
  Scale scale = Scale::log;

  /// Finite, and above 0 on a logarithmic axis.
  bool can_show(double value) const;
  /// A value in the axis's unit, for people.
  std::string text(double value) const;
};

struct Point {
  double x = 0, y = 0;
};

/// The part of an axis that is drawn; on a logarithmic one both ends are above 0.
struct Stretch {
  double first = 0, last = 1;
};

/// From a round number to a round number, so that all values that the axis can show lie between.
Stretch round_stretch(const Axis& axis, std::span<const double> values);

/// How large a drawing is, in units of which a letter is some 11 high; it is scaled to its place.
struct Size {
  double width = 360, height = 216;
  double right = 16;  ///< of the width, beside the axes
};

/// How wide a text is in these units, nearly; its tags take no room.
double text_width(std::string_view text);

/// A drawing with two axes, as SVG for a page, whose style sheet gives colours: `style` names one
/// of its classes, c1 to c8 for the colours of series, "dashed", "dotted". Text is escaped; what
/// add() takes is not. What lies outside of the axes is cut off.
class Plot {
 public:
  Plot(const Axis& x, Stretch across, const Axis& y, Stretch up, Size size = {});
  /// A part of the plane in a frame, without numbers.
  Plot(Stretch across, Stretch up, Size size);

  /// Places in the drawing; far outside of the axes they are put nearer.
  double x(double value) const;
  double y(double value) const;

  void add(const std::string& svg) { body_ += svg; }
  /// Outside of the axes, where nothing is cut off.
  void add_around(const std::string& svg) { around_ += svg; }
  /// What has been drawn so far, without the axes: a layer of another plot with the same ones.
  const std::string& body() const { return body_; }
  /// Through the points, interrupted where an axis cannot show one.
  void line(std::string_view style, std::span<const Point> points);
  /// Between two lines; points that an axis cannot show are passed over.
  void band(std::string_view style, std::span<const Point> upper, std::span<const Point> lower);
  /// From the lower end of the y axis to `top`; `title` is shown to whoever points at it.
  void bar(std::string_view style, double from, double to, double top, std::string_view title = "");
  /// From bottom to top.
  void vertical(std::string_view style, double at);
  /// Error bars: from x, y - half_width to x, y + half_width.
  void error_bar(std::string_view style, Point centre, double half_width);
  /// A mark in the shape that belongs to a series, 0 for the first.
  void mark(std::string_view style, std::size_t series, Point at, std::string_view title);
  /// Many points as dots of this size.
  void dots(std::string_view style, std::span<const Point> points, double size);

  /// The drawing; `description` is for those who do not see it.
  std::string svg(std::string_view description) const;

 private:
  bool can_show(Point p) const { return x_.can_show(p.x) && y_.can_show(p.y); }
  std::string step(char command, Point p) const;
  std::string numbers() const;

  Axis x_, y_;
  Stretch across_, up_;
  Size size_;
  std::vector<std::pair<double, std::string>> x_ticks_, y_ticks_;  ///< places and what stands there
  double left_, right_, top_, bottom_;                             ///< where the axes are
  bool framed_ = false;
  std::string body_, around_;
};

/// A function's graph over a stretch.
std::vector<Point> graph(const std::function<double(double)>& f, Stretch across, int steps = 220);

/// The sign of a series in legends: the shape of its marks, 0 for the first.
std::string_view sign_of_series(std::size_t series);

}  // namespace carlo
