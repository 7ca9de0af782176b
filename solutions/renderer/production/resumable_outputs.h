#pragma once

#include "course/render/report.h"
#include "image/exr.h"
#include "renderer/production/adaptive.h"
#include "renderer/production/part.h"
#include "renderer/production/settings.h"

#include <filesystem>
#include <optional>
#include <string>

namespace carlo {

/// Writes the files of a finished or running render, with the sums in its EXR to continue from.
class ResumableOutputs {
 public:
  /// Throws Error if any of the files cannot be written. Without `sums` the EXR is smaller but
  /// cannot be continued from. `part` is set if the render is a part that is to be merged further.
  ResumableOutputs(std::filesystem::path stem, RenderSettings settings, bool sums,
                   std::optional<Part> part = {});

  const std::filesystem::path& stem() const { return stem_; }

  /// Writes only what is needed to continue: the image and the time spent.
  void checkpoint(const RenderResult& result, const RenderReport& report) const;
  void checkpoint(const AdaptiveResult& result, const RenderReport& report) const;

  void write(const RenderResult& result, const RenderReport& report) const;
  void write(const AdaptiveResult& result, const RenderReport& report) const;

  /// Lists the files that write() writes, for the reader.
  std::string names(const RenderResult&) const;
  std::string names(const AdaptiveResult&) const;

 private:
  ExrFile exr(const RenderResult& result, const RenderReport& report, bool sums) const;
  ExrFile exr(const AdaptiveResult& result, const RenderReport& report, bool sums) const;
  void write_checkpoint(const ExrFile& exr, const RenderReport& report) const;

  std::filesystem::path stem_;
  RenderSettings settings_;
  bool sums_;
  std::optional<Part> part_;
};

}  // namespace carlo
