// Checks of exercise 9.3, filter_pixel(): exact means over windows in the middle of images, at
// their edges, and larger than the image. Weights are those of the contract.

#include "09_bias/feature_theory.h"
#include "grader/judge/judge.h"

#include <fmt/format.h>

#include <string>
#include <vector>

using namespace carlo::grader;

namespace lab09_features {
namespace {

const Diagnosis not_divided{
    "not-divided-by-weights",
    "the sum of the weighted colours is divided by the sum of the weights."};
const Diagnosis divided_by_pixels{"divided-by-pixels",
                                  "divide by the sum of the weights, not by the number of pixels."};
const Diagnosis window_short{"window-short",
                             "the window reaches from x - radius to x + radius, both included, and "
                             "so in y."};
const Diagnosis window_long{"window-long",
                            "the window reaches to `radius` pixels away, not beyond."};
const Diagnosis edge_repeated{"edge-repeated",
                              "pixels at the image's edge are repeated for those outside; the "
                              "window has to be cut off."};
const Diagnosis edge_wrapped{"edge-wrapped",
                             "the window wraps around to the image's other side; it has to be "
                             "cut off."};
const Diagnosis middle_left_out{"middle-left-out", "the pixel itself belongs to its window."};
const Diagnosis not_weighted{"not-weighted",
                             "each pixel has to be weighted by its "
                             "feature_weight()."};
const Diagnosis x_and_y{"x-and-y-exchanged", "x counts columns, y rows."};
const Diagnosis weights_not_squared{"weights-not-squared",
                                    "the variance of w times a number is w^2 times its variance."};
const Diagnosis sum_not_squared{"sum-of-weights-not-squared",
                                "the mean is divided by the sum of the weights, so its variance by "
                                "that sum's square."};
const Diagnosis variance_not_divided{"variance-not-divided",
                                     "the sum of w^2 v is divided by the square of the sum of the "
                                     "weights."};
const Diagnosis own_variance{"variance-of-the-middle",
                             "the variance of the pixel itself is given, not that of the mean."};
const Diagnosis by_squares{
    "divided-by-sum-of-squares",
    "divide by the square of the sum of the weights, not by the sum of their squares."};
const Diagnosis root_given{"standard-error-for-variance",
                           "the variance of the mean is required, not its standard error."};

struct WindowCase {
  ImageKind kind;
  int x, y, radius;
  const char* name;
};

/// The results of mistakes for one channel's mean and variance.
struct WindowSlips {
  Suspects color, variance;

  void add(const WindowSums& sums, std::size_t c, const Diagnosis& diagnosis) {
    if (sums.weights == 0) return;
    color.push_back({sums.color[c] / sums.weights, diagnosis});
    variance.push_back({sums.variance[c] / (sums.weights * sums.weights), diagnosis});
  }
};

int pixels_in(const PixelImage& image, const WindowCase& w) {
  const auto count = [&](int at, int size) {
    return std::min(at + w.radius, size - 1) - std::max(at - w.radius, 0) + 1;
  };
  return count(w.x, image.width) * count(w.y, image.height);
}

WindowSlips window_slips(const PixelImage& image, const WindowCase& w, std::size_t c) {
  const WindowSums right = window_sums(image, w.x, w.y, w.radius, w.radius);
  const double pixels = pixels_in(image, w);
  PixelImage unweighted = image;
  for (Pixel& pixel : unweighted.pixels) {
    const Pixel& middle = image.at(w.x, w.y);
    pixel.albedo = middle.albedo, pixel.normal = middle.normal, pixel.depth = middle.depth;
  }
  unweighted.strength.color = 1e6;
  WindowSlips slips;
  slips.color = {{right.color[c], not_divided}, {right.color[c] / pixels, divided_by_pixels}};
  slips.variance = {{right.variance[c], variance_not_divided},
                    {right.variance[c] / right.weights, sum_not_squared},
                    {right.variance_once[c] / right.weights, weights_not_squared},
                    {right.variance_once[c] / (right.weights * right.weights), weights_not_squared},
                    {right.variance[c] / right.squares, by_squares},
                    {right.variance[c] / (pixels * pixels), divided_by_pixels},
                    {right.variance[c] / pixels, divided_by_pixels},
                    {real(image.at(w.x, w.y).variance[c]), own_variance},
                    {std::sqrt(right.variance[c]) / right.weights, root_given}};
  slips.add(window_sums(unweighted, w.x, w.y, w.radius, w.radius), c, not_weighted);
  slips.add(window_sums(image, w.x, w.y, w.radius, w.radius, Edge::repeated), c, edge_repeated);
  slips.add(window_sums(image, w.x, w.y, w.radius, w.radius, Edge::wrapped), c, edge_wrapped);
  slips.add(window_sums(image, w.x, w.y, w.radius, w.radius, Edge::cut, false), c, middle_left_out);
  slips.add(window_sums(image, w.x, w.y, w.radius + 1, w.radius + 1), c, window_long);
  if (w.radius > 0) {
    slips.add(window_sums(image, w.x, w.y, w.radius - 1, w.radius - 1), c, window_short);
    slips.add(window_sums(image, w.x, w.y, w.radius, w.radius - 1), c, window_short);
    slips.add(window_sums(image, w.x, w.y, w.radius - 1, w.radius), c, window_short);
  }
  if (w.x != w.y && w.x < image.height && w.y < image.width)
    slips.add(window_sums(image, w.y, w.x, w.radius, w.radius), c, x_and_y);
  return slips;
}

void judge_window(const WindowCase& w) {
  const Answer rows = probe("Lab 9.3 pixel",
                            {.n = w.radius,
                             .numbers = {{"kind", static_cast<double>(w.kind)},
                                         {"x", static_cast<double>(w.x)},
                                         {"y", static_cast<double>(w.y)}}},
                            {.rows = 2, .columns = 3, .finite = false, .of = w.name});
  const PixelImage image = drawn_image(w.kind, rows.seed);
  const WindowSums right = window_sums(image, w.x, w.y, w.radius, w.radius);
  const char* channels[] = {"red", "green", "blue"};
  for (std::size_t c = 0; c < 3; ++c) {
    const WindowSlips slips = window_slips(image, w, c);
    judge(equals(fmt::format("{} of {}", channels[c], w.name), rows.at(0, c),
                 right.color[c] / right.weights, 1e-5, slips.color));
    judge(equals(fmt::format("the variance of {} of {}", channels[c], w.name), rows.at(1, c),
                 right.variance[c] / (right.weights * right.weights), 1e-6, slips.variance));
  }
}

const Unsaid unsaid_window{"kind", "x", "y"};

}  // namespace

TEST_CASE("Lab 9.3: means over windows", "[lab09][ex3]") {
  judge_window({flat, 4, 3, 2, "a window where nothing but noise differs"});
  judge_window({rough, 4, 3, 2, "a window where everything differs a little"});
  judge_window({edged, 4, 3, 2, "a window that an edge runs through"});
  judge_window({rough, 4, 3, 0, "a window of one pixel"});
}

TEST_CASE("Lab 9.3: windows at the image's edges", "[lab09][ex3]") {
  judge_window({rough, 0, 3, 2, "a window at the left edge"});
  judge_window({rough, 8, 6, 2, "a window in the last corner"});
  judge_window({rough, 6, 1, 3, "a window at the upper edge"});
  judge_window({rough, 2, 5, 20, "a window larger than the image"});
}

}  // namespace lab09_features
