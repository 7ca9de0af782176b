#include "course/render/report.h"

#include "course/json/json_fields.h"
#include "image/image.h"
#include "numeric/compensated.h"
#include "render/light_coverage.h"
#include "scene/needs.h"
#include "scene/sampler_kind.h"
#include "support/error.h"
#include "support/progress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace carlo {
namespace {

/// The root mean square of the standard errors over pixels and channels, relative to the mean
/// radiance.
double relative_error(const Film& film, const MeanRadiance& mean) {
  CompensatedSum sum;
  double count = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      if (film.blocks(x, y) == 0) continue;
      for (std::size_t c = 0; c < 3; ++c)
        sum.add(film.variance(x, y, c));
      count += 3;
    }
  }
  const double average = (mean.value[0] + mean.value[1] + mean.value[2]) / 3;
  return average > 0 ? std::sqrt(sum.value() / count) / average : 0;
}

double finished(const Film& film) {
  double count = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x)
      count += film.blocks(x, y) > 0 ? 1 : 0;
  }
  return count / (1.0 * film.width() * film.height());
}

std::string error_text(const RenderReport& r) {
  if (!std::isfinite(r.relative_error)) {
    return r.spp < 2 ? "not known: it takes two samples a pixel at least"
                     : "not known: some pixels have fewer than two blocks of samples";
  }
  return fmt::format("R {:.2g}, G {:.2g}, B {:.2g}; of a pixel: {:.2g} % of the mean (rms)",
                     r.mean.standard_error[0], r.mean.standard_error[1], r.mean.standard_error[2],
                     100 * r.relative_error);
}

std::string millions(double per_second) {
  return fmt::format("{:.2f} M", per_second / 1e6);
}

std::string time_text(const RenderReport& r) {
  const auto rate = [&r](std::uint64_t count) {
    return millions(static_cast<double>(count) / r.seconds);
  };
  std::string text =
      fmt::format("{} {}: {} paths/s", format_seconds(r.seconds), r.where, rate(r.counts.paths));
  if (r.counts.light_paths > 0) {
    text += fmt::format(", {} from lights", rate(r.counts.light_paths));
  }
  if (r.counts.rays > 0) text += fmt::format(", {} rays/s", rate(r.counts.rays));
  return text;
}

std::vector<double> list(const std::array<double, 3>& x) {
  return {x.begin(), x.end()};
}

/// The mean of 1 / max(blocks of a, blocks of b) over all pairs (a, b) of pixels with blocks: the
/// part of one pass's covariance that remains, at most, between the means of two pixels.
double shared_passes(const Film& film) {
  std::vector<std::uint32_t> blocks;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x)
      if (film.blocks(x, y) > 0) blocks.push_back(film.blocks(x, y));
  }
  std::sort(blocks.begin(), blocks.end());
  const auto count = static_cast<double>(blocks.size());
  CompensatedSum sum;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    sum.add((2 * static_cast<double>(i) + 1) / blocks[i]);
  return sum.value() / (count * count);
}

/// What sums over the blocks of all tiles stand for: each block of a tile contributes the
/// covariances of its pass, summed over all pairs of pixels; existing passes stand in for missing
/// blocks. The factor makes them those of the image's mean.
double covariance_factor(const Film& film) {
  const double pixels = 1.0 * film.width() * film.height();
  double blocks = 0;
  for (int y = 0; y < film.height(); y += driver_tile_size) {
    for (int x = 0; x < film.width(); x += driver_tile_size)
      blocks += film.blocks(x, y);
  }
  const double of_a_pass = film.block() * pixels;
  return blocks > 0 ? shared_passes(film) / (blocks * of_a_pass * of_a_pass) : 0;
}

/// The variance that paths which reach several pixels add to the image's mean; an upper bound with
/// Sobol' points. For light paths, assumes that the channels are correlated as the luminance is.
std::array<double, 3> shared_variance(const RenderResult& result, const MeanRadiance& mean) {
  const double all = luminance(mean.value), factor = covariance_factor(result.film);
  const double splats = result.light_path_covariance ? *result.light_path_covariance
                                                     : result.covariance.splats.value() * factor;
  std::array<double, 3> variance{};
  for (std::size_t c = 0; c < 3; ++c) {
    variance[c] = std::fmax(result.covariance.shared[c].value() * factor, 0);
    if (all > 0 && result.counts.splat_covariance != 0)
      variance[c] += std::fmax(splats, 0) / (all * all) * mean.value[c] * mean.value[c];
  }
  return variance;
}

}  // namespace

MeanRadiance mean_of(const RenderResult& result) {
  MeanRadiance mean = mean_radiance(result.film);
  const std::array<double, 3> more = shared_variance(result, mean);
  for (std::size_t c = 0; c < 3; ++c)
    mean.standard_error[c] = std::hypot(mean.standard_error[c], std::sqrt(more[c]));
  return mean;
}

RenderReport make_report(const Scene& scene, const std::string& file, const Integrator& integrator,
                         std::uint64_t seed, const RenderResult& result) {
  RenderReport report = make_report(result);
  report.scene = file;
  report.kernel = integrator.name();
  report.seed = seed;
  report.expect_light_samples(integrator.least_light_probability());
  report.needs = describe(needs(scene));
  report.sampler = name_of(scene.sampler);
  report.max_depth = scene.max_depth;
  return report;
}

RenderReport make_report(const RenderResult& result) {
  RenderReport report;
  report.width = result.film.width();
  report.height = result.film.height();
  report.threads = result.threads;
  report.where = fmt::format("on {} thread{}", result.threads, result.threads == 1 ? "" : "s");
  report.samples = result.film.samples();
  report.spp = static_cast<double>(report.samples) / (1.0 * report.width * report.height);
  report.seconds = result.seconds;
  report.interrupted = result.interrupted;
  report.counts = result.counts;
  report.mean = mean_of(result);
  report.relative_error = relative_error(result.film, report.mean);
  report.finished = finished(result.film);
  return report;
}

void RenderReport::expect_light_samples(double least_light_probability) {
  light_samples = expected_light_samples(least_light_probability, spp, width, height);
}

/// Before anything is rendered: an image of another size, or one that makes all errors NaN.
static void check_reference(const Image& image, const std::string& path, int width, int height) {
  if (image.width != width || image.height != height) {
    throw Error("the reference {} has {} x {} pixels, expected those of the film, {} x {}", path,
                image.width, image.height, width, height);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y)[c];
        if (std::isfinite(value)) continue;
        throw Error("the reference {} has {} {} in column {}, row {}, expected finite radiances",
                    path, "RGB"[c], value, x + 1, y + 1);
      }
    }
  }
}

std::optional<ExrFile> read_reference(const std::string& path, int width, int height) {
  if (path.empty()) return std::nullopt;
  ExrFile reference = read_exr(path);
  check_reference(reference.image, path, width, height);
  return reference;
}

ReferenceReport compare_with_reference(const RenderResult& result, const std::string& path,
                                       const ExrFile& reference) {
  ReferenceReport report;
  report.path = path;
  const Image image = result.film.mean();
  report.error = compare(image, reference.image);
  const Image exact(image.width, image.height);
  report.bias_z = bias_z(image, result.film.standard_error(), reference.image,
                         reference.standard_error ? *reference.standard_error : exact,
                         shared_variance(result, mean_radiance(result.film)));
  report.efficiency = 1 / (report.error.mse * result.seconds);
  report.notes = reference.notes;
  if (!reference.standard_error) {
    report.notes.emplace_back(
        "the reference has no channels se.R, se.G, se.B: it counts as exact, and bias z is too large "
        "by what noise it has");
  }
  return report;
}

ReportLines to_lines(const RenderReport& r) {
  ReportLines lines;
  const auto line = [&lines](const char* name, std::string value) {
    lines.emplace_back(name, std::move(value));
  };
  line("scene", r.scene);
  line("needs", r.needs);
  line("kernel", fmt::format("{}, {} sampler, seed {}", r.kernel, r.sampler, r.seed));
  line("image", fmt::format("{} x {}, {:.6g} sample{} a pixel", r.width, r.height, r.spp,
                            r.spp == 1 ? "" : "s"));
  if (r.interrupted) {
    line("INTERRUPTED", fmt::format("{:.0f} % of the pixels have samples, the rest are black; "
                                    "means are over the sampled pixels",
                                    100 * r.finished));
  }
  lines.insert(lines.end(), r.behind_image.begin(), r.behind_image.end());
  line("time", time_text(r));
  line("mean radiance", fmt::format("R {:.6g}, G {:.6g}, B {:.6g}", r.mean.value[0],
                                    r.mean.value[1], r.mean.value[2]));
  line("standard error", error_text(r));
  lines.insert(lines.end(), r.behind_error.begin(), r.behind_error.end());
  if (r.reference) {
    line("reference", r.reference->path);
    line("error",
         fmt::format("MSE {:.4g}, relMSE {:.4g}, relMSE x seconds {:.4g}", r.reference->error.mse,
                     r.reference->error.rel_mse, r.reference->error.rel_mse * r.seconds));
    line("bias z", fmt::format("R {:.2f}, G {:.2f}, B {:.2f}", r.reference->bias_z[0],
                               r.reference->bias_z[1], r.reference->bias_z[2]));
    line("efficiency", fmt::format("{:.4g} = 1 / (MSE x s)", r.reference->efficiency));
    for (const std::string& note : r.reference->notes)
      line("note", note);
  }
  if (r.light_samples && *r.light_samples < enough_light_samples) {
    line("lights",
         fmt::format("some are sampled only about {:.2g} times in a pixel's neighbourhood; where "
                     "stronger lights are occluded, their light may be missing from the image and "
                     "from its error estimate",
                     *r.light_samples));
  }
  if (r.counts.cut > 0) {
    line("WARNING", fmt::format("{} cut at the maximum length: the image is too dark",
                                r.counts.cut == 1 ? "1 path was"
                                                  : fmt::format("{} paths were", r.counts.cut)));
  }
  if (r.counts.bad > 0) {
    line("WARNING", fmt::format("{} samples were NaN, infinite or negative; they count as black",
                                r.counts.bad));
  }
  return lines;
}

std::string to_text(const ReportLines& lines) {
  std::string text;
  for (const auto& [name, value] : lines)
    text += fmt::format("  {:<16} {}\n", name, value);
  return text;
}

// Written for other programs: nothing here reads a report.

static void fields(JsonFields& json, const ReferenceReport& reference) {
  json.also("path", reference.path);
  json.also("mse", reference.error.mse);
  json.also("rel_mse", reference.error.rel_mse);
  json.also("bias_z", list(reference.bias_z));
  json.also("efficiency", reference.efficiency);
}

static void fields(JsonFields& json, RenderReport& r) {
  json.also("scene", r.scene);
  json.also("needs", r.needs);
  json.also("kernel", r.kernel);
  json.also("sampler", r.sampler);
  json.as_text("seed", r.seed);
  json.also("width", r.width);
  json.also("height", r.height);
  json.also("max_depth", r.max_depth);
  json.also("threads", r.threads);
  json.also("spp", r.spp);
  json.also("samples", r.samples);
  json.also("interrupted", r.interrupted);
  json.also("seconds", r.seconds);
  json.also("paths", r.counts.paths);
  if (r.counts.rays > 0) {
    json.also("rays", r.counts.rays);
  } else {
    json.null("rays");
  }
  if (r.counts.light_paths > 0) json.also("light_paths", r.counts.light_paths);
  json.also("bad_samples", r.counts.bad);
  json.also("cut_paths", r.counts.cut);
  json.also("finished_pixels", r.finished);
  json.also("mean", list(r.mean.value));
  json.also("standard_error", list(r.mean.standard_error));
  json.also("relative_pixel_error", r.relative_error);
  if (r.light_samples) json.also("least_light_samples", *r.light_samples);
  json("reference", r.reference);
  for (const auto& more : r.fields)
    more(json);
}

std::string to_json(const RenderReport& r) {
  return json_text(r, 2) + "\n";
}

}  // namespace carlo
