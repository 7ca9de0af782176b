#include "scene/duplicates.h"
#include "scene/needs.h"
#include "scene/repeats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <variant>

namespace carlo {
namespace {

/// True if corner(0), ... corner(count - 1) of one are those of the other, up to rotation.
template <class A, class B>
bool same_around(std::size_t count, const A& a, const B& b) {
  for (std::size_t start = 0; start < count; ++start) {
    std::size_t i = 0;
    while (i < count && a(i) == b(start + i < count ? start + i : start + i - count))
      ++i;
    if (i == count) return true;
  }
  return false;
}

class DuplicateFaces {
 public:
  DuplicateFaces(const MeshFile& file, const std::vector<Vec3>& positions,
                 const std::vector<char>& turned, std::vector<char>& left_out)
      : file_(file), positions_(positions), turned_(turned), left_out_(left_out) {
    keys_.reserve(positions.size());
    for (const Vec3 p : positions)
      keys_.push_back(key_of(p));
  }

  CoincidentFaces find() {
    std::vector<std::uint64_t> keys;
    keys.reserve(file_.polygons.size());
    for (const Polygon& p : file_.polygons)
      keys.push_back(key(corners_of(p)));
    CoincidentFaces found;
    found.back_to_back = back_to_back(keys);
    // A polygon that starts at another corner has the same corners but other triangles.
    found.duplicates = mark_polygons(keys);
    found.duplicates += mark_triangles();
    return found;
  }

 private:
  /// `reversed`: the corners of one run the other way around.
  bool same(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b,
            bool reversed) const {
    return a.size() == b.size() &&
           same_around(
               a.size(), [&](std::size_t i) { return positions_[a[i]]; },
               [&](std::size_t i) { return positions_[b[reversed ? b.size() - 1 - i : i]]; });
  }

  /// Whether the triangles of a polygon are turned over; nothing if only some are.
  std::optional<bool> turned(const Polygon& p) const {
    const std::size_t triangles = p.corners - 2;
    const auto first = turned_.begin() + static_cast<std::ptrdiff_t>(p.first_triangle);
    const auto count = static_cast<std::size_t>(
        std::count(first, first + static_cast<std::ptrdiff_t>(triangles), char{1}));
    if (count != 0 && count != triangles) return std::nullopt;
    return count != 0;
  }

  std::uint64_t key(std::span<const std::uint32_t> corners) const {
    std::uint64_t sum = 0;
    for (const std::uint32_t corner : corners)
      sum += keys_[corner];
    return spread(sum);
  }

  std::span<const std::uint32_t> corners_of(const Polygon& p) const {
    return std::span(file_.polygon_corners).subspan(p.first_corner, p.corners);
  }

  /// True if two polygons have the same corners and face the same way, or opposite ways.
  bool coincide(std::size_t i, std::size_t k, bool opposite) const {
    const Polygon &a = file_.polygons[i], &b = file_.polygons[k];
    const auto one = turned(a), other = turned(b);
    return one && other && same(corners_of(a), corners_of(b), (*one != *other) != opposite);
  }

  static void mark(const Polygon& p, std::vector<char>& triangles) {
    std::fill_n(triangles.begin() + static_cast<std::ptrdiff_t>(p.first_triangle), p.corners - 2,
                char{1});
  }

  std::vector<char> back_to_back(const std::vector<std::uint64_t>& keys) const {
    std::vector<char> marked(file_.triangles.size());
    find_repeats(
        keys, [&](std::size_t i, std::size_t k) { return coincide(i, k, /*opposite=*/true); },
        [&](std::size_t i, std::size_t k) {
          mark(file_.polygons[i], marked);
          mark(file_.polygons[k], marked);
        });
    return marked;
  }

  std::size_t mark_polygons(const std::vector<std::uint64_t>& keys) {
    std::size_t count = 0;
    find_repeats(
        keys, [&](std::size_t i, std::size_t k) { return coincide(i, k, /*opposite=*/false); },
        [&](std::size_t i, std::size_t) {
          mark(file_.polygons[i], left_out_);
          ++count;
        });
    return count;
  }

  std::size_t mark_triangles() {
    const auto corners = [&](std::size_t i) { return std::span(&file_.triangles[i].x, 3); };
    std::vector<std::uint64_t> keys;
    keys.reserve(file_.triangles.size());
    // Triangles that are left out already have no duplicates.
    for (std::size_t i = 0; i < file_.triangles.size(); ++i)
      keys.push_back(left_out_[i] == 0 ? key(corners(i)) : spread(i));
    std::size_t count = 0;
    find_repeats(
        keys,
        [&](std::size_t i, std::size_t k) {
          return left_out_[i] == 0 && left_out_[k] == 0 &&
                 same(corners(i), corners(k), turned_[i] != turned_[k]);
        },
        [&](std::size_t i, std::size_t) {
          left_out_[i] = 1;
          ++count;
        });
    return count;
  }

  const MeshFile& file_;
  const std::vector<Vec3>& positions_;
  const std::vector<char>& turned_;
  std::vector<char>& left_out_;
  std::vector<std::uint64_t> keys_;  ///< of the positions
};

}  // namespace

std::uint64_t key_of(Vec3 p) {
  std::uint64_t key = 0;
  // Zero has two signs.
  for (const float x : {p.x, p.y, p.z})
    key = spread(key + 0x9e3779b97f4a7c15 + std::bit_cast<std::uint32_t>(x + 0.0f));
  return key;
}

bool same_triangle(const Triangle& a, const Triangle& b) {
  return same_around(
      3, [&](std::size_t i) { return a.at(i); }, [&](std::size_t i) { return b.at(i); });
}

CoincidentFaces find_coincident_faces(const MeshFile& file, const std::vector<Vec3>& positions,
                                      const std::vector<char>& turned,
                                      std::vector<char>& left_out) {
  return DuplicateFaces(file, positions, turned, left_out).find();
}

void mark_back_to_back(Scene& scene) {
  struct Face {
    Mesh* mesh;
    std::size_t triangle;
    Triangle corners() const {
      const glm::uvec3 t = mesh->triangles[triangle];
      return {mesh->positions[t.x], mesh->positions[t.y], mesh->positions[t.z]};
    }
  };
  std::vector<Face> faces;
  std::vector<std::uint64_t> keys;
  for (Shape& shape : scene.shapes) {
    auto* mesh = std::get_if<Mesh>(&shape.geometry);
    if (mesh == nullptr) continue;
    if (passes_light(scene.materials.at(shape.material))) {
      mesh->back_to_back.clear();
      continue;
    }
    std::vector<std::uint64_t> corners;
    corners.reserve(mesh->positions.size());
    for (const Vec3 p : mesh->positions)
      corners.push_back(key_of(p));
    for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
      const glm::uvec3 t = mesh->triangles[i];
      faces.push_back({mesh, i});
      keys.push_back(spread(corners[t.x] + corners[t.y] + corners[t.z]));
    }
  }
  // Triangles of several files may lie on one: if any two face opposite ways, all are marked.
  std::vector<std::pair<std::size_t, std::size_t>> coincident;  // with the first of each place
  std::set<std::size_t> both_ways;                              // such firsts
  const auto opposite = [&](std::size_t i, std::size_t k) {
    const auto [a, b, c] = faces[k].corners();
    return same_triangle(faces[i].corners(), {c, b, a});
  };
  find_repeats(
      keys,
      [&](std::size_t i, std::size_t k) {
        return same_triangle(faces[i].corners(), faces[k].corners()) || opposite(i, k);
      },
      [&](std::size_t later, std::size_t first) {
        coincident.emplace_back(first, later);
        if (opposite(later, first)) both_ways.insert(first);
      });
  for (const auto& [first, later] : coincident) {
    if (both_ways.count(first) == 0) continue;
    for (const std::size_t i : {first, later}) {
      const Face& face = faces[i];
      face.mesh->back_to_back.resize(face.mesh->triangles.size());
      face.mesh->back_to_back[face.triangle] = 1;
    }
  }
}

}  // namespace carlo
