#include "reference.h"

#include "image/exr.h"
#include "support/error.h"

namespace bench {

using carlo::Image;

Reference read_reference(const std::filesystem::path& path, int size) {
  const carlo::ExrFile file = carlo::read_exr(path);
  if (!file.standard_error) throw carlo::Error("{} has no standard error", path.string());
  const int factor = file.image.width / size;
  if (file.image.width != factor * size || file.image.height != factor * size) {
    throw carlo::Error("{} has {} x {} pixels, which {} x {} does not divide", path.string(),
                       file.image.width, file.image.height, size, size);
  }
  const auto share = 1 / static_cast<float>(factor * factor);
  Reference result{Image(size, size), 0};
  const double weight = static_cast<double>(share) / (3.0 * size * size);
  for (int y = 0; y < file.image.height; ++y) {
    for (int x = 0; x < file.image.width; ++x) {
      result.image.at(x / factor, y / factor) += share * file.image.at(x, y);
      // The variance of a mean over factor^2 pixels is the mean of their variances over factor^2.
      for (int c = 0; c < 3; ++c) {
        const double error = file.standard_error->at(x, y)[c];
        result.noise += weight * static_cast<double>(share) * error * error;
      }
    }
  }
  return result;
}

}  // namespace bench
