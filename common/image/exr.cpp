#include "image/exr.h"

#include "cli/atomic_file.h"
#include "cli/error.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <vector>

namespace carlo {
namespace {

const std::array<std::string, 3> colour_channels = {"R", "G", "B"};
const std::array<std::string, 3> error_channels = {"se.R", "se.G", "se.B"};
const std::string attribute_prefix = "carlo:";

/// OpenEXR files carry a date; a fixed one keeps equal images equal.
constexpr const char* fixed_date = "2000:01:01 00:00:00";

std::vector<float> interleave(const ExrFile& file) {
  std::vector<float> data;
  data.reserve(file.image.pixels.size() * (file.standard_error ? 6 : 3));
  for (std::size_t i = 0; i < file.image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      data.push_back(file.image.pixels[i][c]);
    if (!file.standard_error) continue;
    for (int c = 0; c < 3; ++c)
      data.push_back(file.standard_error->pixels[i][c]);
  }
  return data;
}

/// The places of three named channels among a file's, or nothing if one is missing.
std::optional<std::array<std::size_t, 3>> find_channels(const std::vector<std::string>& names,
                                                        const std::array<std::string, 3>& wanted) {
  std::array<std::size_t, 3> places{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto it = std::find(names.begin(), names.end(), wanted[c]);
    if (it == names.end()) return std::nullopt;
    places[c] = static_cast<std::size_t>(it - names.begin());
  }
  return places;
}

Image extract(const std::vector<float>& data, int width, int height, std::size_t channels,
              const std::array<std::size_t, 3>& places) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      image.pixels[i][c] = data[i * channels + places[static_cast<std::size_t>(c)]];
    }
  }
  return image;
}

}  // namespace

void write_exr(const std::filesystem::path& path, const ExrFile& file) {
  AtomicFile target(path);
  auto out = OIIO::ImageOutput::create("exr");
  if (!out) throw Error("cannot write {}: {}", path.string(), OIIO::geterror());
  OIIO::ImageSpec spec(file.image.width, file.image.height, file.standard_error ? 6 : 3,
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames.assign(colour_channels.begin(), colour_channels.end());
  if (file.standard_error) {
    spec.channelnames.insert(spec.channelnames.end(), error_channels.begin(), error_channels.end());
  }
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", fixed_date);
  for (const auto& [name, value] : file.attributes)
    spec.attribute(attribute_prefix + name, value);
  const std::vector<float> data = interleave(file);
  if (!out->open(target.path().string(), spec) ||
      !out->write_image(OIIO::TypeDesc::FLOAT, data.data()) || !out->close()) {
    throw Error("cannot write {}: {}", path.string(), out->geterror());
  }
  target.commit();
}

ExrFile read_exr(const std::filesystem::path& path) {
  auto in = OIIO::ImageInput::open(path.string());
  if (!in) throw Error("cannot read {}: {}", path.string(), OIIO::geterror());
  if (std::string(in->format_name()) != "openexr") {
    throw Error("cannot read {}: it is {}, expected OpenEXR", path.string(), in->format_name());
  }
  const OIIO::ImageSpec spec = in->spec();
  const auto colour = find_channels(spec.channelnames, colour_channels);
  if (!colour) throw Error("cannot read {}: it has no channels R, G, B", path.string());
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> data(static_cast<std::size_t>(spec.width) *
                          static_cast<std::size_t>(spec.height) * channels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, data.data())) {
    throw Error("cannot read {}: {}", path.string(), in->geterror());
  }
  ExrFile file;
  file.image = extract(data, spec.width, spec.height, channels, *colour);
  if (const auto error = find_channels(spec.channelnames, error_channels)) {
    file.standard_error = extract(data, spec.width, spec.height, channels, *error);
  }
  for (const auto& attribute : spec.extra_attribs) {
    const std::string name = attribute.name().string();
    if (name.starts_with(attribute_prefix)) {
      file.attributes[name.substr(attribute_prefix.size())] = attribute.get_string();
    }
  }
  return file;
}

}  // namespace carlo
