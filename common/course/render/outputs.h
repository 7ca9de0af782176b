#pragma once

#include "course/render/report.h"
#include "image/exr.h"
#include "render/driver.h"

#include <filesystem>
#include <string>

namespace carlo {

/// Returns the common stem of a render's files. `output` is a stem, a file name or a folder; the
/// default is the scene's name in out/. The default folder is created, a given one must exist.
std::filesystem::path output_stem(const std::string& output, const std::string& scene);

std::filesystem::path with_suffix(const std::filesystem::path& stem, const std::string& suffix);

/// Throws Error if any of a render's files cannot be written: at the start, not after an hour.
void require_writable(const std::filesystem::path& stem);

/// Returns the image with its standard errors and a description of the render.
ExrFile exr_of(const RenderResult& result, const RenderReport& report);

/// Writes a render's files: the EXR, the image and the map of its noise as PNG, the report as JSON.
/// Throws Error.
void write_outputs(const std::filesystem::path& stem, const ExrFile& exr, const Film& film,
                   const RenderReport& report);

/// Lists the files for the reader; the names in `more` come before the report.
std::string names_of_outputs(const std::filesystem::path& stem, const std::string& more = "");

}  // namespace carlo
