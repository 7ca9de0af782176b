#include "scene/duplicate_faces.h"

#include "scene/repeats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

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
                 std::vector<char>& left_out)
      : file_(file), positions_(positions), left_out_(left_out) {
    keys_.reserve(positions.size());
    for (const Vec3 p : positions)
      keys_.push_back(key_of(p));
  }

  std::size_t mark() {
    // A polygon that starts at another corner has the same corners but other triangles.
    const std::size_t polygons = mark_polygons();
    return polygons + mark_triangles();
  }

 private:
  bool same(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) const {
    return a.size() == b.size() && same_around(
                                       a.size(), [&](std::size_t i) { return positions_[a[i]]; },
                                       [&](std::size_t i) { return positions_[b[i]]; });
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

  std::size_t mark_polygons() {
    std::vector<std::uint64_t> keys;
    keys.reserve(file_.polygons.size());
    for (const Polygon& p : file_.polygons)
      keys.push_back(key(corners_of(p)));
    std::size_t count = 0;
    find_repeats(
        keys,
        [&](std::size_t i, std::size_t k) {
          return same(corners_of(file_.polygons[i]), corners_of(file_.polygons[k]));
        },
        [&](std::size_t i, std::size_t) {
          const Polygon& p = file_.polygons[i];
          std::fill_n(left_out_.begin() + static_cast<std::ptrdiff_t>(p.first_triangle),
                      p.corners - 2, char{1});
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
          return left_out_[i] == 0 && left_out_[k] == 0 && same(corners(i), corners(k));
        },
        [&](std::size_t i, std::size_t) {
          left_out_[i] = 1;
          ++count;
        });
    return count;
  }

  const MeshFile& file_;
  const std::vector<Vec3>& positions_;
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

std::size_t mark_duplicate_faces(const MeshFile& file, const std::vector<Vec3>& positions,
                                 std::vector<char>& left_out) {
  return DuplicateFaces(file, positions, left_out).mark();
}

}  // namespace carlo
