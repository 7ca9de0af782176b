#pragma once

#include "course/render/report.h"
#include "renderer/production/adaptive.h"
#include "renderer/production/arguments.h"
#include "renderer/production/resumable_outputs.h"
#include "renderer/production/resume.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace carlo {

/// A scene as the command line asks for it, and the integrator to render it with.
struct RenderTask {
  Scene scene;
  std::uint64_t seed = 1;
  std::uint32_t spp = 0;
  std::optional<ExrFile> reference = {};
  std::unique_ptr<Integrator> integrator = {};
  RenderSettings settings = {};
};

/// Renders a task, or the rest of it, and writes its image and report.
class ImageRender {
 public:
  /// Throws Error if a file cannot be written.
  ImageRender(const ProductionArguments& arguments, const RenderTask& task,
              const std::string& command);

  /// Renders up to a number of samples or for some time, continuing from `start` if there is one.
  /// Returns the exit code; throws Error.
  int run(const RenderResult* start) const;
  /// The same with a target error.
  int run(const EarlierAdaptive* start) const;

 private:
  RenderReport report_on(const RenderResult& result) const;
  RenderReport report_on(const AdaptiveResult& result) const;
  template <class Result>
  int finish(const Result& result, bool time_unknown) const;

  const ProductionArguments& a_;
  const RenderTask& task_;
  const std::string& command_;
  ResumableOutputs outputs_;
  std::optional<std::filesystem::path> page_;
};

}  // namespace carlo
