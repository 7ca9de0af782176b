// Light paths, connected to the camera at their vertices (lane_kernel.h, LightPathJob). Included
// once for each instruction set.

#if defined(CARLO_LIGHT_PATHS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_LIGHT_PATHS_INL
#undef CARLO_LIGHT_PATHS_INL
#else
#define CARLO_LIGHT_PATHS_INL
#endif

#include "random/hash.h"
#include "renderer/lanes/bsdf-inl.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lights-inl.h"
#include "renderer/lanes/starts-inl.h"
#include "renderer/lanes/steps-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Traces light paths. In Paths, `pdf` is then the cosine at the light (below 0 for point lights),
/// and `roulette_scale` the largest channel of beta at the start.
template <class Needs>
class LightPathWalk : Steps<Needs> {
 public:
  HWY_INLINE LightPathWalk(const LightPathJob& job, carlo::Splats& splats, carlo::Counts& counts)
      : Steps<Needs>(job.whole, counts),
        splats_(splats),
        scale_(1 / job.unit),
        camera_moments_(job.camera_moments) {
    const carlo::Camera& c = job_.camera;
    eye_ = set(c.origin.x, c.origin.y, c.origin.z);
    forward_ = set(c.forward.x, c.forward.y, c.forward.z);
    right_ = set(c.right.x, c.right.y, c.right.z);
    up_ = set(c.up.x, c.up.y, c.up.z);
  }

  /// Follows every path's ray to the next surface, connects it to the camera and samples the next
  /// ray.
  HWY_INLINE void extend(Paths& paths) const {
    Vertex vertex;
    this->find(paths, vertex);
    vertex.to_light.clear = hn::FirstN(d_, 0);
    shade(paths, vertex);
    gather(paths, vertex);
  }

  /// The same for one register of paths, or `batch` of them where there are sdfs.
  HWY_NOINLINE void extend_batch(std::span<Paths> paths) const { this->step_batch(*this, paths); }

  /// The unit of Paths::splat_products, squared luminances of splats.
  double product_unit() const { return large_ * large_; }

  // For step_batch().

  HWY_INLINE void shade(Paths& paths, Vertex& vertex) const {
    paths.depth = hn::Add(paths.depth, set_word(1));
    const M met = differs(vertex.hits.surface, set_word(nothing));
    paths.alive = hn::And(paths.alive, met);
    if (hn::AllFalse(d_, paths.alive)) return;
    const U number = this->surface_met(vertex, met);
    const Lookups found(s_, number);
    const ShadingPoints shading = this->locate(paths, vertex, number, found);
    if (!this->survives(paths, shading)) return;
    const MisRatios ratios = mis_ratios_at(paths, shading, vertex.hits.t);
    this->arrive(paths, shading, vertex);
    M specular = hn::FirstN(d_, 0);
    Reflections next = zeros<Reflections>();
    V next_mis_ratio = zeros<V>();
    if (Needs::full && s_.any_specular) {
      specular = this->reflect_some(paths, shading, vertex.u_lobe.x, next);
      // Power, unlike radiance, is not scaled by refraction.
      next.weight = hn::Div(set(1), next.eta2) * (paths.beta * next.weight);
      next_mis_ratio = this->mis_ratio_after_specular(paths.mis_ratio, shading, next);
    }
    if (!Needs::full || !hn::AllFalse(d_, paths.alive)) {
      const Surfaces surface = this->surface_at(paths.d, shading);
      join_camera(paths, surface, vertex, ratios);
      scatter(paths, surface, vertex.u_lobe, ratios);
    }
    if (Needs::full && s_.any_specular) {
      this->continue_paths(paths, specular, next, shading, vertex.error);
      paths.beta = select(specular, next.weight, paths.beta);
      paths.mis_ratio = select(specular, next_mis_ratio, paths.mis_ratio);
    }
    this->roulette(paths, paths.roulette_scale);
  }

  HWY_INLINE void gather(Paths& paths, const Vertex& vertex) const {
    const M clear = vertex.to_light.clear;
    if (hn::AllFalse(d_, clear)) return;
    add_splat_products(paths, vertex.direct, clear);
    if (camera_moments_ != nullptr) note_moments(paths, vertex);
    alignas(64) std::array<float, lanes> r, g, b;
    alignas(64) std::array<std::uint32_t, lanes> pixel, word;
    hn::Store(mix(hn::Add(hn::Xor(paths.key, paths.reversed_index), paths.depth)), du_,
              word.data());
    hn::Store(vertex.direct.x, d_, r.data());
    hn::Store(vertex.direct.y, d_, g.data());
    hn::Store(vertex.direct.z, d_, b.data());
    hn::Store(paths.pixel, du_, pixel.data());
    for (std::uint32_t left = bits(clear); left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const double up = word[i] * 0x1p-32;
      splats_.add(pixel[i], {units(r[i], up), units(g[i], up), units(b[i], up)});
    }
  }

 private:
  using Base = Steps<Needs>;
  using Base::counts_, Base::job_, Base::s_;

  /// The density of camera paths that go from this vertex to the one that the light path came from,
  /// over that of the light path: `factor` times the BRDF's pdf of that direction, plus, at the
  /// first vertex, the density of light sampling.
  struct MisRatios {
    V factor, of_lights, cosine;
  };
  HWY_INLINE MisRatios mis_ratios_at(const Paths& paths, const ShadingPoints& shading, V t) const {
    const V per = hn::Div(set(1), shading.cosine);
    const M first = same(paths.depth, set_word(1)), point = hn::Lt(paths.pdf, set(0));
    V of_lights = set(0);
    if (!hn::AllFalse(d_, first)) {
      const V there = hn::Div(by_light_sampling(paths, shading, t, hn::And(first, point)),
                              emission_of(paths, point));
      of_lights = hn::IfThenElseZero(first, hn::Mul(there, per));
    }
    return {hn::Mul(paths.mis_ratio, per), of_lights, shading.cosine};
  }
  /// The density with which light sampling at a path's first vertex draws the path's start: per
  /// solid angle, or for a point light times distance^2.
  HWY_INLINE V by_light_sampling(const Paths& paths, const ShadingPoints& shading, V t,
                                 M point) const {
    const U light = hn::IfThenZeroElse(hn::RebindMask(du_, hn::Or(point, is_nowhere(paths.from))),
                                       paths.from.last);
    const Numbers at_surface(light, s_.surfaces);
    V density = at_surface(s_.light_density.data());
    if (Needs::full && s_.any_mesh_light) {
      const M first = hn::And(paths.alive, same(paths.depth, set_word(1)));
      const M on_mesh = hn::AndNot(point, hn::And(first, is_from(s_.first_mesh, light)));
      density = mesh_density(s_, shading.p, shading.n, light, paths.triangle, on_mesh, density);
    }
    V pdf = light_pdf<Needs::full>(s_, at_surface, light, density, shading.p, t, paths.pdf);
    if (Needs::full && s_.point_lights()) pdf = select(point, hn::Mul(t, t), pdf);
    if (s_.lights == 1) return pdf;
    if (Needs::full && s_.choice.many()) {
      const M first = hn::And(paths.alive, same(paths.depth, set_word(1)));
      return hn::Mul(
          pdf, probabilities_in_tree(s_.choice.tree, paths.light, shading.p, shading.n, first));
    }
    alignas(64) Weights weights;
    const LightProbabilities probabilities = weigh_lights(s_.choice, shading.p, shading.n, weights);
    return hn::Mul(pdf,
                   probability_of(s_.choice, probabilities, paths.light, shading.p, shading.n));
  }
  HWY_INLINE static M is_nowhere(const Origins& from) { return same(from.last, set_word(nothing)); }
  /// LaneScene::emission or point_emission.
  HWY_INLINE V emission_of(const Paths& paths, M point) const {
    const Numbers at_light(paths.light, s_.lights);
    const Numbers at_surface(at_light(s_.light_surface.data()), s_.surfaces);
    const V emission = at_surface(s_.emission.data());
    if (!(Needs::full && s_.point_lights())) return emission;
    return select(point, at_light(s_.point_emission.data()), emission);
  }

  HWY_INLINE V mis_ratio(const MisRatios& ratios, const Surfaces& surface, V cosine, V pdf) const {
    const V back = this->reverse_pdf(surface, ratios.cosine, cosine, pdf);
    return this->together(hn::Mul(ratios.factor, back), ratios.of_lights);
  }

  /// Adds the path's contribution to the pixel in which the camera sees its vertex.
  HWY_INLINE void join_camera(Paths& paths, const Surfaces& surface, Vertex& vertex,
                              const MisRatios& ratios) const {
    const V3 to_eye = eye_ - surface.p;
    const V distance2 = dot(to_eye, to_eye), inverse = hn::Div(set(1), hn::Sqrt(distance2));
    const V3 wi = inverse * to_eye;
    const V cosine = dot(surface.n, wi);
    const carlo::Camera& c = job_.camera;
    const V ahead = hn::Neg(dot(wi, forward_));
    const V x = hn::Div(hn::Neg(dot(wi, right_)), hn::Mul(ahead, set(c.tan_half_x)));
    const V y = hn::Div(hn::Neg(dot(wi, up_)), hn::Mul(ahead, set(c.tan_half_y)));
    const V column = hn::Mul(mul_add(x, set(0.5f), set(0.5f)), set(static_cast<float>(job_.width)));
    const V row =
        hn::Mul(neg_mul_add(y, set(0.5f), set(0.5f)), set(static_cast<float>(job_.height)));
    const M seen = hn::And(hn::And(hn::Gt(cosine, set(0)), hn::Gt(ahead, set(0))),
                           hn::And(hn::Lt(hn::Abs(x), set(1)), hn::Lt(hn::Abs(y), set(1))));
    const M active = hn::And(paths.alive, seen);
    if (hn::AllFalse(d_, active)) return;
    counts_.rays += hn::CountTrue(d_, active);
    const Segments segments{paths.from, wi, eye_, hn::Mul(distance2, inverse), set_word(nothing)};
    const M clear = unoccluded<Needs::close, Needs::full, End::camera>(s_, segments, active);
    if (hn::AllFalse(d_, clear)) return;
    const Bsdfs bsdf = this->evaluate_bsdf(surface, wi, cosine);
    const V by_camera = camera_density(job_, set(-1) * wi);
    const V cosine_by_area = hn::Mul(cosine, hn::Mul(inverse, inverse));
    const V from_camera =
        hn::Mul(hn::Mul(by_camera, cosine_by_area), mis_ratio(ratios, surface, cosine, bsdf.pdf));
    const V per_pixel =
        hn::Mul(by_camera, set(job_.choices.light_paths * static_cast<float>(job_.width) *
                               static_cast<float>(job_.height)));
    const V share = this->weigh(from_camera);
    const V weight = hn::Mul(hn::Mul(per_pixel, cosine_by_area), share);
    vertex.direct = weight * (paths.beta * bsdf.f);
    if (camera_moments_ != nullptr) {
      vertex.camera_root =
          hn::Div(luminances(vertex.direct), hn::Sqrt(hn::Mul(share, from_camera)));
    }
    vertex.to_light = {paths.from.clear, eye_, set(1), clear};
    const U inside_x = hn::BitCast(
        du_, hn::ConvertTo(di_, hn::Min(column, set(static_cast<float>(job_.width) - 1))));
    const U inside_y = hn::BitCast(
        du_, hn::ConvertTo(di_, hn::Min(row, set(static_cast<float>(job_.height) - 1))));
    paths.pixel =
        hn::Add(hn::Mul(inside_y, set_word(static_cast<std::uint32_t>(job_.width))), inside_x);
  }

  HWY_INLINE void scatter(Paths& paths, const Surfaces& surface, V2 u,
                          const MisRatios& ratios) const {
    const V3 wi = this->sample_wi(surface, u);
    const V cosine = dot(surface.n, wi);
    const Bsdfs bsdf = this->evaluate_bsdf(surface, wi, cosine);
    const M above = hn::And(hn::Gt(cosine, set(0)), hn::Gt(bsdf.pdf, set(0)));
    paths.alive = hn::And(paths.alive, above);
    const V weight = hn::Div(cosine, bsdf.pdf);
    paths.beta = paths.beta * (weight * bsdf.f);
    paths.mis_ratio = hn::Mul(mis_ratio(ratios, surface, cosine, bsdf.pdf), weight);
    paths.d = wi;
  }

  /// Notes the CameraMoment of each splat.
  HWY_NOINLINE void note_moments(const Paths& paths, const Vertex& vertex) const {
    alignas(64) std::array<float, lanes> root;
    alignas(64) std::array<std::uint32_t, lanes> number, pixel, depth;
    hn::Store(vertex.camera_root, d_, root.data());
    hn::Store(paths.number, du_, number.data());
    hn::Store(paths.pixel, du_, pixel.data());
    hn::Store(paths.depth, du_, depth.data());
    for (std::uint32_t left = bits(vertex.to_light.clear); left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      if (root[i] > 0)
        camera_moments_->push_back({std::uint64_t{number[i]} << 32 | depth[i], pixel[i], root[i]});
    }
  }

  HWY_INLINE static V luminances(const V3& c) { return dot(c, set(0.2126f, 0.7152f, 0.0722f)); }

  /// Adds the products of this splat and the path's earlier ones, from which the covariance of the
  /// pixels that it reaches follows.
  HWY_INLINE void add_splat_products(Paths& paths, const V3& splat, M clear) const {
    const V luminance = hn::Mul(luminances(splat), set(small_));
    const V more = hn::IfThenElseZero(hn::And(clear, hn::Lt(luminance, set(0x1p12f))), luminance);
    paths.splat_products = mul_add(paths.splat_luminance, more, paths.splat_products);
    paths.splat_luminance = hn::Add(paths.splat_luminance, more);
  }

  /// Rounds to whole units without bias (`up` is uniform in [0, 1)): beside a light 1e12 times as
  /// bright, the contribution of a weak one may be less than a unit and must not be lost.
  std::int64_t units(float value, double up) const {
    const double x = static_cast<double>(value) * scale_;
    constexpr double most = 0x1p62;
    if (x >= 0 && x < most) return static_cast<std::int64_t>(x + up);
    ++counts_.bad;
    return 0;
  }

  carlo::Splats& splats_;
  double scale_;
  std::vector<CameraMoment>* camera_moments_;
  double large_ = splats_.unit() * 0x1p50;  ///< keeps the squares of splats within float range
  float small_ = static_cast<float>(1 / large_);
  V3 eye_, forward_, right_, up_;
};

/// Starts a path at a sampled point of the lights in each of these free lanes.
template <class Needs>
HWY_INLINE void start_light_paths(const LightPathJob& job, U index, U key, M starts, Paths& paths) {
  const LaneScene& s = job.whole.scene;
  const U reversed = reverse_bits(index), k = mix(key);
  const V2 u = points(job.whole, reversed, k), v = points(job.whole, reversed, second_word(k));
  const LightPoints light = sample_start<Needs::full>(s, u);
  // A scene without lights has only the environment map, where no path starts.
  if (Needs::full && s.sky) starts = hn::AndNot(light.beyond, starts);
  // Cosine-distributed about the normal, or uniform.
  const SinCos azimuth = turn(v.y);
  const V z = select(light.point, neg_mul_add(v.x, set(2), set(1)), hn::Sqrt(hn::Sub(set(1), v.x)));
  const V r = hn::Sqrt(select(light.point, hn::Max(neg_mul_add(z, z, set(1)), set(0)), v.x));
  // A point light has no normal: any axis serves.
  const V3 axis = select(light.point, set(0, 0, 1), light.n);
  const V3 d = to_world(frame_about(axis), hn::Mul(r, azimuth.cos), hn::Mul(r, azimuth.sin), z);
  const V3 beta = hn::Div(set(1), light.emission) * light.Le;
  const V3 clear =
      Needs::full && s.searched()
          ? select(light.point, light.p, off_surface(light.p, light.error, light.n, set(0, 0, 0)))
          : light.p;
  const U last = hn::IfThenElse(hn::RebindMask(du_, light.point), set_word(nothing), light.surface);
  const auto starts_u = hn::RebindMask(du_, starts);
  paths.from.o = select(starts, light.p, paths.from.o);
  paths.from.arrival =
      select(starts, hn::IfThenElse(light.point, set(0), set(-1)) * light.n, paths.from.arrival);
  paths.from.last = hn::IfThenElse(starts_u, last, paths.from.last);
  paths.from.plane = hn::IfThenElse(starts_u, light.plane, paths.from.plane);
  paths.from.through = hn::AndNot(starts, paths.from.through);
  paths.from.clear = select(starts, clear, paths.from.clear);
  paths.d = select(starts, d, paths.d);
  paths.beta = select(starts, beta, paths.beta);
  paths.splat_luminance = hn::IfThenZeroElse(starts, paths.splat_luminance);
  paths.roulette_scale = select(starts, max_element(beta), paths.roulette_scale);
  paths.pdf = select(starts, select(light.point, set(-1), z), paths.pdf);
  paths.mis_ratio = select(starts, hn::IfThenZeroElse(light.point, hn::Div(set(1), light.emission)),
                           paths.mis_ratio);
  paths.light = hn::IfThenElse(starts_u, light.light, paths.light);
  paths.triangle = hn::IfThenElse(starts_u, light.triangle, paths.triangle);
  paths.depth = hn::IfThenElse(starts_u, set_word(0), paths.depth);
  paths.key = hn::IfThenElse(starts_u, hn::Add(key, set_word(key_step)), paths.key);
  paths.reversed_index = hn::IfThenElse(starts_u, reversed, paths.reversed_index);
  paths.alive = hn::Or(paths.alive, starts);
}

/// Sums Paths::splat_products over a call's paths in the order of the paths, since the order in
/// which they end depends on the number of lanes.
class SplatProducts {
 public:
  explicit SplatProducts(std::uint64_t paths) : products_(paths + 1) {}

  /// Marks lanes that have had no path yet.
  std::uint32_t no_path() const { return static_cast<std::uint32_t>(products_.size() - 1); }

  /// Stores those of the lanes whose paths have ended.
  HWY_INLINE void keep(const Paths& paths, M ended) {
    alignas(64) std::array<float, lanes> products;
    alignas(64) std::array<std::uint32_t, lanes> number;
    hn::Store(paths.splat_products, d_, products.data());
    hn::Store(paths.number, du_, number.data());
    for (std::uint32_t left = bits(ended); left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      products_[number[lane]] = products[lane];
    }
  }

  double sum() const {
    double sum = 0;
    for (const float product : products_)
      sum += static_cast<double>(product);
    return sum;
  }

 private:
  std::vector<float> products_;
};

/// trace_light_paths(). Refills lanes when a quarter of them are free.
template <class Needs>
HWY_ATTR void run_light_paths(const LightPathJob& job, carlo::Splats& splats,
                              carlo::Counts& counts) {
  const LightPathWalk<Needs> walk(job, splats, counts);
  constexpr std::size_t most = Needs::full ? batch : 1;
  const std::size_t registers = Needs::full && !job.whole.scene.sdfs.empty() ? most : 1;
  auto paths = zeros<std::array<Paths, most>>();
  SplatProducts products(job.count);
  for (Paths& some : paths)
    some.alive = hn::FirstN(d_, 0), some.number = set_word(products.no_path());
  std::uint64_t next = job.first;
  const std::uint64_t end = job.first + job.count;
  for (std::uint64_t round = 0;; ++round) {
    bool alive = false;
    for (std::size_t w = 0; w < registers; ++w) {
      const auto free = static_cast<std::uint32_t>(lanes - hn::CountTrue(d_, paths[w].alive));
      if (next < end && 4 * free >= lanes) {
        const auto taken = static_cast<std::uint32_t>(std::min<std::uint64_t>(free, end - next));
        const U place = ranks(~bits(paths[w].alive));
        const M starts =
            hn::AndNot(paths[w].alive, hn::RebindMask(d_, hn::Gt(set_word(taken), place)));
        // Every block of 2^32 paths has a key of its own.
        const auto key = static_cast<std::uint32_t>(carlo::hash(job.whole.seed, ~(next >> 32)));
        const U index = hn::Add(place, set_word(static_cast<std::uint32_t>(next)));
        products.keep(paths[w], starts);
        const auto started = static_cast<std::uint32_t>(next - job.first);
        paths[w].number = hn::IfThenElse(hn::RebindMask(du_, starts),
                                         hn::Add(place, set_word(started)), paths[w].number);
        paths[w].splat_products = hn::IfThenZeroElse(starts, paths[w].splat_products);
        start_light_paths<Needs>(job, index, set_word(key), starts, paths[w]);
        next += taken;
        counts.light_paths += taken;
      }
      alive = alive || !hn::AllFalse(d_, paths[w].alive);
    }
    if (!alive && next == end) break;
    if (round % 4096 == 4095 && carlo::render_interrupted()) return;
    if constexpr (Needs::full)
      walk.extend_batch({paths.data(), registers});
    else
      walk.extend(paths[0]);
  }
  for (std::size_t w = 0; w < registers; ++w)
    products.keep(paths[w], hn::FirstN(d_, lanes));
  counts.splat_covariance += 2 * products.sum() * walk.product_unit();
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_LIGHT_PATHS_INL
