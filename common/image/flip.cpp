#include "image/flip.h"

#include "support/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

namespace carlo {
namespace {

using Colour = std::array<double, 3>;

/// One number per pixel.
struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;

  Plane(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  double& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  double at(int x, int y) const { return const_cast<Plane*>(this)->at(x, y); }
};

// Colour spaces -----------------------------------------------------------------------------------

/// Linear sRGB to CIE XYZ (IEC 61966-2-1), and the white of both.
constexpr std::array<Colour, 3> to_xyz = {{{0.4124564, 0.3575761, 0.1804375},
                                           {0.2126729, 0.7151522, 0.0721750},
                                           {0.0193339, 0.1191920, 0.9503041}}};
constexpr std::array<Colour, 3> to_rgb = {{{3.2404542, -1.5371385, -0.4985314},
                                           {-0.9692660, 1.8760108, 0.0415560},
                                           {0.0556434, -0.2040259, 1.0572252}}};

Colour times(const std::array<Colour, 3>& m, const Colour& v) {
  Colour result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

const Colour white = times(to_xyz, {1, 1, 1});

Colour relative_xyz(const Colour& rgb) {
  const Colour xyz = times(to_xyz, rgb);
  return {xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]};
}

/// The opponent space in which the eye's blur is linear: lightness, red-green, blue-yellow.
Colour ycxcz(const Colour& rgb) {
  const auto [x, y, z] = relative_xyz(rgb);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Colour rgb_from_ycxcz(const Colour& c) {
  const double y = (c[0] + 16) / 116;
  return times(to_rgb, {white[0] * (y + c[1] / 500), white[1] * y, white[2] * (y - c[2] / 200)});
}

/// CIELAB, with colours that fade with the lightness (Hunt).
Colour hunt_lab(const Colour& rgb) {
  const auto f = [](double t) {
    constexpr double edge = 6.0 / 29;
    return t > edge * edge * edge ? std::cbrt(t) : t / (3 * edge * edge) + 4.0 / 29;
  };
  const auto [x, y, z] = relative_xyz(rgb);
  const double lightness = 116 * f(y) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(x) - f(y)),
          0.01 * lightness * 200 * (f(y) - f(z))};
}

/// A distance suited to large colour differences (Abasi et al. 2020).
double hyab(const Colour& a, const Colour& b) {
  return std::fabs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// Filters -----------------------------------------------------------------------------------------

/// Weights at the pixels -radius ... radius.
using Kernel = std::vector<double>;

Kernel kernel(int radius, const std::function<double(double)>& weight) {
  Kernel result;
  for (int i = -radius; i <= radius; ++i)
    result.push_back(weight(i));
  return result;
}

/// Filters the rows, then the columns; outside the image its edge is repeated.
Plane filtered(const Plane& plane, const Kernel& along_x, const Kernel& along_y) {
  Plane rows(plane.width, plane.height), result(plane.width, plane.height);
  const int rx = static_cast<int>(along_x.size() / 2), ry = static_cast<int>(along_y.size() / 2);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      for (int i = -rx; i <= rx; ++i) {
        rows.at(x, y) += along_x[static_cast<std::size_t>(i + rx)] *
                         plane.at(std::clamp(x + i, 0, plane.width - 1), y);
      }
    }
  }
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      for (int i = -ry; i <= ry; ++i) {
        result.at(x, y) += along_y[static_cast<std::size_t>(i + ry)] *
                           rows.at(x, std::clamp(y + i, 0, plane.height - 1));
      }
    }
  }
  return result;
}

/// A term a sqrt(pi / b) exp(-pi^2 x^2 / b) of a contrast sensitivity, x in degrees.
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity lightness_sensitivity[] = {{1, 0.0047}};
constexpr Sensitivity red_green_sensitivity[] = {{1, 0.0053}};
constexpr Sensitivity blue_yellow_sensitivity[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double widest = 0.04;

/// One channel as the eye sees it from its distance: blurred by the inverse transform of the
/// contrast sensitivity, a sum of Gaussians whose weights in the plane sum to 1.
template <std::size_t n>
Plane seen(const Plane& channel, const Sensitivity (&terms)[n], double pixels_per_degree) {
  constexpr double pi2 = std::numbers::pi * std::numbers::pi;
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi2)) * pixels_per_degree));
  Plane sum(channel.width, channel.height);
  double total = 0;
  for (const Sensitivity& term : terms) {
    const Kernel gauss = kernel(radius, [&](double i) {
      const double x = i / pixels_per_degree;
      return std::exp(-pi2 * x * x / term.b);
    });
    const double mass = std::accumulate(gauss.begin(), gauss.end(), 0.0);
    const double weight = term.a * std::sqrt(std::numbers::pi / term.b);
    const Plane blurred = filtered(channel, gauss, gauss);
    for (std::size_t i = 0; i < sum.values.size(); ++i)
      sum.values[i] += weight * blurred.values[i];
    total += weight * mass * mass;
  }
  for (double& value : sum.values)
    value /= total;
  return sum;
}

// The two differences -----------------------------------------------------------------------------

/// An image's channels as a screen shows them, in the opponent space.
std::array<Plane, 3> opponent_channels(const Image& image) {
  const Plane empty(image.width, image.height);
  std::array<Plane, 3> planes{empty, empty, empty};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    Colour rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = image.pixels[i][static_cast<int>(c)];
      rgb[c] = value > 0 ? std::min(value, 1.0) : 0;
    }
    const Colour colour = ycxcz(rgb);
    for (std::size_t c = 0; c < 3; ++c)
      planes[c].values[i] = colour[c];
  }
  return planes;
}

/// The colours that the eye sees, as CIELAB.
std::vector<Colour> seen_colours(const std::array<Plane, 3>& channels, double pixels_per_degree) {
  const Plane y = seen(channels[0], lightness_sensitivity, pixels_per_degree);
  const Plane cx = seen(channels[1], red_green_sensitivity, pixels_per_degree);
  const Plane cz = seen(channels[2], blue_yellow_sensitivity, pixels_per_degree);
  std::vector<Colour> colours;
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    Colour rgb = rgb_from_ycxcz({y.values[i], cx.values[i], cz.values[i]});
    for (double& c : rgb)
      c = std::clamp(c, 0.0, 1.0);
    colours.push_back(hunt_lab(rgb));
  }
  return colours;
}

/// The colour difference in [0, 1]: large ones are compressed into the last twentieth.
double colour_difference(const Colour& a, const Colour& b) {
  constexpr double power = 0.7, knee = 0.4, knee_value = 0.95;
  static const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), power);
  const double difference = std::pow(hyab(a, b), power);
  if (difference < knee * most) return difference * knee_value / (knee * most);
  return knee_value + (difference - knee * most) / ((1 - knee) * most) * (1 - knee_value);
}

/// The strength of edges and points at each pixel.
struct Features {
  std::vector<double> edges, points;
};

/// Scales the weights so that the positive ones sum to 1 and the negative ones to -1.
Kernel balanced(Kernel weights) {
  double positive = 0, negative = 0;
  for (const double w : weights)
    (w > 0 ? positive : negative) += std::fabs(w);
  for (double& w : weights)
    w /= w > 0 ? positive : negative;
  return weights;
}

Features features(const Plane& lightness, double pixels_per_degree) {
  constexpr double feature_width = 0.082;  // degrees
  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto gauss = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  Kernel across = kernel(radius, gauss);
  const double mass = std::accumulate(across.begin(), across.end(), 0.0);
  for (double& w : across)
    w /= mass;
  const Kernel first = balanced(kernel(radius, [&](double x) { return -x * gauss(x); }));
  const Kernel second =
      balanced(kernel(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * gauss(x); }));
  Plane normalised = lightness;
  for (double& value : normalised.values)
    value = (value + 16) / 116;
  const auto strength = [&](const Kernel& derivative) {
    const Plane x = filtered(normalised, derivative, across);
    const Plane y = filtered(normalised, across, derivative);
    std::vector<double> lengths;
    for (std::size_t i = 0; i < x.values.size(); ++i)
      lengths.push_back(std::hypot(x.values[i], y.values[i]));
    return lengths;
  };
  return {strength(first), strength(second)};
}

}  // namespace

std::vector<float> flip_map(const Image& image, const Image& reference, double pixels_per_degree) {
  if (image.width != reference.width || image.height != reference.height) {
    throw Error("the images differ in size: {} x {} against {} x {}", image.width, image.height,
                reference.width, reference.height);
  }
  const auto a = opponent_channels(image), b = opponent_channels(reference);
  const auto a_colours = seen_colours(a, pixels_per_degree);
  const auto b_colours = seen_colours(b, pixels_per_degree);
  const Features a_features = features(a[0], pixels_per_degree);
  const Features b_features = features(b[0], pixels_per_degree);
  std::vector<float> map;
  for (std::size_t i = 0; i < a_colours.size(); ++i) {
    const double feature = std::max(std::fabs(a_features.edges[i] - b_features.edges[i]),
                                    std::fabs(a_features.points[i] - b_features.points[i]));
    // A difference in features gives the colour difference more weight.
    const double exponent = 1 - std::clamp(std::sqrt(feature / std::numbers::sqrt2), 0.0, 1.0);
    map.push_back(
        static_cast<float>(std::pow(colour_difference(a_colours[i], b_colours[i]), exponent)));
  }
  return map;
}

double mean_flip(const std::vector<float>& map) {
  if (map.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

}  // namespace carlo
