#include "renderer/production/resumable_outputs.h"

#include "course/render/outputs.h"
#include "course/render/pixel_maps.h"
#include "image/png.h"
#include "support/atomic_file.h"

#include <utility>
#include <vector>

namespace carlo {

namespace fs = std::filesystem;

static constexpr const char* samples_suffix = ".samples.png";

/// The number of samples of each pixel.
static std::vector<float> sample_counts(const Film& film) {
  std::vector<float> counts;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x)
      counts.push_back(static_cast<float>(film.samples(x, y)));
  }
  return counts;
}

ResumableOutputs::ResumableOutputs(fs::path stem, RenderSettings settings, bool sums)
    : stem_(std::move(stem)), settings_(std::move(settings)), sums_(sums) {
  require_writable(stem_);
  const AtomicFile writable(with_suffix(stem_, samples_suffix));
}

void ResumableOutputs::checkpoint(const RenderResult& result, const RenderReport& report) const {
  write_checkpoint(exr(result, report, true), report);
}

void ResumableOutputs::checkpoint(const AdaptiveResult& result, const RenderReport& report) const {
  write_checkpoint(exr(result, report, true), report);
}

void ResumableOutputs::write_checkpoint(const ExrFile& exr, const RenderReport& report) const {
  write_exr(with_suffix(stem_, ".exr"), exr);
  write_file(with_suffix(stem_, ".json"), to_json(report));
}

void ResumableOutputs::write(const RenderResult& result, const RenderReport& report) const {
  write_outputs(stem_, exr(result, report, sums_), result.film, report);
}

void ResumableOutputs::write(const AdaptiveResult& result, const RenderReport& report) const {
  write_png(with_suffix(stem_, samples_suffix), samples_map(result.film));
  write_outputs(stem_, exr(result, report, sums_), result.film, report);
}

std::string ResumableOutputs::names(const RenderResult& /*result*/) const {
  return names_of_outputs(stem_);
}

std::string ResumableOutputs::names(const AdaptiveResult& /*result*/) const {
  return names_of_outputs(stem_, ", .samples.png (where the samples went)");
}

ExrFile ResumableOutputs::exr(const RenderResult& result, const RenderReport& report,
                              bool sums) const {
  ExrFile file = exr_of(result, report);
  if (sums) add_sums(file, settings_, result.film, result.counts, result.covariance);
  return file;
}

ExrFile ResumableOutputs::exr(const AdaptiveResult& result, const RenderReport& report,
                              bool sums) const {
  ExrFile file = exr_of(result, report);
  file.samples = sample_counts(result.film);
  if (sums) add_sums(file, settings_, *result.state, result.counts);
  return file;
}

}  // namespace carlo
