#pragma once

#include "course/render/report.h"
#include "image/exr.h"
#include "image/film.h"

#include <filesystem>
#include <optional>
#include <string>

namespace carlo {

/// Writes a page that shows a render: the image with its noise, its differences from a reference if
/// there is one, the report's numbers and the command. Throws Error.
void write_render_page(const std::filesystem::path& path, const std::string& command,
                       const RenderReport& report, const Film& film,
                       const std::optional<ExrFile>& reference);

/// The command line as the reader can type it again: "./carlo render SCENE --spp 16".
std::string command_text(int argc, char** argv);

}  // namespace carlo
