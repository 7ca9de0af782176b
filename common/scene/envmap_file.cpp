#include "scene/envmap_file.h"

#include "image/exr.h"
#include "image/hdr.h"
#include "scene/text.h"
#include "scene/transforms.h"
#include "support/byte_order_mark.h"
#include "support/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

struct ImageFile {
  Image image;
  std::vector<std::string> notes;
  const char* size_of;  ///< something of the image's size
};

/// Chooses the reader by the file's first bytes, whatever its name.
ImageFile read_image(const fs::path& path) {
  std::string start(8, '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), 8);
  if (start.starts_with("\x76\x2f\x31\x01")) {
    ExrFile file = read_exr(path);
    return {std::move(file.image), std::move(file.notes), "a display window of "};
  }
  if (is_utf16(start)) throw Error("{} is text in UTF-16, expected an image", path.string());
  if (without_byte_order_mark(start).starts_with("#?")) {
    HdrFile file = read_hdr(path);
    return {std::move(file.image), std::move(file.notes), ""};
  }
  const bool is_pfm = start.starts_with("PF\n") || start.starts_with("Pf\n");
  throw Error("{} {}, expected OpenEXR or Radiance HDR", path.string(),
              is_pfm                     ? "is a PFM image, which is not read"
              : fs::file_size(path) == 0 ? "is empty"
                                         : "is no image of radiances");
}

// Errors inside an image are reported where the scene names it.
ImageFile read_image(const std::string& filename, Position at) {
  const fs::path path = find_file(at, filename);
  std::error_code ec;
  if (!fs::exists(path, ec)) fail(at, "the image {} does not exist", path_in_quotes(path));
  if (!fs::is_regular_file(path, ec)) fail(at, "{} is not a file", path_in_quotes(path));
  try {
    return read_image(path);
  } catch (const Error& error) {
    fail_at(at, error.what());
  }
}

float scale_of(Properties& emitter) {
  const float scale = emitter.number("scale").value_or(1);
  if (!(scale > 0)) fail(emitter.at("scale"), "scale must be > 0, got {}", scale);
  return scale;
}

/// The image is infinitely far away: only rotations and reflections have an effect.
glm::dmat3 rotation_of(Properties& emitter) {
  const auto to_world = emitter.transform("toWorld");
  if (!to_world) return glm::dmat3(1);
  const auto place = similarity(*to_world);
  const Position at = emitter.at("toWorld");
  if (!place || std::abs(place->scale - 1) > 1e-4)
    fail(at, "the toWorld of an envmap turns or mirrors it, but must not scale it");
  if (place->origin != glm::dvec3(0)) {
    fail(at, "the toWorld of an envmap must not move it, got ({:g}, {:g}, {:g})", place->origin.x,
         place->origin.y, place->origin.z);
  }
  return place->rotation;
}

void check(const ImageFile& file, const std::string& filename, Position at) {
  const Image& image = file.image;
  if (image.width != 2 * image.height) {
    fail(at, "{} has {}{} x {} pixels, expected a latitude-longitude image, twice as wide as high",
         in_quotes(filename), file.size_of, image.width, image.height);
  }
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y)[c];
        if (value >= 0 && std::isfinite(value)) continue;
        // Colours outside Rec. 709 have negative components in its primaries.
        fail(at, "{} has {} {} in column {}, row {}, expected radiances >= 0{}",
             in_quotes(filename), "RGB"[c], value, x + 1, y + 1,
             file.notes.empty() ? "" : fmt::format(" ({})", fmt::join(file.notes, "; ")));
      }
    }
  }
  const auto black = [](Rgb c) { return c == Rgb(0); };
  if (std::all_of(image.pixels.begin(), image.pixels.end(), black))
    fail(at, "{} is black all over, expected an image with light", in_quotes(filename));
}

}  // namespace

Envmap parse_envmap(Properties& emitter, std::vector<std::string>& notes) {
  const auto filename = emitter.string("filename");
  if (!filename) emitter.missing("filename", "string");
  const float scale = scale_of(emitter);
  Envmap map{Image(), rotation_of(emitter)};
  emitter.finish();
  const Position at = emitter.at("filename");
  ImageFile file = read_image(*filename, at);
  check(file, *filename, at);
  notes.insert(notes.end(), file.notes.begin(), file.notes.end());
  map.image = std::move(file.image);
  for (Rgb& texel : map.image.pixels) {
    texel *= scale;
    if (!(std::max({texel.r, texel.g, texel.b}) <= std::numeric_limits<float>::max()))
      fail(emitter.at("scale"), "the image times {} is out of float's range", scale);
  }
  return map;
}

}  // namespace carlo
