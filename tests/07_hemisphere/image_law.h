#pragma once

#include "07_hemisphere/skies.h"
#include "07_hemisphere/subject.h"

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

// The law of Lab 7.8's light, and the results of typical mistakes.

namespace lab07_tests {

/// The position of a point of the image: its texel, and the place within, from 0 to 1.
struct TexelPlace {
  std::size_t index;
  double across, down;
  bool near_edge = false;  ///< within 2e-6 of the image's size of an edge between texels
};

inline TexelPlace texel_place(const SkyImage& image, ImagePoint p) {
  const auto width = static_cast<double>(image.width), height = static_cast<double>(image.height);
  const double x = std::clamp(p.x, 0.0, 1.0) * width, y = std::clamp(p.y, 0.0, 1.0) * height;
  const double i = std::min(std::floor(x), width - 1), j = std::min(std::floor(y), height - 1);
  const auto close = [](double value, double size) {
    return std::abs(value - std::round(value)) <= 2e-6 * size;
  };
  return {static_cast<std::size_t>(j) * image.width + static_cast<std::size_t>(i), x - i, y - j,
          close(x, width) || close(y, height)};
}

/// The same; at an edge the lit one of the texels there, since rounding may move a direction either
/// way.
inline TexelPlace lit_texel_near(const SkyImage& image, ImagePoint p) {
  TexelPlace found = texel_place(image, p);
  if (!found.near_edge) return found;
  for (const double dx : {0.0, -2e-6, 2e-6}) {
    for (const double dy : {0.0, -2e-6, 2e-6}) {
      const double x = p.x + dx;
      const TexelPlace there = texel_place(image, {x < 0 ? x + 1 : x > 1 ? x - 1 : x, p.y + dy});
      if (image.luminance[found.index] == 0) found.index = there.index;
    }
  }
  return found;
}

/// A texel's density per solid angle.
inline double density_of(const SkyImage& image, std::size_t index) {
  return image.luminance[index] / image.power;
}

/// True if a density is that of some lit texel.
inline bool fits_a_texel(const SkyImage& image, double density) {
  return std::any_of(image.luminance.begin(), image.luminance.end(), [&](double luminance) {
    return luminance > 0 && agree(density, luminance / image.power, 1e-5);
  });
}

/// The probability of each texel, proportional to luminance times solid angle.
inline std::vector<double> shares_by_power(const SkyImage& image) {
  std::vector<double> shares;
  for (std::size_t k = 0; k < image.luminance.size(); ++k)
    shares.push_back(density_of(image, k) * image.solid_angle(k / image.width));
  return shares;
}

/// The same, proportional to luminance times the sine at the upper edge of the texel's row.
inline std::vector<double> shares_by_edge(const SkyImage& image) {
  std::vector<double> shares;
  double sum = 0;
  for (std::size_t k = 0; k < image.luminance.size(); ++k) {
    const std::size_t row = k / image.width;
    const double sine = std::sin(pi * static_cast<double>(row) / static_cast<double>(image.height));
    shares.push_back(image.luminance[k] * sine);
    sum += shares.back();
  }
  for (double& share : shares)
    share /= sum;
  return shares;
}

/// The same, proportional to luminance alone.
inline std::vector<double> shares_by_luminance(const SkyImage& image) {
  double sum = 0;
  for (const double luminance : image.luminance)
    sum += luminance;
  std::vector<double> shares = image.luminance;
  for (double& share : shares)
    share /= sum;
  return shares;
}

inline const Diagnosis no_solid_angle{
    "solid-angle-forgotten",
    "texels are weighed by their luminance alone: those next to a pole are as large in the image as "
    "those at the horizon, but not in the sky."};
inline const Diagnosis sine_of_edge{
    "sine-at-the-rows-edge",
    "texels are weighted by the sine at their row's upper edge: at the pole that is 0, though the "
    "first row has a solid angle. The solid angle is the difference of the cosines at both edges."};
inline const Diagnosis per_area{
    "density-per-image-area",
    "this is the density per area of the image: divide it by the solid angle of that area."};
inline const Diagnosis no_sine{
    "jacobian-without-sine",
    "the density is divided by 2 pi^2, as if all rows were as long as the middle one."};
inline const Diagnosis sine_of_direction{
    "sine-of-the-direction",
    "the density is divided by the sine of the direction itself: that is the law of angles that "
    "are uniform within a row. Directions that are uniform in a texel have the same density "
    "everywhere in it: probability over solid angle."};
inline const Diagnosis sine_at_pole{
    "division-by-sine-zero",
    "at the poles something is divided by sin(theta), which is 0 there: a texel's solid angle never "
    "is."};
inline const Diagnosis whole_row{
    "solid-angle-of-the-row",
    "a texel's probability is divided by the solid angle of its whole row, which has `width` "
    "texels."};
inline const Diagnosis not_one{
    "density-not-normalised",
    "the densities have the right proportions, but are all off by one factor: they are "
    "probability over solid angle, and the solid angles of all texels add up to 4 pi."};
inline const Diagnosis upside_down{"upside-down", "the top of the image is +y, not -y."};
inline const Diagnosis mirrored{
    "mirrored", "the azimuth runs in the wrong direction: it goes from -z, where x = 0, via +x."};
inline const Diagnosis turned{
    "azimuth-from-elsewhere",
    "the image is rotated about y: the azimuth is 0 at -z and a quarter turn at +x."};
inline const Diagnosis other_up{"z-is-up", "the image's poles are +y and -y, not +z and -z."};
inline const Diagnosis half_sphere{
    "half-a-sphere", "the image covers the whole sphere: the angle runs from 0 to pi."};
inline const Diagnosis half_around{"half-a-turn",
                                   "the azimuth covers half a turn only: it runs from 0 to 2 pi."};

/// A wrong mapping: where a point of the image is seen; and the direction whose right place is
/// looked up for a direction.
struct OtherMapping {
  std::function<Double3(ImagePoint)> seen;
  std::function<Double3(Double3)> back;
  Diagnosis diagnosis;
};

inline std::vector<OtherMapping> other_mappings() {
  // Composed of a map of directions, forward and back.
  const auto moved = [](const std::function<Double3(Double3)>& there,
                        const std::function<Double3(Double3)>& back, const Diagnosis& diagnosis) {
    return OtherMapping{[there](ImagePoint p) { return there(seen_in(p)); }, back, diagnosis};
  };
  const auto same = [&](const std::function<Double3(Double3)>& both, const Diagnosis& diagnosis) {
    return moved(both, both, diagnosis);
  };
  const auto never = [](Double3) { return Double3(2); };
  return {
      same([](Double3 w) { return Double3(w.x, -w.y, w.z); }, upside_down),
      same([](Double3 w) { return Double3(-w.x, w.y, w.z); }, mirrored),
      same([](Double3 w) { return Double3(-w.x, w.y, -w.z); }, turned),
      same([](Double3 w) { return Double3(w.x, w.y, -w.z); }, turned),
      same([](Double3 w) { return Double3(w.z, w.y, w.x); }, turned),
      same([](Double3 w) { return Double3(-w.z, w.y, -w.x); }, turned),
      moved([](Double3 w) { return Double3(-w.z, w.y, w.x); },
            [](Double3 w) { return Double3(w.z, w.y, -w.x); }, turned),
      moved([](Double3 w) { return Double3(w.z, w.y, -w.x); },
            [](Double3 w) { return Double3(-w.z, w.y, w.x); }, turned),
      // spherical() of Lab 7.3.
      moved([](Double3 w) { return Double3(-w.z, w.x, w.y); },
            [](Double3 w) { return Double3(w.y, w.z, -w.x); }, other_up),
      same([](Double3 w) { return Double3(w.x, w.z, w.y); }, other_up),
      moved([](Double3 w) { return Double3(w.x, -w.z, w.y); },
            [](Double3 w) { return Double3(w.x, w.z, -w.y); }, other_up),
      {[](ImagePoint p) {
         return seen_in({p.x, p.y / 2});
       },
       never, half_sphere},
      {[](ImagePoint p) {
         return seen_in({p.x / 2, p.y});
       },
       never, half_around},
  };
}

/// Probabilities of texels due to a mistake.
struct OtherShares {
  std::vector<double> shares;
  Diagnosis diagnosis;
};

inline std::vector<OtherShares> other_shares(const SkyImage& image) {
  const std::vector<double> right = shares_by_power(image);
  std::vector<double> flipped(right.size()), turned_back(right.size());
  for (std::size_t k = 0; k < right.size(); ++k) {
    const std::size_t i = k % image.width, j = k / image.width;
    flipped[(image.height - 1 - j) * image.width + i] = right[k];
    turned_back[j * image.width + image.width - 1 - i] = right[k];
  }
  return {{shares_by_luminance(image), no_solid_angle},
          {shares_by_edge(image), sine_of_edge},
          {flipped, upside_down},
          {turned_back, mirrored}};
}

/// The density of a direction by a typical mistake.
struct OtherImagePdf {
  std::function<double(std::size_t texel, Double3 w)> pdf;
  Diagnosis diagnosis;
};

inline std::vector<OtherImagePdf> other_image_pdfs(const SkyImage& image) {
  const std::vector<double> power = shares_by_power(image), light = shares_by_luminance(image),
                            edge = shares_by_edge(image);
  const auto texels = static_cast<double>(image.luminance.size());
  const auto width = static_cast<double>(image.width);
  const auto sine = [](Double3 w) { return std::hypot(w.x, w.z); };
  const auto angle = [=](std::size_t k) { return image.solid_angle(k / image.width); };
  return {
      {[=](std::size_t k, Double3) { return light[k] / angle(k); }, no_solid_angle},
      {[=](std::size_t k, Double3) { return edge[k] / angle(k); }, sine_of_edge},
      {[=](std::size_t k, Double3 w) { return light[k] * texels / (2 * pi * pi * sine(w)); },
       sine_of_direction},
      {[=](std::size_t k, Double3 w) { return power[k] * texels / (2 * pi * pi * sine(w)); },
       sine_of_direction},
      {[=](std::size_t k, Double3) { return power[k] * texels; }, per_area},
      {[=](std::size_t k, Double3) { return light[k] * texels; }, per_area},
      {[=](std::size_t k, Double3) { return power[k] * texels / (2 * pi * pi); }, no_sine},
      {[=](std::size_t k, Double3) { return light[k] * texels / (2 * pi * pi); }, no_sine},
      {[=](std::size_t k, Double3) { return power[k] / (angle(k) * width); }, whole_row},
  };
}

/// True if these are the densities of a law that divides by the sine of each direction.
inline bool divides_by_sine(const SkyImage& image, const std::vector<Double3>& directions,
                            const std::vector<double>& densities) {
  for (const OtherImagePdf& other : other_image_pdfs(image)) {
    if (other.diagnosis.id != sine_of_direction.id) continue;
    bool fits = true;
    for (std::size_t i = 0; fits && i < directions.size(); ++i) {
      const TexelPlace t = texel_place(image, stands_at(directions[i]));
      fits = t.near_edge || agree(densities[i], other.pdf(t.index, directions[i]), 1e-3);
    }
    if (fits) return true;
  }
  return false;
}

/// Compares the densities at `places` with theory; reports a mistake that all of them agree with.
inline Verdict image_density_is(const std::string& what, const SkyImage& image,
                                const std::vector<Vec3>& places,
                                const std::vector<double>& measured) {
  std::vector<std::size_t> texels;
  std::vector<double> expected;
  bool one_factor = true;
  double factor = 0;
  std::size_t wrong = places.size();
  for (std::size_t i = 0; i < places.size(); ++i) {
    texels.push_back(texel_place(image, stands_at(Double3(places[i]))).index);
    expected.push_back(density_of(image, texels[i]));
    if (!agree(measured[i], expected[i], 1e-5)) wrong = std::min(wrong, i);
    if (factor == 0 && expected[i] > 0) factor = measured[i] / expected[i];
    one_factor = one_factor && agree(measured[i], factor * expected[i], 1e-4);
  }
  if (wrong == places.size()) {
    return carlo::grader::holds(what, true, fmt::format("right at all {} places", places.size()),
                                "right everywhere");
  }
  const Vec3 w = places[wrong];
  Verdict verdict =
      carlo::grader::equals(fmt::format("{} at w = ({:.6g}, {:.6g}, {:.6g})", what, w.x, w.y, w.z),
                            measured[wrong], expected[wrong], 1e-5 * expected[wrong]);
  for (const OtherImagePdf& other : other_image_pdfs(image)) {
    bool fits = true;
    for (std::size_t i = 0; fits && i < places.size(); ++i)
      fits = agree(measured[i], other.pdf(texels[i], Double3(places[i])), 1e-4);
    if (fits) verdict.diagnoses.push_back(other.diagnosis);
  }
  if (verdict.diagnoses.empty() && one_factor && factor > 0) verdict.diagnoses = {not_one};
  return verdict;
}

/// Chi-square of the texels' counts of n directions, given their shares of the power; infinite if
/// more than a few directions fell where none can.
inline double chi_square(const std::vector<double>& counts, const std::vector<double>& shares,
                         double n) {
  double statistic = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (shares[i] > 0) statistic += std::pow(counts[i] - n * shares[i], 2) / (n * shares[i]);
    // Rounding at an edge moves one in a million.
    else if (counts[i] > 5)
      statistic = HUGE_VAL;
  }
  return statistic;
}

/// True if all values are about the same, counting 0 and 1 as one place.
inline bool all_alike(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low < 1e-3 || (*low < 1e-3 && *high > 1 - 1e-3 &&
                                 std::all_of(values.begin(), values.end(),
                                             [](double v) { return v < 1e-3 || v > 1 - 1e-3; }));
}

/// True if fewer than one in twenty values differs from the others, to seven digits.
inline bool few_values(const std::vector<double>& values) {
  std::set<float> seen;
  for (const double value : values)
    seen.insert(static_cast<float>(value));
  return 20 * seen.size() < values.size();
}

}  // namespace lab07_tests
