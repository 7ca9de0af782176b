#pragma once

#include <string>

namespace carlo::grader {

/// An interval of an axis. `log`: both ends are above 0.
struct Interval {
  double first = 0, last = 1;
  bool log = false;
};

/// A drawing with two axes, ticks and labels, as SVG whose colours are the page's. Text is escaped;
/// what add() takes is not.
class Plot {
 public:
  Plot(Interval x, Interval y, std::string x_label, std::string y_label);

  /// Places in the drawing. Those outside of the axes are put a little beyond their ends, so that
  /// lines leave the picture where they should; the drawing area cuts them off.
  double x(double value) const;
  double y(double value) const;
  bool shows(double x_value, double y_value) const;

  void add(const std::string& svg) { body_ += svg; }
  /// From bar to bar or point to point in these classes of the page's style sheet.
  void bar(double from, double to, double top, const std::string& title);
  void line(const std::string& path, const char* style);

  /// The drawing; `description` is for those who do not see it.
  std::string svg(const std::string& description) const;

  static constexpr double width = 360, height = 216;
  static constexpr double left = 48, right = 346, top = 8, bottom = 176;

 private:
  Interval x_, y_;
  std::string x_label_, y_label_, body_;
};

/// "M x y" or "L x y" with a tenth of a unit's precision, for paths.
std::string path_step(char command, double x, double y);

}  // namespace carlo::grader
