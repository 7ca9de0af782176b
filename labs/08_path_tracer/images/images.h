#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"
#include "image/image.h"
#include "path_tracer.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lab08 {

using carlo::Curve, carlo::Measurement, carlo::Notebook;

// Small images, the error of their pixels and their cost.

/// The value of pixel (x, y), counted from the top left. Called from several threads at once.
using Pixel = std::function<Rgb(int x, int y, Rng& rng)>;
/// An estimate of that value from this many samples.
using SampledPixel = std::function<Rgb(int x, int y, int samples, Rng& rng)>;

/// Renders all pixels, on all cores. The same seed gives the same image for any number of cores.
carlo::Image render(int width, int height, std::uint64_t seed, const Pixel& pixel);

/// The ray through the middle of a pixel: without jitter the light's error is the only one.
Ray middle_ray(const carlo::Camera& camera, int width, int height, int x, int y);

/// The mean of `samples` calls.
Rgb mean_of(int samples, const std::function<Rgb()>& estimate);

/// The mean over pixels and channels.
double mean_value(const carlo::Image& image);

/// A reference for images.
struct Reference {
  carlo::Image image;
  double variance = 0;  ///< the mean square error of its own pixels; 0 for closed forms
};

/// Combines two independent images of this many samples per pixel into one with a known error.
Reference converged(Notebook& notebook, int width, int height, int samples,
                    const SampledPixel& pixel);

/// Root mean square over pixels and channels, relative to the reference's mean, without the
/// reference's own error.
double relative_error(const carlo::Image& image, const Reference& reference);

/// The results of one method for an image.
struct Result {
  Curve curve;         ///< error: relative_error()
  carlo::Image shown;  ///< the image with at most `shown_samples`
  Measurement shown_run;

  double seconds_a_sample() const;
};

/// The largest number of samples per pixel in this run.
int most_samples(const Notebook& notebook);

/// The sides of a small image: `full` pixels, fewer in a quick run.
int image_size(const Notebook& notebook, int full);

/// Renders with 1, 4, 16 ... samples per pixel. Seconds are those of all processors together.
Result measure(Notebook& notebook, const std::string& name, const Reference& reference,
               int shown_samples, const SampledPixel& pixel);

/// A picture of the reference and one for each result with its error and seconds.
std::vector<std::string> pictures_of(const Reference& reference, const std::string& reference_note,
                                     const std::vector<Result>& results, double white);

/// The table of all results, and its rows for one scene.
carlo::Table results_table();
void add_rows(carlo::Table& table, const std::string& scene, const std::vector<Result>& results);

void add_charts(Notebook& notebook, const std::string& title, const std::vector<Result>& results);

}  // namespace lab08
