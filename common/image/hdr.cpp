#include "image/hdr.h"

#include "cli/atomic_file.h"
#include "cli/error.h"
#include "cli/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {
namespace {

constexpr int least_packed = 8, most_packed = 32767;  ///< widths of rows that may come in runs
using Rgbe = std::array<std::uint8_t, 4>;

class HdrReader {
 public:
  explicit HdrReader(const std::filesystem::path& path)
      : path_(path.string()), bytes_(read_file(path)), rest_(bytes_) {}

  Image read() {
    read_header();
    Image image = sized();
    std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
    for (int y = 0; y < image.height; ++y) {
      read_row(row);
      std::transform(row.begin(), row.end(), image.pixels.begin() + y * image.width,
                     [this](const Rgbe& p) { return radiance(p); });
    }
    if (!rest_.empty()) fail(fmt::format("{} bytes follow the last pixel", rest_.size()));
    return image;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("cannot read {}: {}", path_, what);
  }

  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("its header has no end");
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return text;
  }

  /// The number that all of `text` is, but for blanks before it; fails otherwise.
  template <class T>
  T number(std::string_view text, std::string_view what) const {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const std::optional<T> value = number_of<T>(text);
    if (!value || !(*value > 0)) fail(fmt::format("{} must be a number > 0", what));
    return *value;
  }

  void read_header() {
    if (!line().starts_with("#?")) fail("it does not begin with #?");
    for (std::string_view text = line(); !text.empty(); text = line()) {
      if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe")
        fail("its FORMAT is not 32-bit_rle_rgbe");
      if (text.starts_with("EXPOSURE="))
        per_exposure_ /= number<double>(text.substr(9), "its EXPOSURE");
    }
  }

  /// "-Y height +X width", and enough bytes behind it.
  Image sized() {
    const std::string_view text = line();
    const std::size_t x = text.find(" +X ");
    if (!text.starts_with("-Y ") || x == std::string_view::npos)
      fail("its size is not told as -Y height +X width, the top row first");
    const auto height = number<int>(text.substr(3, x - 3), "its height");
    const auto width = number<int>(text.substr(x + 4), "its width");
    if (std::int64_t{width} * height > most_pixels)
      fail(fmt::format("it has {} x {} pixels, expected {} at most", width, height, most_pixels));
    // A run of 127 takes 2 bytes.
    const std::int64_t plain = 4 * std::int64_t{width}, packed = 4 + 8 * ((width + 126) / 127);
    if (static_cast<std::int64_t>(rest_.size()) < std::min(plain, packed) * height)
      short_of_bytes();
    return {width, height};
  }

  [[noreturn]] void short_of_bytes() const { fail("the file ends too early"); }

  std::uint8_t byte() {
    if (rest_.empty()) short_of_bytes();
    const char c = rest_.front();
    rest_.remove_prefix(1);
    return static_cast<std::uint8_t>(c);
  }

  /// Rows in runs begin with 2, 2 and their width.
  void read_row(std::vector<Rgbe>& row) {
    const auto width = static_cast<int>(row.size());
    const std::string start{2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 255)};
    if (width >= least_packed && width <= most_packed && rest_.starts_with(start)) {
      rest_.remove_prefix(4);
      for (std::size_t channel = 0; channel < 4; ++channel)
        read_runs(row, channel);
      return;
    }
    for (Rgbe& pixel : row) {
      for (std::uint8_t& value : pixel)
        value = byte();
      if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1)
        fail("it is packed in the old way, by repeated pixels");
    }
  }

  /// Above 128: one byte so many times less 128; else so many bytes.
  void read_runs(std::vector<Rgbe>& row, std::size_t channel) {
    for (std::size_t x = 0; x < row.size();) {
      const std::uint8_t code = byte();
      const bool run = code > 128;
      const std::size_t count = run ? code - 128u : code;
      if (count == 0 || count > row.size() - x) fail("a run of pixels does not fit into its row");
      const std::uint8_t same = run ? byte() : std::uint8_t{0};
      for (const std::size_t end = x + count; x < end; ++x)
        row[x][channel] = run ? same : byte();
    }
  }

  Rgb radiance(const Rgbe& pixel) const {
    if (pixel[3] == 0) return Rgb(0);
    const double unit = std::ldexp(per_exposure_, int{pixel[3]} - 136);
    return {static_cast<float>(pixel[0] * unit), static_cast<float>(pixel[1] * unit),
            static_cast<float>(pixel[2] * unit)};
  }

  std::string path_, bytes_;
  std::string_view rest_;
  double per_exposure_ = 1;
};

}  // namespace

Image read_hdr(const std::filesystem::path& path) {
  return HdrReader(path).read();
}

}  // namespace carlo
