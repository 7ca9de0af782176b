#pragma once

#include "image/exr.h"
#include "image/metrics.h"
#include "render/driver.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carlo {

class JsonFields;

/// A report for the reader: labels, and numbers with their units.
using ReportLines = std::vector<std::pair<std::string, std::string>>;

/// The comparison of a render with a reference image.
struct ReferenceReport {
  std::string path;
  ImageError error;
  std::array<double, 3> bias_z{};  ///< of the whole image's mean, per channel
  double efficiency = 0;           ///< 1 / (MSE * seconds)
  std::vector<std::string> notes;  ///< how the reference was changed from what its file holds
};

/// Everything reported about a render: never a time without its error, nor an error without its
/// time.
struct RenderReport {
  std::string scene, needs, kernel, sampler;
  int width = 0, height = 0, threads = 0, max_depth = 0;
  std::uint64_t seed = 0, samples = 0;
  double spp = 0;  ///< mean over the pixels
  double seconds = 0;
  std::string where;  ///< where the time was spent: "on 2 threads"
  bool interrupted = false;
  Counts counts;
  MeanRadiance mean;
  double relative_error = 0;  ///< rms standard error of a pixel over the mean radiance
  /// expected_light_samples() (light_coverage.h) where samples are fewest; nothing if unknown.
  std::optional<double> light_samples;
  double finished = 1;  ///< fraction of the pixels that have samples; the means are over these
  std::optional<ReferenceReport> reference;
  // Additions by the command.
  ReportLines behind_image, behind_error;
  std::vector<std::function<void(JsonFields&)>> fields;

  /// Sets light_samples, from Integrator::least_light_probability, for the same number of samples
  /// in all pixels.
  void expect_light_samples(double least_light_probability);
};

/// Returns the image's mean and its standard error, including the covariances of paths that reach
/// several pixels.
MeanRadiance mean_of(const RenderResult& result);

/// Makes a report with all that follows from the result.
RenderReport make_report(const RenderResult& result);
/// Adds the scene, its file, the integrator and the seed.
RenderReport make_report(const Scene& scene, const std::string& file, const Integrator& integrator,
                         std::uint64_t seed, const RenderResult& result);

/// Reads the image to compare with; nothing if `path` is empty. Throws Error.
std::optional<ExrFile> read_reference(const std::string& path, int width, int height);

/// Compares with a reference, using its standard error if the file has one.
ReferenceReport compare_with_reference(const RenderResult& result, const std::string& path,
                                       const ExrFile& reference);

ReportLines to_lines(const RenderReport& report);

std::string to_text(const ReportLines& lines);
std::string to_json(const RenderReport& report);

}  // namespace carlo
