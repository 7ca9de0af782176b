#pragma once

#include "image/image.h"

#include <filesystem>

namespace bench {

/// A reference image of tests/references/scenes on a film of `size` x `size`, and its own
/// contribution to a mean square error against it.
struct Reference {
  carlo::Image image;
  double noise = 0;  ///< the mean over pixels and channels of its squared standard error
};

/// Throws Error when the file's size is not a multiple of `size`, or it lacks the standard error.
Reference read_reference(const std::filesystem::path& path, int size);

}  // namespace bench
