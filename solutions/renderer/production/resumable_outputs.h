#pragma once

#include "course/render/report.h"
#include "image/exr.h"
#include "renderer/production/adaptive.h"
#include "renderer/production/resume.h"

#include <filesystem>
#include <string>

namespace carlo {

/// Writes the files of a render, and of a render under way: with the sums in its EXR, to go on
/// from.
class ResumableOutputs {
 public:
  /// Throws Error if any of them cannot be written. Without `sums` the EXR is smaller, and nothing
  /// to go on from.
  ResumableOutputs(std::filesystem::path stem, RenderSettings settings, bool sums);

  const std::filesystem::path& stem() const { return stem_; }

  /// All that goes on needs: the image and how long it took.
  void checkpoint(const RenderResult& result, const RenderReport& report) const;
  void checkpoint(const AdaptiveResult& result, const RenderReport& report) const;

  void write(const RenderResult& result, const RenderReport& report) const;
  void write(const AdaptiveResult& result, const RenderReport& report) const;

  /// What write() writes, for people.
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
