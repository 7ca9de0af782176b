#pragma once

#include <filesystem>

namespace carlo {

/// Throws Error when an attribute in the header of an OpenEXR file claims more bytes than the file
/// has, or a size other than its type's, or when lines that are packed together take more than 128
/// MB: OpenEXR 3.1 allocates what is claimed before it reads. Any other error in the file is left
/// to OpenEXR.
void require_honest_header(const std::filesystem::path& path);

}  // namespace carlo
