#pragma once

#include "image/exr.h"
#include "render/driver.h"
#include "render/report.h"
#include "render/resume.h"

#include <filesystem>
#include <string>

namespace carlo {

/// Where a render's files go: their common stem. `output` is a stem, a file's name or a folder; by
/// default it is the scene's name in out/. A default folder is made, a given one must exist.
std::filesystem::path output_stem(const std::string& output, const std::string& scene);

std::filesystem::path with_suffix(const std::filesystem::path& stem, const std::string& suffix);

/// Writes the files of a render, and of a render under way.
class Outputs {
 public:
  /// Throws Error if any of them cannot be written: now, not after an hour. With `sums` the EXR can
  /// be gone on with.
  Outputs(std::filesystem::path stem, RenderSettings settings, bool sums);

  const std::filesystem::path& stem() const { return stem_; }

  /// All that goes on needs: the image and how long it took.
  void checkpoint(const RenderResult& result, const RenderReport& report) const;

  void write(const RenderResult& result, const RenderReport& report) const;

  /// What write() writes, for people.
  std::string names(const RenderResult& result) const;

 private:
  ExrFile exr(const RenderResult& result, const RenderReport& report, bool sums) const;

  std::filesystem::path stem_;
  RenderSettings settings_;
  bool sums_;
};

}  // namespace carlo
