#pragma once

#include "course/render/report.h"
#include "image/exr.h"
#include "renderer/production/adaptive.h"
#include "renderer/production/resume.h"

#include <filesystem>
#include <string>

namespace carlo {

/// Writes the files of a render, and its checkpoints, whose EXR holds the sums to continue from.
class ResumableOutputs {
 public:
  /// Throws Error if one of the files cannot be written. Without `sums` the EXR is smaller, and the
  /// render cannot be continued.
  ResumableOutputs(std::filesystem::path stem, RenderSettings settings, bool sums);

  const std::filesystem::path& stem() const { return stem_; }

  /// Writes what continuing needs: the image, and how long it took.
  void checkpoint(const RenderResult& result, const RenderReport& report) const;
  void checkpoint(const AdaptiveResult& result, const RenderReport& report) const;

  void write(const RenderResult& result, const RenderReport& report) const;
  void write(const AdaptiveResult& result, const RenderReport& report) const;

  /// Lists the files that write() writes, for a message.
  std::string names(const RenderResult&) const;
  std::string names(const AdaptiveResult&) const;

 private:
  ExrFile exr(const RenderResult& result, const RenderReport& report, bool sums) const;
  ExrFile exr(const AdaptiveResult& result, const RenderReport& report, bool sums) const;
  void write_checkpoint(const ExrFile& exr, const RenderReport& report) const;

  std::filesystem::path stem_;
  RenderSettings settings_;
  bool sums_;
};

}  // namespace carlo
