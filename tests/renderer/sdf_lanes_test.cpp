// Tests where rays meet signed distance functions in lanes, on all instruction sets of this
// machine: judges hits by F alone and compares them with the SphereTracer's.

#include "geometry/sphere_tracer.h"
#include "lane_records.h"
#include "random/rng.h"
#include "renderer/lanes/lane_sdf.h"
#include "sdf_cases.h"
#include "sdf_search.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sdf_lanes_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// These follow the two headers above, which compile them anew.
#include "renderer/lanes/sphere_tracing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// A register of rays from `first` on; some of its lanes stay empty.
HWY_ATTR std::size_t add_register(const sdf_lanes::Rays& all, std::size_t first, std::size_t w,
                                  std::vector<std::size_t>& ray_of, SdfRays& rays) {
  alignas(64) std::array<std::array<float, lanes>, 7> columns{};
  alignas(64) std::array<std::uint32_t, lanes> wanted{};
  std::size_t next = first;
  for (std::size_t k = 0; k < lanes && next < all.rays.size(); ++k) {
    if (all.gap > 0 && (w * lanes + k) % (all.gap + 1) == all.gap) continue;
    const sdf_lanes::Ray& ray = all.rays[next];
    const std::array values{ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z, ray.far};
    for (std::size_t i = 0; i < values.size(); ++i)
      columns[i][k] = values[i];
    wanted[k] = 1;
    ray_of[w * lanes + k] = next++;
  }
  const auto of = [&](std::size_t i) HWY_ATTR { return hn::Load(d_, columns[i].data()); };
  const M mask =
      hn::RebindMask(d_, hn::Eq(hn::Load(du_, wanted.data()), hn::Set(du_, std::uint32_t{1})));
  rays.add({of(0), of(1), of(2)}, {of(3), of(4), of(5)}, of(6), mask, w * lanes);
  return next;
}

HWY_ATTR void trace_all(const LaneSdf& sdf, sdf_lanes::Rays& all) {
  all.s.assign(all.rays.size(), -2);
  for (std::size_t first = 0; first < all.rays.size();) {
    SdfRays rays;
    std::vector<std::size_t> ray_of(batch * lanes);
    for (std::size_t w = 0; w < batch; ++w)
      first = add_register(all, first, w, ray_of, rays);
    trace(sdf, rays);
    for (std::size_t i = 0; i < rays.count; ++i)
      all.s[ray_of[rays.lane[i]]] = rays.s[i];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {
HWY_EXPORT(trace_all);

namespace {

using carlo::Rng, carlo::Sdf, carlo::Similarity, carlo::SphereTracer;
using sdf_cases::Case, sdf_cases::Kind, sdf_cases::kinds;
using sdf_cases::Solid, sdf_cases::Ball, sdf_cases::RoundedBox;
using Vec3d = glm::dvec3;

/// Traces on the instruction set in use.
std::vector<double> traced(const renderer::LaneSdf& sdf, std::vector<sdf_lanes::Ray> rays,
                           std::size_t gap = 0) {
  sdf_lanes::Rays all{std::move(rays), {}, gap};
  HWY_DYNAMIC_DISPATCH(trace_all)(sdf, all);
  return all.s;
}

/// The verdicts of F on many rays' results.
struct Tally {
  int rays = 0, hits = 0;
  int no_root = 0, no_crossing = 0, late = 0;  // for the lanes
  int scalar_no_root = 0, scalar_late = 0;     // for the SphereTracer, where it differs
  int differ = 0, looked_less_closely = 0, open = 0;
  int cut = 0;  // searched only partly
  std::string first_fault;
};

std::string describe(const std::string& what, const sdf_lanes::Ray& r, double s, double scalar) {
  return fmt::format("{}: o {:a} {:a} {:a} d {:a} {:a} {:a} far {} s {} scalar {}", what, r.o.x,
                     r.o.y, r.o.z, r.d.x, r.d.y, r.d.z, r.far, s, scalar);
}

/// Searches evaluate F at most this often: rays along flat faces would take millions of values.
constexpr int most_values = 8000;

class Judge {
 public:
  explicit Judge(const Sdf& sdf) : sdf_(sdf), tracer_(sdf_) {}

  void operator()(const std::string& what, const std::vector<sdf_lanes::Ray>& rays,
                  const std::vector<double>& s, Tally& tally) const {
    for (std::size_t i = 0; i < rays.size(); ++i)
      judge(what, rays[i], s[i], tally);
  }

 private:
  void judge(const std::string& what, const sdf_lanes::Ray& world, double s, Tally& tally) const {
    const sdf_search::Ray ray = sdf_search::local(sdf_, tracer_, world);
    const double t = tracer_.intersect(world.o, world.d, 0, world.far);
    const double scalar = t >= 0 ? t / ray.t_per_s : -1;
    const sdf_search::Verdict lanes = sdf_search::judge(ray, s, most_values);
    ++tally.rays;
    tally.hits += s >= 0 ? 1 : 0;
    tally.no_root += lanes.root ? 0 : 1;
    tally.no_crossing += lanes.crosses ? 0 : 1;
    tally.late += lanes.first || lanes.excused ? 0 : 1;
    tally.looked_less_closely += lanes.excused ? 1 : 0;
    tally.cut += lanes.whole ? 0 : 1;
    tally.open += lanes.open ? 1 : 0;
    const bool same = lanes.open || sdf_search::same_root(ray, s, scalar);
    if (!same) {
      const sdf_search::Verdict other = sdf_search::judge(ray, scalar, most_values);
      ++tally.differ;
      tally.scalar_no_root += other.root ? 0 : 1;
      tally.scalar_late += other.first || other.excused ? 0 : 1;
    }
    const bool well = lanes.root && lanes.crosses && (lanes.first || lanes.excused) && same;
    if (!well && tally.first_fault.empty()) tally.first_fault = describe(what, world, s, scalar);
  }

  Sdf sdf_;
  SphereTracer tracer_;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases = sdf_cases::forms();
  for (Case& c : sdf_cases::combinations())
    cases.push_back(std::move(c));
  Rng rng(1);
  for (int i = 0; i < 25; ++i)
    cases.push_back(sdf_cases::random_case(rng));
  return cases;
}

std::vector<Similarity> places() {
  return {{},
          sdf_cases::turned(0.4, Vec3d(3e-5, -1e-4, 2e-4), 1e-4),
          sdf_cases::turned(0.9, 1e8 * Vec3d(0.3, -1, 0.5), 1e6),
          sdf_cases::turned(2, 1e4 * Vec3d(0.3, -1, 0.5), 1)};
}

Sdf placed(Sdf sdf, const Similarity& place) {
  sdf.place = place;
  return sdf;
}

template <class Items>
void shuffle(Items& items, Rng& rng) {
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[rng.next_u32() % i]);
}

/// This many rays of each kind, in random order.
std::vector<sdf_lanes::Ray> rays_of(const Case& c, const Similarity& place, int of_each, Rng& rng) {
  std::vector<sdf_lanes::Ray> rays;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    for (int i = 0; i < of_each; ++i)
      rays.push_back(sdf_cases::ray(c, place, static_cast<Kind>(kind), rng));
  }
  shuffle(rays, rng);
  return rays;
}

/// Moves the placement so that p lies on a point of floats.
Similarity onto_floats(Similarity place, Vec3d p) {
  const Vec3d world = place(p);
  place.origin += Vec3d(carlo::Vec3(world)) - world;
  return place;
}

/// Rays from there, out and in, half of them at slopes down to 1e-6.
std::vector<sdf_lanes::Ray> rays_from(const Case& c, const Similarity& place, Vec3d p, Rng& rng) {
  std::vector<sdf_lanes::Ray> rays;
  const Vec3d n = sdf_cases::normal(c.sdf, p);
  for (int i = 0; i < 24; ++i) {
    const Vec3d grazing = sdf_cases::tangent(n, rng) + sdf_cases::of_any_size(rng, -6, -1) * n;
    const Vec3d d = i % 2 == 0 ? sdf_cases::random_direction(rng) : glm::normalize(grazing);
    rays.push_back(sdf_cases::to_world(place, p, d));
  }
  return rays;
}

/// A ray from outside through an edge of a box that cuts off at most this much of each of the
/// faces.
sdf_lanes::Ray ray_through_edge(Vec3d half, double most, Rng& rng) {
  const int axis = static_cast<int>(rng.next_u32() % 3);
  Vec3d in = half, out = half;
  in[axis] *= 2 * rng.uniform() - 1;
  out[axis] = in[axis] + most * (2 * rng.uniform() - 1);
  in[(axis + 1) % 3] -= most * rng.uniform();
  out[(axis + 2) % 3] -= most * rng.uniform();
  const Vec3d d = glm::normalize(out - in);
  return sdf_cases::to_world({}, in - (0.1 + 2 * rng.uniform()) * d, d);
}

/// Results compared with such spans; `near` counts spans that are too short or too near the
/// surface.
struct Matches {
  int hits = 0, missed = 0, wrong = 0, invented = 0, near = 0;

  void add(const sdf_search::Ray& ray, sdf_search::Span inside, double s) {
    const bool starts_inside = inside.begin <= 0 && inside.end > 0;
    const double first = starts_inside ? inside.end : inside.begin;
    const bool meets = inside.begin < inside.end && first > 0 && first < ray.end;
    hits += s >= 0 ? 1 : 0;
    if (meets && s >= 0) {
      // As exact along the ray as its slope there allows.
      const bool same = std::abs(ray.at(s)) <= 2 * ray.fine && std::abs(s - first) <= ray.least;
      wrong += same ? 0 : 1;
    } else if (meets != (s >= 0)) {
      const double from = std::max(inside.begin, 0.0), to = std::min(inside.end, ray.end);
      // In the plane of a face F is 0 up to rounding.
      const bool clear = to - from > ray.least && ray.at(0.5 * (from + to)) < -2 * ray.fine;
      ++(!clear ? near : meets ? missed : invented);
    }
  }
};

/// `open`: the fraction of the rays whose hit may be ambiguous.
void check(const Tally& tally, double open) {
  INFO(tally.first_fault);
  CHECK(tally.no_root == 0);
  CHECK(tally.no_crossing == 0);
  CHECK(tally.late == 0);
  CHECK(tally.scalar_no_root == 0);
  CHECK(tally.scalar_late == 0);
  // Both may miss a span shorter than the least step, but only few rays meet one.
  CHECK(tally.differ <= tally.rays / 1000);
  CHECK(tally.looked_less_closely <= tally.rays / 1000);
  CHECK(tally.open <= open * tally.rays);
  CHECK(tally.cut <= tally.rays / 20);
  CHECK(tally.hits >= tally.rays / 3);
}

}  // namespace

TEST_CASE("Lanes find the first roots of sdfs along rays, as far as steps are promised to be") {
  Rng rng(2);
  Tally tally;
  for (const Case& c : all_cases()) {
    for (const Similarity& place : places()) {
      for (const double factor : {1.0, 1e-4, 1e6}) {  // of the sdf's own coordinates
        const Sdf sdf = sdf_cases::grown(placed(c.sdf, place), factor);
        const std::vector<sdf_lanes::Ray> rays = rays_of(c, place, 2, rng);
        Judge{sdf}(c.name, rays, traced(renderer::lane_sdf(sdf), rays), tally);
      }
    }
  }
  check(tally, 0.002);
}

TEST_CASE("Rays in lanes that start on an sdf, to double's precision, do not meet it there") {
  Rng rng(3);
  Tally tally;
  for (const Case& c : all_cases()) {
    for (const Similarity& about : places()) {
      for (int i = 0; i < 2; ++i) {
        const Vec3d p = sdf_cases::surface_point(c, rng);
        const Similarity place = onto_floats(about, p);
        const Sdf sdf = placed(c.sdf, place);
        const std::vector<sdf_lanes::Ray> rays = rays_from(c, place, p, rng);
        Judge{sdf}(c.name, rays, traced(renderer::lane_sdf(sdf), rays), tally);
      }
    }
  }
  // At a slope of 1e-6 even a ball's other side is only twice the least step away.
  check(tally, 0.06);
}

// The side on which rounding puts a ray's start is also used in the closed form.
TEST_CASE("Lanes meet a ball and a box where closed forms say") {
  Rng rng(5);
  for (const Similarity& place : places()) {
    for (const bool box : {false, true}) {
      const Vec3d half(0.5, 0.75, 0.375);
      const Case c{"", {{Solid{Ball{0.75}, {}}}, {}, false}};
      const Case b{"", {{Solid{RoundedBox{half, 0}, {}}}, {}, false}};
      const Sdf sdf = placed(box ? b.sdf : c.sdf, place);
      const std::vector<sdf_lanes::Ray> rays = rays_of(box ? b : c, place, 500, rng);
      const std::vector<double> s = traced(renderer::lane_sdf(sdf), rays);
      const SphereTracer tracer(sdf);
      Matches matches;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const sdf_search::Ray ray = sdf_search::local(sdf, tracer, rays[i]);
        matches.add(ray,
                    box ? sdf_search::through_box(ray, half) : sdf_search::through_ball(ray, 0.75),
                    s[i]);
      }
      INFO((box ? "box" : "ball") << ", scale " << place.scale);
      CHECK(matches.missed == 0);
      CHECK(matches.wrong == 0);
      CHECK(matches.invented == 0);
      CHECK(matches.near <= 4500 / 20);
      CHECK(matches.hits >= 2000);
    }
  }
}

// Rounding to floats changes how much they cut off; sdf_search::through_box() takes account of it.
TEST_CASE("Lanes meet edges of which rays cut off a few least steps") {
  Rng rng(6);
  const Vec3d half(0.5, 0.75, 0.375);
  const Sdf sdf{{Solid{RoundedBox{half, 0}, {}}}, {}, false};
  const SphereTracer tracer(sdf);
  std::vector<sdf_lanes::Ray> rays;
  for (int i = 0; i < 100000; ++i)
    rays.push_back(ray_through_edge(half, 4 * SphereTracer::least_step * tracer.size(), rng));
  const std::vector<double> s = traced(renderer::lane_sdf(sdf), rays);
  int longer = 0, missed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const sdf_search::Ray ray = sdf_search::local(sdf, tracer, rays[i]);
    const sdf_search::Span inside = sdf_search::through_box(ray, half);
    const double length = inside.end - inside.begin;
    // Where a ray almost lies in a face, its least step may have grown.
    const bool clear = ray.at(inside.begin + 0.5 * length) < -0.1 * length;
    if (!clear || length <= ray.least) continue;
    ++longer;
    missed += s[i] < 0 ? 1 : 0;
  }
  CHECK(longer >= 20000);
  CHECK(missed == 0);
}

TEST_CASE("Rays meet sdfs in lanes alike in any company and on all instruction sets") {
  Rng rng(4);
  int differ = 0, differ_in_order = 0, differ_with_gaps = 0, differ_alone = 0;
  for (const Case& c : all_cases()) {
    const Similarity place = places()[rng.next_u32() % 4];
    const renderer::LaneSdf sdf = renderer::lane_sdf(placed(c.sdf, place));
    const std::vector<sdf_lanes::Ray> rays = rays_of(c, place, 30, rng);
    std::vector<std::size_t> order(rays.size());
    std::iota(order.begin(), order.end(), 0);
    shuffle(order, rng);
    std::vector<sdf_lanes::Ray> shuffled;
    for (const std::size_t i : order)
      shuffled.push_back(rays[i]);
    const std::vector<double> first = traced(sdf, rays);
    instruction_sets::on_all([&] {
      const std::vector<double> again = traced(sdf, rays), in_order = traced(sdf, shuffled),
                                with_gaps = traced(sdf, rays, 2);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        differ += again[i] == first[i] ? 0 : 1;
        differ_in_order += in_order[i] == first[order[i]] ? 0 : 1;
        differ_with_gaps += with_gaps[i] == first[i] ? 0 : 1;
        if (i % 10 == 0) differ_alone += traced(sdf, {rays[i]})[0] == first[i] ? 0 : 1;
      }
    });
  }
  CHECK(differ == 0);
  CHECK(differ_in_order == 0);
  CHECK(differ_with_gaps == 0);
  CHECK(differ_alone == 0);
}

}  // namespace renderer
#endif
