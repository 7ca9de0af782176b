#include "course/viewer/picture.h"

#include "course/viewer/base64.h"
#include "image/png.h"

#include <cmath>

namespace carlo {

std::string picture_url(const Image& image, double white) {
  return "data:image/png;base64," + base64(png(image, static_cast<float>(-std::log2(white))));
}

}  // namespace carlo
