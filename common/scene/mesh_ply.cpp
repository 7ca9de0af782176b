#include "scene/mesh_file.h"
#include "scene/ply_data.h"
#include "scene/text.h"
#include "support/atomic_file.h"
#include "support/byte_order_mark.h"
#include "support/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace carlo {
namespace {

/// How a property's values are used.
enum class Use { none, x, y, z, nx, ny, nz, face, strip };

Use use_of(const PlyElement& element, const PlyProperty& p) {
  if (p.list) {
    const bool corners = p.name == "vertex_indices" || p.name == "vertex_index";
    if (!corners) return Use::none;
    return element.name == "face"        ? Use::face
           : element.name == "tristrips" ? Use::strip
                                         : Use::none;
  }
  if (element.name != "vertex") return Use::none;
  constexpr std::array<std::string_view, 6> names = {"x", "y", "z", "nx", "ny", "nz"};
  const auto found = std::find(names.begin(), names.end(), p.name);
  if (found == names.end()) return Use::none;
  return static_cast<Use>(static_cast<int>(Use::x) + (found - names.begin()));
}

// Used instead of Assimp, the only reader in Debian 12: version 5.2.5 silently reads a file that
// ends too early and only one triangle of each strip; it crashes on a count below 0 and takes
// minutes for one larger than the file.
class PlyReader {
 public:
  PlyReader(std::string_view text, const std::string& name)
      : name_(name), header_(parse_ply_header(text, name)), data_(text, header_, name) {
    for (const PlyElement& element : header_.elements)
      vertices_ += element.name == "vertex" ? element.count : 0;
  }

  MeshFile read() {
    check_header();
    for (const PlyElement& element : header_.elements) {
      if (element.count > 0 && element.properties.empty())
        wrong(fmt::format("element {} has no properties", in_quotes(element.name)));
      std::vector<Use> uses;
      for (const PlyProperty& p : element.properties)
        uses.push_back(use_of(element, p));
      for (std::size_t i = 0; i < element.count; ++i)
        read_item(element, uses);
    }
    if (const auto note = data_.finish()) mesh_.notes.push_back(*note);
    // In a binary file the places of faces are their numbers.
    cut_polygons(mesh_, name_, data_.has_lines() ? ":" : ": face ");
    if (has_normals_) {
      compare_normals();
      mesh_.normals_of = mesh_.triangles;
    }
    return std::move(mesh_);
  }

 private:
  void check_header() {
    std::array<int, 9> count{};
    for (const PlyElement& element : header_.elements) {
      for (const PlyProperty& p : element.properties) {
        const Use use = use_of(element, p);
        ++count.at(static_cast<std::size_t>(use));
        if ((use == Use::face || use == Use::strip) && !is_integer(p.type))
          wrong("vertex indices must be of an integer type");
        const bool part_of_normal = p.name == "nx" || p.name == "ny" || p.name == "nz";
        if (use == Use::none && !part_of_normal) {
          mesh_.notes.push_back(
              fmt::format("{}: {}'s {} is not used", name_, element.name, in_quotes(p.name)));
        }
      }
    }
    const auto number_of = [&count](Use use) { return count.at(static_cast<std::size_t>(use)); };
    if (number_of(Use::x) != 1 || number_of(Use::y) != 1 || number_of(Use::z) != 1)
      wrong("expected the vertex properties x, y, z once each");
    if (number_of(Use::face) > 1 || number_of(Use::strip) > 1 ||
        number_of(Use::face) + number_of(Use::strip) == 0) {
      wrong(
          "expected one list vertex_indices of the element face (or tristrips, for strips of "
          "triangles)");
    }
    const int components = number_of(Use::nx) + number_of(Use::ny) + number_of(Use::nz);
    has_normals_ = components == 3 && number_of(Use::nx) * number_of(Use::ny) == 1;
    if (components > 0 && !has_normals_)
      mesh_.notes.push_back(fmt::format("{}: incomplete vertex normals are not used", name_));
  }

  void read_item(const PlyElement& element, const std::vector<Use>& uses) {
    glm::dvec3 position(0), normal(0);
    for (std::size_t i = 0; i < uses.size(); ++i) {
      const PlyProperty& p = element.properties[i];
      const Use use = uses[i];
      if (use == Use::none) {
        data_.skip(p);
      } else if (use <= Use::z) {
        position[static_cast<int>(use) - static_cast<int>(Use::x)] = data_.number(p, p.type);
      } else if (use <= Use::nz) {
        normal[static_cast<int>(use) - static_cast<int>(Use::nx)] = data_.any_number(p);
      } else if (use == Use::face) {
        read_face(p);
      } else {
        read_strip(p);
      }
    }
    if (element.name != "vertex") return;
    add_vertex(position);
    if (has_normals_) mesh_.normals.push_back(normal);
  }

  void add_vertex(glm::dvec3 position) {
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(position[i]) <= static_cast<double>(std::numeric_limits<float>::max())))
        data_.wrong(fmt::format("vertex {} is not finite", mesh_.positions.size()));
    }
    mesh_.positions.push_back(position);
  }

  void read_face(const PlyProperty& p) {
    const std::size_t length = data_.whole(p, p.count_type);
    if (length < 3) data_.wrong(fmt::format("a face has 3 corners or more, got {}", length));
    corners_.clear();
    for (std::size_t i = 0; i < length; ++i)
      corners_.push_back(checked(data_.whole(p, p.type)));
    ++faces_;
    add_face(mesh_, corners_, data_.has_lines() ? data_.line() : faces_);
  }

  /// Each corner from the third on makes a triangle with the two before it, with alternating
  /// orientation.
  void read_strip(const PlyProperty& p) {
    const std::size_t length = data_.whole(p, p.count_type);
    std::array<std::uint32_t, 3> last{};
    std::size_t corners = 0;
    for (std::size_t i = 0; i < length; ++i) {
      const std::optional<std::uint32_t> corner = data_.whole_or_end(p);
      if (!corner) {
        corners = 0;
        continue;
      }
      last = {last[1], last[2], checked(*corner)};
      if (++corners < 3) continue;
      if (corners % 2 == 0) {
        mesh_.triangles.emplace_back(last[1], last[0], last[2]);
      } else {
        mesh_.triangles.emplace_back(last[0], last[1], last[2]);
      }
    }
  }

  /// Faces may stand before the vertices: the header says how many there will be.
  std::uint32_t checked(std::uint32_t corner) const {
    if (corner >= vertices_)
      data_.wrong(fmt::format("vertex {} is out of range: there are {}", corner, vertices_));
    return corner;
  }

  void compare_normals() {
    for_each_face(mesh_, [&](std::span<const std::uint32_t> corners, std::size_t first,
                             std::size_t triangles) {
      glm::dvec3 area(0), normal(0);
      for (std::size_t i = first; i < first + triangles; ++i) {
        const glm::uvec3 t = mesh_.triangles[i];
        area += glm::cross(mesh_.positions[t.y] - mesh_.positions[t.x],
                           mesh_.positions[t.z] - mesh_.positions[t.x]);
      }
      for (const std::uint32_t corner : corners)
        normal += mesh_.normals[corner];
      ++mesh_.faces_with_normals;
      if (glm::dot(area, normal) < 0) ++mesh_.faces_against;
    });
  }

  /// For errors that belong to no line.
  [[noreturn]] void wrong(const std::string& message) const {
    throw Error("{}: {}", name_, message);
  }

  const std::string& name_;
  PlyHeader header_;
  PlyData data_;
  MeshFile mesh_;
  std::size_t vertices_ = 0, faces_ = 0;
  bool has_normals_ = false;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

MeshFile read_ply(const std::filesystem::path& path) {
  const std::string name = path.filename().string(), text = read_file(path);
  if (is_utf16(text)) throw Error("{}:1: the file is in UTF-16, expected PLY", name);
  return PlyReader(without_byte_order_mark(text), name).read();
}

}  // namespace carlo
