// Hierarchies of shapes in lanes, on all instruction sets of this machine: rays find in a tree what
// they find when they try each shape, to the last bit.

#include "lane_records.h"
#include "random/rng.h"
#include "renderer/lanes/lane_plan.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree_lanes_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// These follow the two headers above, which compile them anew.
#include "renderer/lanes/intersect-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

struct Register {
  Origins from;
  V3 d;
  V length;
};
HWY_ATTR Register load(const TriedRay* rays) {
  std::array<std::array<float, lanes>, 10> column;
  std::array<std::array<std::uint32_t, lanes>, 2> word;
  for (std::size_t i = 0; i < lanes; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      column[k][i] = rays[i].o[k];
      column[3 + k][i] = rays[i].d[k];
      column[6 + k][i] = rays[i].arrival[k];
    }
    column[9][i] = rays[i].length, word[0][i] = rays[i].last, word[1][i] = rays[i].plane;
  }
  const auto at = [&](std::size_t k) HWY_ATTR { return hn::LoadU(d_, column[k].data()); };
  const V3 o{at(0), at(1), at(2)};
  return {{o,
           {at(6), at(7), at(8)},
           hn::LoadU(du_, word[0].data()),
           hn::LoadU(du_, word[1].data()),
           hn::FirstN(d_, 0),
           o},
          {at(3), at(4), at(5)},
          at(9)};
}

HWY_ATTR void store(const Hits& hits, M clear, TriedRay* rays) {
  std::array<float, lanes> t;
  std::array<std::uint32_t, lanes> surface;
  hn::StoreU(hits.t, d_, t.data()), hn::StoreU(hits.surface, du_, surface.data());
  for (std::size_t i = 0; i < lanes; ++i) {
    rays[i].t = t[i], rays[i].surface = surface[i];
    rays[i].blocked = (bits(clear) >> i & 1) != 0 ? 0 : 1;
  }
}

/// Tries each shape in the order of the numbers.
HWY_ATTR void try_all(const LaneScene& s, const Register& r, const Segments& segments, Hits& hits,
                      M& clear) {
  const V of_origin = coordinates(r.from.o);
  for (std::uint32_t i = s.first_quad; i < s.first_disk; ++i) {
    intersect_flat<true, Outline::quad>(s, i, r.from, r.d, of_origin, hits);
    clear = hn::AndNot(flat_occludes<true, Outline::quad>(s, i, segments, of_origin), clear);
  }
  for (std::uint32_t i = s.first_disk; i < s.first_sphere; ++i) {
    intersect_flat<true, Outline::disk>(s, i, r.from, r.d, of_origin, hits);
    clear = hn::AndNot(flat_occludes<true, Outline::disk>(s, i, segments, of_origin), clear);
  }
  for (std::uint32_t i = s.first_sphere; i < s.first_sdf; ++i) {
    intersect_sphere<true>(s, i, r.from, r.d, of_origin, hits);
    clear = hn::AndNot(sphere_occludes<true>(s, i, segments), clear);
  }
}

/// The number of rays is a multiple of every number of lanes.
HWY_ATTR void find_both(const LaneScene& s, Found& found) {
  for (std::size_t i = 0; i < found.by_tree.size(); i += lanes) {
    const Register r = load(&found.by_tree[i]);
    // Lanes without a ray hold numbers that are none.
    const M wanted = hn::Eq(r.d.x, r.d.x);
    const Segments segments{r.from, r.d, add_scaled(r.from.o, r.length, r.d), r.length,
                            set_word(nothing)};
    store(closest<true, true>(s, r.from, r.d, wanted), unoccluded<true, true>(s, segments, wanted),
          &found.by_tree[i]);
    Hits hits{set(longest), set_word(nothing)};
    M clear = wanted;
    try_all(s, r, segments, hits, clear);
    store(hits, clear, &found.by_all[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {
HWY_EXPORT(find_both);

namespace {

using carlo::Rgb;
using carlo::Rng;
using carlo::Vec3;

float between(Rng& rng, float low, float high) {
  return low + (high - low) * static_cast<float>(rng.uniform());
}
Vec3 in_cube(Rng& rng) {
  const float x = between(rng, -1, 1), y = between(rng, -1, 1);
  return {x, y, between(rng, -1, 1)};
}

/// How shapes lie: anywhere, in one plane, in a row, around one place, or over many scales.
enum class Arrangement { cloud, plane, row, heap, scales };

carlo::Scene shapes(Arrangement arrangement, std::size_t count, Vec3 at, float scale) {
  Rng rng(count, static_cast<std::uint64_t>(arrangement));
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(0.5f)}, true}};
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p = in_cube(rng);
    float size = 0.05f;
    if (arrangement == Arrangement::plane) p.y = 0;
    if (arrangement == Arrangement::row) p.y = p.z = 0;
    if (arrangement == Arrangement::heap) p *= 0.01f;
    if (arrangement == Arrangement::scales) {
      const float smaller = std::pow(10.0f, between(rng, -5, 0));
      p *= smaller, size *= smaller;
    }
    const Vec3 center = at + scale * p;
    const float half = scale * size * between(rng, 0.2f, 1);
    const Vec3 u = arrangement == Arrangement::plane ? Vec3(1, 0, 0) : in_cube(rng);
    const Vec3 v = arrangement == Arrangement::plane ? Vec3(0, 0, 1) : in_cube(rng);
    carlo::Shape shape{carlo::Sphere{center, half, i % 2 == 0}, 0, Rgb(0)};
    if (i % 3 == 0) shape.geometry = carlo::Parallelogram{center, half * u, half * v};
    if (i % 3 == 1) shape.geometry = carlo::Disk{center, glm::normalize(glm::cross(u, v)), half};
    scene.shapes.push_back(shape);
  }
  scene.camera.origin = at + scale * Vec3(0, 0, 10);
  return scene;
}

void set_vector(std::array<float, 3>& to, Vec3 from) {
  to = {from.x, from.y, from.z};
}

/// Rays from anywhere, a few at a time from one place; some along axes, some from far away, half of
/// them aimed at a shape; some lanes have none.
std::vector<TriedRay> rays(const carlo::Scene& scene, std::size_t count, Vec3 at, float scale) {
  Rng rng(7, count);
  std::vector<TriedRay> result;
  Vec3 o = at;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 12 == 0) o = at + scale * (i % 5 == 0 ? 100.0f : 1.5f) * in_cube(rng);
    const Extent target = extent_of(scene.shapes[i * 37 % scene.shapes.size()]);
    Vec3 d = i % 2 == 0 ? in_cube(rng) : Vec3(0.5 * (target.lower + target.upper)) - o;
    if (i % 7 == 0) d = Vec3(0, 0, i % 2 == 0 ? 1 : -1);
    if (i % 11 == 0) d.y = 0;
    TriedRay ray{};
    set_vector(ray.o, o), set_vector(ray.d, glm::normalize(d));
    ray.length = scale * std::pow(10.0f, between(rng, -2, 1));
    ray.last = ray.plane = 0xFFFFFFFF;
    if (i % 17 == 0) ray.d.fill(std::numeric_limits<float>::quiet_NaN());
    result.push_back(ray);
  }
  return result;
}

/// Rays that leave the surfaces that others have met, in both directions.
std::vector<TriedRay> onwards(const LaneScene& s, const std::vector<TriedRay>& before) {
  Rng rng(8, 0);
  std::vector<TriedRay> result = before;
  for (TriedRay& ray : result) {
    if (ray.surface == 0xFFFFFFFF || std::isnan(ray.d[0])) continue;
    ray.arrival = ray.d, ray.last = ray.surface, ray.plane = s.plane[ray.surface];
    for (std::size_t k = 0; k < 3; ++k)
      ray.o[k] += ray.t * ray.d[k];
    if (const std::uint32_t i = ray.surface; i >= s.first_sphere) {
      const Vec3 center(s.cx[i], s.cy[i], s.cz[i]), o(ray.o[0], ray.o[1], ray.o[2]);
      set_vector(ray.o, center + std::abs(s.radius[i]) * glm::normalize(o - center));
    }
    set_vector(ray.d, glm::normalize(in_cube(rng)));
  }
  return result;
}

Found find_in(const LaneScene& s, const std::vector<TriedRay>& rays) {
  Found found{rays, rays};
  HWY_DYNAMIC_DISPATCH(find_both)(s, found);
  return found;
}

struct Agreement {
  std::size_t hits = 0, blocked = 0, different = 0;
  explicit Agreement(const Found& found) {
    for (std::size_t i = 0; i < found.by_tree.size(); ++i) {
      const TriedRay &a = found.by_tree[i], &b = found.by_all[i];
      if (std::isnan(a.d[0])) continue;
      hits += b.surface != 0xFFFFFFFF, blocked += b.blocked;
      different += a.t != b.t || a.surface != b.surface || a.blocked != b.blocked;
    }
  }
};

}  // namespace

namespace {

struct Placement {
  Vec3 at;
  float scale;
};
const std::array placements = {Placement{Vec3(0), 1}, Placement{Vec3(0), 1e-4f},
                               Placement{{3e5f, -1e6f, 2e5f}, 1e5f}, Placement{{100, 0, -300}, 1}};

}  // namespace

TEST_CASE("Rays find in a tree of shapes what they find among all shapes") {
  constexpr std::size_t tried = 1200;
  for (const auto arrangement : {Arrangement::cloud, Arrangement::plane, Arrangement::row,
                                 Arrangement::heap, Arrangement::scales}) {
    for (const std::size_t count : {150UL, 3000UL}) {
      for (const Placement& where : placements) {
        const Vec3 at = where.at;
        const float scale = where.scale;
        const carlo::Scene of_shapes = shapes(arrangement, count, at, scale);
        const LaneScene scene(of_shapes);
        REQUIRE(scene.many);
        instruction_sets::on_all([&] {
          INFO(count << " shapes, arrangement " << static_cast<int>(arrangement) << ", scale "
                     << scale);
          const Found first = find_in(scene, rays(of_shapes, tried, at, scale));
          const Agreement from_anywhere(first);
          CHECK(from_anywhere.different == 0);
          // Otherwise the rays test nothing.
          CHECK(from_anywhere.hits > tried / 10);
          CHECK(from_anywhere.blocked > tried / 50);
          CHECK(Agreement(find_in(scene, onwards(scene, first.by_all))).different == 0);
        });
      }
    }
  }
}

TEST_CASE(
    "A tree holds each shape once, in the order of its numbers, and boxes hold their shapes") {
  Rng rng(3, 1);
  for (const std::size_t count : {0UL, 1UL, 2UL, 16UL, 17UL, 257UL, 20000UL}) {
    for (const bool in_one_place : {false, true}) {
      std::vector<Extent> extents;
      for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 p = in_one_place ? glm::dvec3(2) : glm::dvec3(in_cube(rng));
        extents.push_back({p - 0.01, p + 0.01});
      }
      std::vector<std::size_t> order;
      const LaneTree tree(extents, 5, order);
      REQUIRE(order.size() == count);
      std::uint32_t next = 5;
      std::size_t deepest = 0, outside = 0;
      const auto visit = [&](const auto& self, std::uint32_t node, std::size_t depth,
                             const std::vector<std::array<double, 6>>& around) -> void {
        deepest = std::max(deepest, depth);
        for (std::size_t c = 0; c < LaneTree::width; ++c) {
          const auto& [lower, upper, child] = tree.nodes[node];
          if (std::isinf(lower[0][c])) continue;
          auto boxes = around;
          boxes.push_back({static_cast<double>(lower[0][c]), static_cast<double>(lower[1][c]),
                           static_cast<double>(lower[2][c]), static_cast<double>(upper[0][c]),
                           static_cast<double>(upper[1][c]), static_cast<double>(upper[2][c])});
          if ((child[c] & LaneTree::leaf) == 0) {
            self(self, child[c], depth + 1, boxes);
            continue;
          }
          const auto shapes = LaneTree::Shapes::of(child[c]);
          CHECK(shapes.first == next);
          CHECK((shapes.count >= 1 && shapes.count <= LaneTree::most_shapes));
          for (; next < shapes.first + shapes.count; ++next) {
            const Extent& shape = extents[order[next - 5]];
            for (const auto& box : boxes) {
              for (std::size_t k = 0; k < 3; ++k) {
                const auto axis = static_cast<int>(k);
                outside += box[k] >= shape.lower[axis] || box[3 + k] <= shape.upper[axis];
              }
            }
          }
        }
      };
      if (count > 0) visit(visit, 0, 1, {});
      CHECK(next == 5 + count);
      CHECK(outside == 0);
      CHECK(deepest <= LaneTree::deepest);
      std::sort(order.begin(), order.end());
      for (std::size_t i = 0; i < count; ++i)
        CHECK(order[i] == i);
    }
  }
}

}  // namespace renderer
#endif
