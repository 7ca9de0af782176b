#pragma once

#include "course/render/report.h"
#include "image/exr.h"
#include "render/driver.h"

#include <filesystem>
#include <string>

namespace carlo {

/// Where a render's files go: their common stem. `output` is a stem, a file's name or a folder; by
/// default it is the scene's name in out/. A default folder is made, a given one must exist.
std::filesystem::path output_stem(const std::string& output, const std::string& scene);

std::filesystem::path with_suffix(const std::filesystem::path& stem, const std::string& suffix);

/// Throws Error if any of a render's files cannot be written: now, not after an hour.
void require_writable(const std::filesystem::path& stem);

/// The image with its standard errors, and what it is of.
ExrFile exr_of(const RenderResult& result, const RenderReport& report);

/// Writes a render's files: the EXR, the image and the map of its noise as PNG, the report as JSON.
/// Throws Error.
void write_outputs(const std::filesystem::path& stem, const ExrFile& exr, const Film& film,
                   const RenderReport& report);

/// The files for people; `more` of them are named before the report.
std::string names_of_outputs(const std::filesystem::path& stem, const std::string& more = "");

}  // namespace carlo
