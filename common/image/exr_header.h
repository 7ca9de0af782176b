#pragma once

#include <filesystem>

namespace carlo {

/// Throws Error when an attribute in the header of an OpenEXR file claims more bytes than the file
/// has, or others than its type takes, or when lines that are packed together take more than 128
/// MB: OpenEXR 3.1 allocates what is claimed before it reads. Whatever else may be wrong with the
/// file is for OpenEXR to say.
void require_honest_header(const std::filesystem::path& path);

}  // namespace carlo
