#include "render/outputs.h"

#include "image/png.h"
#include "render/pixel_maps.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <cstdint>
#include <system_error>
#include <utility>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// The number of samples of each pixel.
std::vector<std::uint32_t> sample_counts(const Film& film) {
  std::vector<std::uint32_t> counts;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x)
      counts.push_back(static_cast<std::uint32_t>(film.samples(x, y)));
  }
  return counts;
}

}  // namespace

fs::path output_stem(const std::string& output, const std::string& scene) {
  if (output.empty()) {
    std::error_code ec;
    fs::create_directories("out", ec);
    if (ec) throw Error("cannot write into out: {}", ec.message());
    return fs::path("out") / fs::path(scene).stem();
  }
  const fs::path given(output);
  if (!given.has_filename() || fs::is_directory(given)) return given / fs::path(scene).stem();
  const bool suffixed = given.extension() == ".exr" || given.extension() == ".png";
  return suffixed ? fs::path(given).replace_extension() : given;
}

fs::path with_suffix(const fs::path& stem, const std::string& suffix) {
  return {stem.string() + suffix};
}

Outputs::Outputs(fs::path stem, RenderSettings settings, bool sums)
    : stem_(std::move(stem)), settings_(std::move(settings)), sums_(sums) {
  for (const char* suffix : {".exr", ".png", ".error.png", ".samples.png", ".json"}) {
    const AtomicFile writable(with_suffix(stem_, suffix));
  }
}

void Outputs::checkpoint(const RenderResult& result, const RenderReport& report) const {
  write_exr(with_suffix(stem_, ".exr"), exr(result, report, true));
  write_file(with_suffix(stem_, ".json"), to_json(report));
}

void Outputs::write(const RenderResult& result, const RenderReport& report) const {
  const ExrFile file = exr(result, report, sums_);
  write_exr(with_suffix(stem_, ".exr"), file);
  write_png(with_suffix(stem_, ".png"), file.image);
  write_png(with_suffix(stem_, ".error.png"), error_map(result.film));
  if (result.adaptive) {
    write_png(with_suffix(stem_, ".samples.png"), samples_map(result.film));
  }
  write_file(with_suffix(stem_, ".json"), to_json(report));
}

std::string Outputs::names(const RenderResult& result) const {
  return fmt::format("{}.png, .exr (with standard errors), .error.png (noise map){}, .json",
                     stem_.string(),
                     result.adaptive ? ", .samples.png (where the samples went)" : "");
}

ExrFile Outputs::exr(const RenderResult& result, const RenderReport& report, bool sums) const {
  ExrFile file{result.film.mean(),
               result.film.standard_error(),
               {{"scene", report.scene},
                {"seed", std::to_string(report.seed)},
                {"spp", fmt::format("{}", report.spp)},
                {"kernel", report.kernel}}};
  if (result.adaptive) file.counts["samples"] = sample_counts(result.film);
  if (sums && result.adaptive) {
    add_sums(file, settings_, *result.adaptive_state, result.counts);
  } else if (sums) {
    add_sums(file, settings_, result.film, result.counts, result.lamp_ties);
  }
  return file;
}

}  // namespace carlo
