#include "image/exr.h"

#include "image/exr_header.h"
#include "image/exr_window.h"
#include "image/primaries.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace carlo {
namespace {

const std::array<std::string, 3> colour_channels = {"R", "G", "B"};
const std::array<std::string, 3> error_channels = {"se.R", "se.G", "se.B"};
const std::string samples_channel = "samples";
const std::string attribute_prefix = "carlo:";

/// OpenEXR files carry a date; a fixed one keeps equal images equal.
constexpr const char* fixed_date = "2000:01:01 00:00:00";

/// Lines that are assembled at once: several of the format's bands of 16.
constexpr int lines_at_once = 64;

/// The channels of some lines, one after the other for each pixel, as 32-bit words: floats, then
/// whole numbers.
std::vector<std::uint32_t> interleave(const ExrFile& file, int first_line, int end_line) {
  std::vector<std::uint32_t> data;
  const std::size_t first = file.image.index(0, first_line);
  const std::size_t end = first + file.image.index(0, end_line - first_line);
  data.reserve((end - first) * ((file.standard_error ? 7 : 4) + file.counts.size()));
  for (std::size_t i = first; i < end; ++i) {
    for (int c = 0; c < 3; ++c)
      data.push_back(std::bit_cast<std::uint32_t>(file.image.pixels[i][c]));
    for (int c = 0; c < 3 && file.standard_error; ++c)
      data.push_back(std::bit_cast<std::uint32_t>(file.standard_error->pixels[i][c]));
    if (!file.samples.empty()) data.push_back(std::bit_cast<std::uint32_t>(file.samples[i]));
    for (const auto& [name, values] : file.counts)
      data.push_back(values[i]);
  }
  return data;
}

bool write_lines(OIIO::ImageOutput& out, const ExrFile& file) {
  for (int y = 0; y < file.image.height; y += lines_at_once) {
    const int end = std::min(y + lines_at_once, file.image.height);
    const std::vector<std::uint32_t> data = interleave(file, y, end);
    if (!out.write_scanlines(y, end, 0, OIIO::TypeDesc::UNKNOWN, data.data())) return false;
  }
  return true;
}

OIIO::ImageSpec spec_of(const ExrFile& file) {
  OIIO::ImageSpec spec(file.image.width, file.image.height, 0, OIIO::TypeDesc::FLOAT);
  const auto add = [&spec](const std::string& name, const OIIO::TypeDesc& type) {
    spec.channelnames.push_back(name);
    spec.channelformats.push_back(type);
    ++spec.nchannels;
  };
  for (const std::string& name : colour_channels)
    add(name, OIIO::TypeDesc::FLOAT);
  if (file.standard_error) {
    for (const std::string& name : error_channels)
      add(name, OIIO::TypeDesc::FLOAT);
  }
  if (!file.samples.empty()) add(samples_channel, OIIO::TypeDesc::FLOAT);
  for (const auto& [name, values] : file.counts)
    add(name, OIIO::TypeDesc::UINT32);
  if (file.counts.empty()) spec.channelformats.clear();
  spec.attribute("compression", "zip:1");
  spec.attribute("DateTime", fixed_date);
  for (const auto& [name, value] : file.attributes)
    spec.attribute(attribute_prefix + name, value);
  return spec;
}

std::string in_one_line(std::string text) {
  while (text.ends_with('\n'))
    text.pop_back();
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n'))
    text.replace(at, 1, " ");
  return text;
}

/// The positions of three named channels in a file, or nothing if one is missing.
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

/// Reads `count` channels of 32-bit values from `first` on, interleaved.
template <class T>
std::vector<T> read_channels(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, std::size_t first,
                             std::size_t count, const std::filesystem::path& path) {
  std::vector<T> data(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                      count);
  const auto begin = static_cast<int>(first);
  const auto type = std::is_same_v<T, float> ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT32;
  if (!in.read_image(in.current_subimage(), 0, begin, begin + static_cast<int>(count), type,
                     data.data())) {
    throw Error("cannot read {}: {}", path.string(), in_one_line(in.geterror()));
  }
  return data;
}

/// OpenImageIO turns whole numbers into fractions of the largest; in an EXR file 1 means 1.
void put_whole_numbers(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const ExrWindow& window,
                       const std::array<std::size_t, 3>& places, const std::filesystem::path& path,
                       Image& image) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (spec.channelformat(static_cast<int>(places.at(c))) != OIIO::TypeDesc::UINT32) continue;
    const auto data = read_channels<std::uint32_t>(in, spec, places.at(c), 1, path);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (const auto pixel = window.find(x, y))
          image.at(x, y)[static_cast<int>(c)] = static_cast<float>(data[*pixel]);
      }
    }
  }
}

/// Reads three channels, and besides them only those that lie between.
Image read_colours(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const ExrWindow& window,
                   const std::array<std::size_t, 3>& places, const std::filesystem::path& path) {
  const auto [first, last] = std::minmax_element(places.begin(), places.end());
  const std::size_t count = *last - *first + 1;
  const auto data = read_channels<float>(in, spec, *first, count, path);
  Image image(window.width(), window.height());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto pixel = window.find(x, y);
      for (int c = 0; c < 3 && pixel; ++c)
        image.at(x, y)[c] = data[*pixel * count + places[static_cast<std::size_t>(c)] - *first];
    }
  }
  put_whole_numbers(in, spec, window, places, path, image);
  return image;
}

/// Reads those of the named channels that the file has as whole numbers, in one read: each read
/// unpacks the channels in between as well, and a render's sums are scores of them.
std::map<std::string, std::vector<std::uint32_t>> read_counts(OIIO::ImageInput& in,
                                                              const OIIO::ImageSpec& spec,
                                                              const ExrWindow& window,
                                                              const std::vector<std::string>& names,
                                                              const std::filesystem::path& path) {
  std::map<std::string, std::size_t> places;
  std::size_t first = spec.channelnames.size(), last = 0;
  for (const std::string& name : names) {
    const int place = spec.channelindex(name);
    if (place < 0 || spec.channelformat(place) != OIIO::TypeDesc::UINT32) continue;
    places[name] = static_cast<std::size_t>(place);
    first = std::min(first, places[name]);
    last = std::max(last, places[name]);
  }
  std::map<std::string, std::vector<std::uint32_t>> counts;
  // A render's sums fill its image. In a larger one they would take memory that no size of the file
  // limits.
  const bool fill =
      std::int64_t{window.width()} * window.height() <= std::int64_t{spec.width} * spec.height;
  if (places.empty() || !fill) return counts;
  const std::size_t stride = last - first + 1;
  const auto data = read_channels<std::uint32_t>(in, spec, first, stride, path);
  for (const auto& [name, place] : places) {
    std::vector<std::uint32_t>& values = counts[name];
    values.reserve(static_cast<std::size_t>(window.width()) *
                   static_cast<std::size_t>(window.height()));
    for (int y = 0; y < window.height(); ++y) {
      for (int x = 0; x < window.width(); ++x) {
        const auto pixel = window.find(x, y);
        values.push_back(pixel ? data[*pixel * stride + place - first] : 0);
      }
    }
  }
  return counts;
}

/// OpenEXR unpacks as much as a header claims, and fills up missing data with zeros. Deflate
/// expands a byte to at most 1032 (with PXR24 4/3 of that); PIZ and DWA pack a blank block of lines
/// into scores of bytes.
void require_plausible_size(const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
  if (std::int64_t{spec.width} * spec.height > most_pixels) {
    throw Error("cannot read {}: it has {} x {} pixels, expected {} at most", path.string(),
                spec.width, spec.height, most_pixels);
  }
  const std::string packing(spec.get_string_attribute("compression"));
  const bool by_blocks = packing == "piz" || packing.starts_with("dwa");
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  if (spec.image_bytes(true) / (by_blocks ? 65536 : 1376) > bytes) {
    throw Error("cannot read {}: {} x {} pixels of {} channels cannot come from {} bytes",
                path.string(), spec.width, spec.height, spec.nchannels, bytes);
  }
}

/// Finds the first part with R, G, B and moves the reader to it.
OIIO::ImageSpec find_part(OIIO::ImageInput& in, const std::filesystem::path& path,
                          std::vector<std::string>& notes) {
  const OIIO::ImageSpec first = in.spec();
  const int parts = first.get_int_attribute("oiio:subimages", 1);
  int found = -1;
  for (int part = 0; part < parts && found < 0 && in.seek_subimage(part, 0); ++part) {
    if (find_channels(in.spec().channelnames, colour_channels)) found = part;
  }
  if (found < 0) {
    throw Error("cannot read {}: it has no channels R, G, B, but {}", path.string(),
                fmt::join(first.channelnames, ", "));
  }
  if (in.spec().deep) {
    throw Error(
        "cannot read {}: its pixels are deep (values at several depths), expected flat ones",
        path.string());
  }
  if (parts > 1)
    notes.push_back(
        fmt::format("part {} of its {} is read, the first with R, G, B", found + 1, parts));
  return in.spec();
}

/// Converts to linear Rec. 709.
void convert_colours(const OIIO::ImageSpec& spec, ExrFile& file,
                     const std::filesystem::path& path) {
  for (const char* name : {"whiteLuminance", "adoptedNeutral"}) {
    if (spec.find_attribute(name) != nullptr)
      file.notes.push_back(fmt::format("its {} is not used", name));
  }
  if (spec.get_float_attribute("PixelAspectRatio", 1) != 1)
    file.notes.emplace_back("its pixelAspectRatio is not used");
  std::array<float, 8> xy{};
  const OIIO::TypeDesc type(OIIO::TypeDesc::FLOAT, 8);
  if (!spec.getattribute("chromaticities", type, xy.data())) return;
  const auto pair = [&xy](std::size_t i) {
    return std::array{static_cast<double>(xy.at(i)), static_cast<double>(xy.at(i + 1))};
  };
  const Primaries primaries{pair(0), pair(2), pair(4), pair(6)};
  std::optional<glm::dmat3> matrix;
  try {
    matrix = to_rec709(primaries, White::kept);
  } catch (const Error& error) {
    throw Error("cannot read {}: {}", path.string(), error.what());
  }
  if (!matrix) return;
  convert(file.image, *matrix);
  file.notes.push_back(fmt::format("its chromaticities, {}, are converted to those of Rec. 709",
                                   text_of(primaries)));
  // The correlation of the three channels' errors is not known.
  if (file.standard_error) file.notes.emplace_back("its standard errors are not used");
  file.standard_error.reset();
}

}  // namespace

void write_exr(const std::filesystem::path& path, const ExrFile& file) {
  AtomicFile target(path);
  auto out = OIIO::ImageOutput::create("exr");
  if (!out) throw Error("cannot write {}: {}", path.string(), OIIO::geterror());
  if (!out->open(target.path().string(), spec_of(file)) || !write_lines(*out, file) ||
      !out->close()) {
    throw Error("cannot write {}: {}", path.string(), out->geterror());
  }
  target.commit();
}

ExrFile read_exr(const std::filesystem::path& path, const std::vector<std::string>& counts) {
  // By default OpenImageIO reserves room for 256 lines, however few a file has: 400 MB for two
  // lines of many channels. Its other bound, 64 MB, stays.
  OIIO::attribute("read_chunk", 1);
  require_honest_header(path);
  // Opened by its format alone: for a file that OpenEXR refuses, OpenImageIO would otherwise try
  // the readers of all other formats, some of which allocate whatever the file claims.
  auto in = OIIO::ImageInput::create("openexr");
  if (!in) throw Error("cannot read {}: {}", path.string(), OIIO::geterror());
  OIIO::ImageSpec spec;
  if (!in->open(path.string(), spec)) {
    throw Error("cannot read {} as OpenEXR: {}", path.string(), in_one_line(in->geterror()));
  }
  ExrFile file;
  spec = find_part(*in, path, file.notes);
  require_plausible_size(spec, path);
  const ExrWindow window(spec, path);
  if (const auto note = window.note()) file.notes.push_back(*note);
  const auto colour = find_channels(spec.channelnames, colour_channels);
  file.image = read_colours(*in, spec, window, colour.value(), path);
  if (const auto error = find_channels(spec.channelnames, error_channels)) {
    file.standard_error = read_colours(*in, spec, window, *error, path);
  }
  file.counts = read_counts(*in, spec, window, counts, path);
  for (const auto& attribute : spec.extra_attribs) {
    const std::string name = attribute.name().string();
    if (name.starts_with(attribute_prefix)) {
      file.attributes[name.substr(attribute_prefix.size())] = attribute.get_string();
    }
  }
  convert_colours(spec, file, path);
  for (std::string& note : file.notes)
    note.insert(0, path.filename().string() + ": ");
  return file;
}

}  // namespace carlo
