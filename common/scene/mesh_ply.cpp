#include "cli/atomic_file.h"
#include "cli/error.h"
#include "scene/mesh_file.h"
#include "scene/ply_header.h"
#include "scene/text.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace carlo {
namespace {

static_assert(std::endian::native == std::endian::little,
              "binary PLY is read as it lies in memory");

// The numbers after the header, one after the other, text or binary.
class PlyData {
 public:
  PlyData(std::string_view data, bool binary, const std::string& name)
      : data_(data), binary_(binary), name_(name) {}

  double next(PlyType type) { return binary_ ? next_binary(type) : next_word(); }

  bool at_end() {
    if (!binary_) skip_space();
    return data_.empty();
  }

  [[noreturn]] void wrong(const std::string& message) const {
    throw Error("{}: {}", name_, message);
  }

 private:
  template <class T>
  double take() {
    if (data_.size() < sizeof(T)) wrong("the file ends too early");
    T value;
    std::memcpy(&value, data_.data(), sizeof(T));
    data_.remove_prefix(sizeof(T));
    return static_cast<double>(value);
  }

  double next_binary(PlyType type) {
    switch (type) {
      case PlyType::i8:
        return take<std::int8_t>();
      case PlyType::u8:
        return take<std::uint8_t>();
      case PlyType::i16:
        return take<std::int16_t>();
      case PlyType::u16:
        return take<std::uint16_t>();
      case PlyType::i32:
        return take<std::int32_t>();
      case PlyType::u32:
        return take<std::uint32_t>();
      case PlyType::f32:
        return take<float>();
      case PlyType::f64:
        return take<double>();
    }
    return 0;
  }

  double next_word() {
    skip_space();
    if (data_.empty()) wrong("the file ends too early");
    const std::string_view word = data_.substr(0, data_.find_first_of(" \t\r\n"));
    const auto number = parse_number(word);
    if (!number) wrong(fmt::format("expected a finite number, got {}", in_quotes(word)));
    data_.remove_prefix(word.size());
    return *number;
  }

  void skip_space() {
    data_.remove_prefix(std::min(data_.find_first_not_of(" \t\r\n"), data_.size()));
  }

  std::string_view data_;
  bool binary_;
  const std::string& name_;
};

class PlyReader {
 public:
  PlyReader(std::string_view text, const std::string& name)
      : name_(name),
        header_(parse_ply_header(text, name)),
        data_(text.substr(header_.size), header_.binary, name) {}

  MeshFile read() {
    check_header();
    for (const PlyElement& element : header_.elements) {
      if (element.count > 0 && element.properties.empty()) {
        data_.wrong(fmt::format("element {} has no properties", in_quotes(element.name)));
      }
      for (std::size_t i = 0; i < element.count; ++i)
        read_item(element);
    }
    if (!data_.at_end()) data_.wrong("there is more data than the header announces");
    check_indices();
    return std::move(mesh_);
  }

 private:
  static int coordinate(const PlyProperty& p) {
    if (p.list || p.name.size() != 1 || p.name < "x" || p.name > "z") return -1;
    return p.name[0] - 'x';
  }

  static bool is_corner_list(const PlyProperty& p) {
    return p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
  }

  void check_header() {
    int coordinates = 0, corner_lists = 0;
    for (const PlyElement& element : header_.elements) {
      for (const PlyProperty& p : element.properties) {
        if (element.name == "vertex" && coordinate(p) >= 0) {
          ++coordinates;
        } else if (element.name == "face" && is_corner_list(p)) {
          if (!is_integer(p.type)) data_.wrong("vertex indices must be of an integer type");
          ++corner_lists;
        } else if (element.name == "vertex" && p.name == "nx") {
          mesh_.vertex_normals = true;
        } else if (p.name != "ny" && p.name != "nz") {
          mesh_.notes.push_back(
              fmt::format("{}: {}'s {} is not used", name_, element.name, in_quotes(p.name)));
        }
      }
    }
    if (coordinates != 3) data_.wrong("expected the vertex properties x, y, z once each");
    if (corner_lists != 1) data_.wrong("expected one face property vertex_indices");
  }

  void read_item(const PlyElement& element) {
    glm::dvec3 position{0};
    for (const PlyProperty& p : element.properties) {
      if (element.name == "vertex" && coordinate(p) >= 0) {
        position[coordinate(p)] = data_.next(p.type);
      } else if (element.name == "face" && is_corner_list(p)) {
        read_face(p);
      } else {
        const std::size_t length = p.list ? read_length(p) : 1;
        for (std::size_t i = 0; i < length; ++i)
          data_.next(p.type);
      }
    }
    if (element.name == "vertex") add_vertex(position);
  }

  void add_vertex(glm::dvec3 position) {
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(position[i]) <= static_cast<double>(std::numeric_limits<float>::max()))) {
        data_.wrong(fmt::format("vertex {} is not finite", mesh_.positions.size()));
      }
    }
    mesh_.positions.push_back(position);
  }

  void read_face(const PlyProperty& p) {
    const std::size_t length = read_length(p);
    if (length < 3) data_.wrong(fmt::format("a face has 3 corners or more, got {}", length));
    corners_.clear();
    for (std::size_t i = 0; i < length; ++i)
      corners_.push_back(whole(data_.next(p.type)));
    add_polygon(mesh_, corners_);
  }

  std::size_t read_length(const PlyProperty& p) { return whole(data_.next(p.count_type)); }

  std::uint32_t whole(double x) const {
    if (!(x >= 0 && x <= std::numeric_limits<std::uint32_t>::max()) || x != std::floor(x)) {
      data_.wrong(fmt::format("expected a count or an index, got {}", x));
    }
    return static_cast<std::uint32_t>(x);
  }

  void check_indices() const {
    const std::size_t count = mesh_.positions.size();
    for (const glm::uvec3& t : mesh_.triangles) {
      const std::uint32_t largest = std::max({t.x, t.y, t.z});
      if (largest < count) continue;
      data_.wrong(fmt::format("vertex {} is out of range: there are {}", largest, count));
    }
  }

  const std::string& name_;
  PlyHeader header_;
  PlyData data_;
  MeshFile mesh_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

MeshFile read_ply(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const std::string text = read_file(path);
  return PlyReader(text, name).read();
}

}  // namespace carlo
