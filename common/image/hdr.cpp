#include "image/hdr.h"

#include "image/primaries.h"
#include "support/atomic_file.h"
#include "support/byte_order_mark.h"
#include "support/error.h"
#include "support/number.h"
#include "support/quotes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carlo {
namespace {

constexpr int least_packed = 8, most_packed = 32767;  ///< widths of rows that may be run-length
                                                      ///< encoded
using Rgbe = std::array<std::uint8_t, 4>;

// Used instead of OpenImageIO, whose versions 2.4.7 and 3.2.2 do not divide pixels by EXPOSURE.
class HdrReader {
 public:
  explicit HdrReader(const std::filesystem::path& path)
      : path_(path.string()),
        name_(path.filename().string()),
        bytes_(read_file(path)),
        rest_(without_byte_order_mark(bytes_)) {}

  HdrFile read() {
    read_header();
    Image image = sized();
    std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
    for (int y = 0; y < image.height; ++y) {
      read_row(row);
      std::transform(row.begin(), row.end(), image.pixels.begin() + y * image.width,
                     [this](const Rgbe& p) { return radiance(p); });
    }
    check_end(image.width);
    if (primaries_) convert_from(*primaries_, image);
    return {std::move(image), std::move(notes_)};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("cannot read {}: {}", path_, what);
  }

  void note(const std::string& what) { notes_.push_back(name_ + ": " + what); }

  /// Edited headers may have lines that end in \r\n. Leading blanks are kept: header lines of the
  /// image that this one was made from are indented.
  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("its header has no end");
    std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  static std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
  }

  /// All of `text` as a number, except leading blanks; fails otherwise.
  template <class T>
  T number(std::string_view text, std::string_view what) const {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const std::optional<T> value = number_of<T>(text);
    if (!value || !(*value > 0))
      fail(fmt::format("{} must be a number > 0, got {}", what, in_quotes(text)));
    return *value;
  }

  /// Exactly `count` numbers, separated by blanks.
  template <std::size_t count>
  std::array<double, count> numbers(std::string_view text, std::string_view what) const {
    const std::string_view whole = text;
    std::array<double, count> values{};
    for (double& value : values) {
      text = trimmed(text);
      const std::size_t end = std::min(text.find_first_of(blanks), text.size());
      const auto number = number_of<double>(text.substr(0, end));
      if (!number || !std::isfinite(*number)) break_off(count, what, whole);
      value = *number;
      text.remove_prefix(end);
    }
    if (!text.empty()) break_off(count, what, whole);
    return values;
  }

  [[noreturn]] void break_off(std::size_t count, std::string_view what,
                              std::string_view text) const {
    fail(fmt::format("{} must be {} numbers, got {}", what, count, in_quotes(text)));
  }

  void read_header() {
    if (!line().starts_with("#?")) fail("it does not begin with #?");
    for (std::string_view text = line(); !text.empty(); text = line()) {
      const std::size_t equals = text.find('=');
      if (equals != std::string_view::npos)
        read_variable(text.substr(0, equals), trimmed(text.substr(equals + 1)));
    }
  }

  /// Other variables (SOFTWARE, CAPDATE, ...) and lines of programs only describe the origin.
  void read_variable(std::string_view name, std::string_view value) {
    if (name == "FORMAT" && value != "32-bit_rle_rgbe")
      fail(fmt::format("its FORMAT is not 32-bit_rle_rgbe, but {}", in_quotes(value)));
    if (name == "EXPOSURE") divide_by(glm::dvec3(number<double>(value, "its EXPOSURE")));
    if (name == "COLORCORR") read_correction(numbers<3>(value, "its COLORCORR"), value);
    if (name == "PRIMARIES") {
      const auto xy = numbers<8>(value, "its PRIMARIES");
      primaries_ = {{xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
      if (xy == std::array<double, 8>{}) {
        note("its PRIMARIES are all 0, taken for those of Rec. 709");
        primaries_.reset();
      }
    }
    if (name == "GAMMA" && number_of<double>(value) != 1)
      fail(fmt::format("its GAMMA is not 1, but {}: expected linear values", in_quotes(value)));
    if (name == "PIXASPECT" && number_of<double>(value) != 1) note("its PIXASPECT is not used");
    if (name == "VIEW") note("its VIEW is not used");
  }

  void read_correction(const std::array<double, 3>& factors, std::string_view text) {
    for (const double factor : factors) {
      if (!(factor > 0))
        fail(fmt::format("its COLORCORR must be three numbers > 0, got {}", in_quotes(text)));
    }
    divide_by({factors[0], factors[1], factors[2]});
  }

  void divide_by(glm::dvec3 factor) { per_correction_ /= factor; }

  void convert_from(const Primaries& primaries, Image& image) {
    std::optional<glm::dmat3> matrix;
    try {
      matrix = to_rec709(primaries, White::adapted);
    } catch (const Error& error) {
      fail(error.what());
    }
    if (!matrix) return;
    convert(image, *matrix);
    note(fmt::format("its PRIMARIES, {}, are converted to those of Rec. 709", text_of(primaries)));
  }

  /// Fewer bytes than a row takes are not a row that the size leaves out, but an editor's end of
  /// line or padding.
  void check_end(int width) {
    if (rest_.empty()) return;
    if (static_cast<std::int64_t>(rest_.size()) >= least_bytes_of_row(width))
      fail(fmt::format("{} bytes follow the last pixel", rest_.size()));
    note(fmt::format("{} bytes follow the last pixel and are not used", rest_.size()));
  }

  /// A run of 127 takes 2 bytes.
  static std::int64_t least_bytes_of_row(std::int64_t width) {
    return std::min(4 * width, 4 + 8 * ((width + 126) / 127));
  }

  /// Reads "-Y height +X width", and checks that enough bytes follow.
  Image sized() {
    const std::string_view text = line();
    const std::size_t x = text.find(" +X ");
    if (!text.starts_with("-Y ") || x == std::string_view::npos)
      fail(fmt::format("its size is not given as -Y height +X width, the top row first, but as {}",
                       in_quotes(text)));
    const auto height = number<int>(text.substr(3, x - 3), "its height");
    const auto width = number<int>(text.substr(x + 4), "its width");
    if (std::int64_t{width} * height > most_pixels)
      fail(fmt::format("it has {} x {} pixels, expected {} at most", width, height, most_pixels));
    if (static_cast<std::int64_t>(rest_.size()) < least_bytes_of_row(width) * height)
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

  /// Run-length encoded rows begin with 2, 2 and their width.
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

  /// A count above 128 repeats one byte (count - 128) times; otherwise `count` bytes follow.
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
    const glm::dvec3 mantissa(pixel[0], pixel[1], pixel[2]);
    const int exponent = int{pixel[3]} - 136;
    return Rgb(mantissa * glm::dvec3(std::ldexp(per_correction_.r, exponent),
                                     std::ldexp(per_correction_.g, exponent),
                                     std::ldexp(per_correction_.b, exponent)));
  }

  static constexpr std::string_view blanks = " \t\r";
  std::string path_, name_, bytes_;
  std::string_view rest_;
  glm::dvec3 per_correction_{1};  ///< 1 over the factor that the pixels were multiplied by
  std::optional<Primaries> primaries_;
  std::vector<std::string> notes_;
};

}  // namespace

HdrFile read_hdr(const std::filesystem::path& path) {
  return HdrReader(path).read();
}

}  // namespace carlo
