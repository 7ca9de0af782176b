#include "scene/mesh_file.h"
#include "scene/text.h"
#include "support/atomic_file.h"
#include "support/byte_order_mark.h"
#include "support/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace carlo {
namespace {

using Keywords = std::span<const std::string_view>;

// Source of these: Wavefront, "Advanced Visualizer Manual", appendix B1; t and vw are OpenSubdiv's.
constexpr std::array<std::string_view, 5> silent = {"vt", "o", "g", "s", "mtllib"};
constexpr std::array<std::string_view, 14> harmless = {
    "bevel", "c_interp",   "ctech", "d_interp", "lod",       "maplib", "mg",
    "stech", "shadow_obj", "t",     "usemap",   "trace_obj", "vp",     "vw"};
constexpr std::array<std::string_view, 21> other_geometry = {
    "bmat", "bsp", "bzp",  "call", "cdc", "cdp",  "con", "csh",  "cstype", "curv", "curv2",
    "deg",  "end", "hole", "parm", "res", "scrv", "sp",  "step", "surf",   "trim"};

bool among(Keywords keywords, std::string_view word) {
  return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

constexpr std::string_view blanks = " \t\r\v\f";

/// Takes the next word off the line; empty at its end.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/// Splits the file into statements. Text after # is a comment; a \ at the end of a line joins the
/// next one. Lines end in LF or CR LF; in CR where there is no LF, as old Macintoshes wrote them.
class ObjLines {
 public:
  explicit ObjLines(std::string_view text) : rest_(text), end_of_line_(end_of_line(text)) {}

  /// Returns the next statement; line() is then its first line. Nothing after the last one.
  std::optional<std::string_view> next() {
    line_ += taken_;
    taken_ = 0;
    if (rest_.empty()) return std::nullopt;
    std::string_view line = take_line();
    if (!ends_in_backslash(line)) return line;
    joined_.clear();
    while (ends_in_backslash(line)) {
      joined_.append(line.substr(0, line.rfind('\\'))) += ' ';
      line = rest_.empty() ? std::string_view() : take_line();
    }
    joined_ += line;
    return joined_;
  }

  std::size_t line() const { return line_; }

 private:
  std::string_view take_line() {
    const std::size_t end = std::min(rest_.find(end_of_line_), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++taken_;
    line = line.substr(0, line.find('#'));
    return line.substr(0, line.find_last_not_of(blanks) + 1);
  }

  static bool ends_in_backslash(std::string_view line) { return line.ends_with('\\'); }

  std::string_view rest_;
  char end_of_line_;
  std::string joined_;
  std::size_t line_ = 1, taken_ = 0;
};

// Why a reader of our own: of the files of tests/common/mesh_found_test.cpp and
// tests/renderer/found_files.txt tinyobjloader 2.0.0rc10 reads, without a word, a coordinate that
// is no number as 0, a vertex that a \ continues wrongly, 5 of the 8 triangles of a square with a
// hole, and curves as nothing; so does Assimp 5.2.5 with the first and the last, and it refuses
// ".5". Both fill polygons whose edges cross.
class ObjReader {
 public:
  ObjReader(std::string name, std::string_view text) : name_(std::move(name)), lines_(text) {}

  MeshFile read() {
    while (const auto statement = lines_.next())
      read_statement(*statement);
    if (!mesh_.normals_of.empty())
      mesh_.normals_of.resize(mesh_.triangles.size(), glm::uvec3(mesh_.no_normal));
    cut_polygons(mesh_, name_, ":");
    if (materials_) mesh_.notes.push_back(name_ + ": materials named in the file are not used");
    if (!unused_.empty()) {
      mesh_.notes.push_back(fmt::format("{}: {} changes no polygon and is not used", name_,
                                        fmt::join(unused_, ", ")));
    }
    if (missing_normals_ > 0) {
      mesh_.notes.push_back(
          fmt::format("{}: {} corners name normals that are not there", name_, missing_normals_));
    }
    if (strays_ > 0) {
      mesh_.notes.push_back(fmt::format("{}: {} lines and points left out", name_, strays_));
    }
    return std::move(mesh_);
  }

 private:
  void read_statement(std::string_view line) {
    const std::string_view keyword = take_word(line);
    if (keyword.empty()) return;
    if (keyword == "v") return read_vertex(line);
    if (keyword == "f") return read_face(line);
    if (keyword == "vn") return read_normal(line);
    if (among(silent, keyword)) return;
    if (keyword == "l" || keyword == "p") {
      ++strays_;
    } else if (keyword == "usemtl") {
      materials_ = true;
    } else if (among(harmless, keyword)) {
      if (std::find(unused_.begin(), unused_.end(), keyword) == unused_.end())
        unused_.emplace_back(keyword);
    } else if (among(other_geometry, keyword)) {
      wrong(fmt::format("{} is for geometry that is not supported: expected polygons (f)",
                        in_quotes(keyword)));
    } else {
      wrong(fmt::format("{} is not understood", in_quotes(keyword)));
    }
  }

  // x y z, perhaps followed by w = 1 or by a colour.
  void read_vertex(std::string_view line) {
    std::array<double, 6> numbers{};
    const std::size_t count = read_numbers(line, numbers);
    if (count != 3 && count != 4 && count != 6)
      wrong(fmt::format("a vertex has 3 numbers, got {}", count));
    if (count == 4 && numbers[3] != 1)
      wrong(fmt::format("the fourth number of a vertex, w, must be 1, got {}", numbers[3]));
    mesh_.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
  }

  void read_normal(std::string_view line) {
    std::array<double, 3> numbers{};
    const std::size_t count = read_numbers(line, numbers);
    if (count != 3) wrong(fmt::format("a vertex normal has 3 numbers, got {}", count));
    mesh_.normals.emplace_back(numbers[0], numbers[1], numbers[2]);
  }

  /// Returns how many there are, even if too many to be stored.
  template <std::size_t most>
  std::size_t read_numbers(std::string_view line, std::array<double, most>& numbers) const {
    std::size_t count = 0;
    for (std::string_view word; !(word = take_word(line)).empty(); ++count) {
      const auto number = parse_number(word);
      if (!number) wrong(fmt::format("expected {}, got {}", number_wanted(word), in_quotes(word)));
      if (count < most) numbers.at(count) = *number;
    }
    return count;
  }

  void read_face(std::string_view line) {
    corners_.clear();
    corner_normals_.clear();
    for (std::string_view word; !(word = take_word(line)).empty();)
      read_corner(word);
    if (corners_.size() < 3)
      wrong(fmt::format("a face has 3 corners or more, got {}", corners_.size()));
    if (corner_normals_.size() != corners_.size()) corner_normals_.clear();
    add_face(mesh_, corners_, lines_.line(), corner_normals_);
    if (!corner_normals_.empty()) compare_normals();
  }

  // "v", "v/vt", "v//vn" or "v/vt/vn", where vt and vn may be missing.
  void read_corner(std::string_view word) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    corners_.push_back(index(word, word.substr(0, slash), mesh_.positions.size()));
    if (slash == word.size()) return;
    const std::size_t last = std::min(word.find('/', slash + 1), word.size());
    const std::string_view texture = word.substr(slash + 1, last - slash - 1);
    if (word.find('/', last + 1) < word.size() || (!texture.empty() && !parse_integer(texture)))
      wrong(
          fmt::format("expected v, v/vt, v//vn or v/vt/vn, all numbers, got {}", in_quotes(word)));
    if (last + 1 >= word.size()) return;
    // Exporters refer to normals that they leave out.
    const auto number = parse_integer(word.substr(last + 1));
    if (!number) wrong(fmt::format("expected a normal number, got {}", in_quotes(word)));
    const auto place = place_of(*number, mesh_.normals.size());
    if (place)
      corner_normals_.push_back(*place);
    else
      ++missing_normals_;
  }

  /// Negative numbers count back from the latest.
  std::uint32_t index(std::string_view word, std::string_view number, std::size_t size) const {
    const auto index = parse_integer(number);
    if (!index) wrong(fmt::format("expected a vertex number, got {}", in_quotes(word)));
    if (*index == 0) wrong("vertex 0 is out of range: the first is 1");
    const auto place = place_of(*index, size);
    if (!place) wrong(fmt::format("vertex {} is out of range: {} stand above", *index, size));
    return *place;
  }

  /// Nothing if out of range.
  static std::optional<std::uint32_t> place_of(std::ptrdiff_t index, std::size_t size) {
    const auto count = static_cast<std::ptrdiff_t>(size);
    const std::ptrdiff_t place = index > 0 ? index - 1 : count + index;
    if (index == 0 || place < 0 || place >= count) return std::nullopt;
    return static_cast<std::uint32_t>(place);
  }

  void compare_normals() {
    glm::dvec3 area(0), normal(0);
    const glm::dvec3 first = mesh_.positions[corners_[0]];
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      area += glm::cross(mesh_.positions[corners_[i - 1]] - first,
                         mesh_.positions[corners_[i]] - first);
    }
    for (const std::uint32_t n : corner_normals_)
      normal += mesh_.normals[n];
    ++mesh_.faces_with_normals;
    if (glm::dot(area, normal) < 0) ++mesh_.faces_against;
  }

  [[noreturn]] void wrong(const std::string& message) const {
    throw Error("{}:{}: {}", name_, lines_.line(), message);
  }

  std::string name_;
  ObjLines lines_;
  int strays_ = 0;
  std::size_t missing_normals_ = 0;
  bool materials_ = false;
  std::vector<std::string> unused_;
  std::vector<std::uint32_t> corners_, corner_normals_;  ///< of the current face
  MeshFile mesh_;
};

}  // namespace

MeshFile read_obj(const std::filesystem::path& path) {
  const std::string name = path.filename().string(), text = read_file(path);
  if (is_utf16(text)) throw Error("{}:1: the file is in UTF-16, expected ASCII or UTF-8", name);
  return ObjReader(name, without_byte_order_mark(text)).read();
}

}  // namespace carlo
