#include "course/render/outputs.h"

#include "course/render/pixel_maps.h"
#include "image/png.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <system_error>

namespace carlo {

namespace fs = std::filesystem;

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

void require_writable(const fs::path& stem) {
  for (const char* suffix : {".exr", ".png", ".error.png", ".json"})
    const AtomicFile writable(with_suffix(stem, suffix));
}

ExrFile exr_of(const RenderResult& result, const RenderReport& report) {
  return {result.film.mean(),
          result.film.standard_error(),
          {{"scene", report.scene},
           {"seed", std::to_string(report.seed)},
           {"spp", fmt::format("{}", report.spp)},
           {"kernel", report.kernel}}};
}

void write_outputs(const fs::path& stem, const ExrFile& exr, const Film& film,
                   const RenderReport& report) {
  write_exr(with_suffix(stem, ".exr"), exr);
  write_png(with_suffix(stem, ".png"), exr.image);
  write_png(with_suffix(stem, ".error.png"), error_map(film));
  write_file(with_suffix(stem, ".json"), to_json(report));
}

std::string names_of_outputs(const fs::path& stem, const std::string& more) {
  return fmt::format("{}.png, .exr (with standard errors), .error.png (noise map){}, .json",
                     stem.string(), more);
}

}  // namespace carlo
