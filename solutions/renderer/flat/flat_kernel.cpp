#include "renderer/flat/flat_kernel.h"

#include "random/hash.h"

#include <algorithm>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/flat/flat_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the two above, which compile it anew.
#include "renderer/flat/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

constexpr float pi = 3.14159265358979f;
constexpr float longest = 1e30f;
constexpr std::uint32_t nothing = 0xFFFFFFFF;

/// As in the scalar integrator: paths are ended by roulette below this throughput.
constexpr float roulette_threshold = 0.25f;
constexpr std::uint32_t longest_path = 1 << 16;

/// The dimension pairs of a path: one for the film, then two for each vertex. Pair p of a pixel has
/// the key pixel + p * pair_step.
constexpr std::uint32_t pair_step = 0x9E3779B1;

/// A lane's path.
struct Paths {
  V3 o, d, beta, L;
  V pdf;             ///< of d; below 0: emission counts whole
  U last;            ///< the parallelogram that the ray left
  U depth;           ///< segments so far
  U key;             ///< of the next dimension pair
  U reversed_index;  ///< of the sample
  M alive;
};

struct Hits {
  V t;
  U quad;
};

HWY_INLINE V gather(const FlatScene::Column<float>& column, U index) {
  return hn::GatherIndex(d_, column.data(), hn::BitCast(di_, index));
}
HWY_INLINE V3 gather(const FlatScene::Column<float>& x, const FlatScene::Column<float>& y,
                     const FlatScene::Column<float>& z, U index) {
  return {gather(x, index), gather(y, index), gather(z, index)};
}
HWY_INLINE M same(U a, U b) {
  return hn::RebindMask(d_, hn::Eq(a, b));
}
HWY_INLINE M other(U a, U b) {
  return hn::RebindMask(d_, hn::Ne(a, b));
}

/// Across an edge that two parallelograms share, both reach a little further: rays that aim at the
/// edge pass between none.
constexpr float reach = 1 + 4e-7f;

/// Where a ray meets the plane of parallelogram i, and whether that is inside of it.
struct PlaneHit {
  V t;
  M inside;
};
HWY_INLINE PlaneHit meet(const FlatScene& s, std::size_t i, V3 o, V3 d) {
  const V3 n = set(s.nx[i], s.ny[i], s.nz[i]);
  const V t = hn::Div(hn::Sub(set(s.d[i]), dot(n, o)), dot(n, d));
  const V3 p = add_scaled(o, t, d);
  const V a = hn::Sub(dot(set(s.ax[i], s.ay[i], s.az[i]), p), set(s.a0[i]));
  const V b = hn::Sub(dot(set(s.bx[i], s.by[i], s.bz[i]), p), set(s.b0[i]));
  return {t, hn::Le(hn::Max(hn::Abs(a), hn::Abs(b)), set(reach))};
}

HWY_INLINE Hits closest(const FlatScene& s, V3 o, V3 d, U last) {
  Hits hits{set(longest), set_word(nothing)};
  const V first = set(-s.slack);
  for (std::uint32_t i = 0; i < s.quads; ++i) {
    const U index = set_word(i);
    const PlaneHit hit = meet(s, i, o, d);
    const M nearer = hn::And(hn::And(hn::Lt(hit.t, hits.t), hn::Gt(hit.t, first)),
                             hn::And(hit.inside, other(index, last)));
    hits.t = select(nearer, hit.t, hits.t);
    hits.quad = hn::IfThenElse(hn::RebindMask(du_, nearer), index, hits.quad);
  }
  return hits;
}

/// Which of `asked` reach o + d from o without meeting anything but parallelograms `a` and `b`.
HWY_INLINE M unoccluded(const FlatScene& s, V3 o, V3 d, U a, U b, M asked) {
  const V first = set(0), end = set(1 - 1e-6f);
  M clear = asked;
  for (std::uint32_t i = 0; i < s.quads; ++i) {
    const U index = set_word(i);
    const PlaneHit hit = meet(s, i, o, d);
    const M meets = hn::And(hn::And(hn::Gt(hit.t, first), hn::Lt(hit.t, end)), hit.inside);
    clear = hn::AndNot(hn::And(meets, hn::And(other(index, a), other(index, b))), clear);
  }
  return clear;
}

/// A surface point and what it does with light. Normals stand on wo's side.
struct Surfaces {
  V3 p, n, wo, mirror;  ///< mirror: the direction of ideal reflection
  V3 kd, ks;            ///< over pi; times (n + 2) / (2 pi)
  V exponent, diffuse;
};

struct Bsdfs {
  V3 f;
  V pdf;
};

template <bool phong>
HWY_INLINE Bsdfs evaluate(const Surfaces& s, V3 wi, V cosine) {
  const V cosine_pdf = hn::Mul(cosine, set(1 / pi));
  if (!phong) return {s.kd, cosine_pdf};
  // 1 - cos of the angle to the mirror direction, which keeps its digits where the angle is small.
  const V3 apart = wi - s.mirror;
  const V h = hn::Mul(set(0.5f), dot(apart, apart));
  const M front = hn::Lt(h, set(1));
  const V inside = select(front, h, set(0.5f));
  const V power =
      hn::IfThenElseZero(front, hn::Exp(d_, hn::Mul(s.exponent, hn::Log1p(d_, hn::Neg(inside)))));
  const V lobe_pdf = hn::Mul(hn::Mul(hn::Add(s.exponent, set(1)), set(0.5f / pi)), power);
  return {add_scaled(s.kd, power, s.ks),
          hn::MulAdd(s.diffuse, hn::Sub(cosine_pdf, lobe_pdf), lobe_pdf)};
}

/// A direction by either lobe: u.x chooses it and, stretched again, serves the direction.
template <bool phong>
HWY_INLINE V3 sample_direction(const Surfaces& s, V2 u) {
  if (!phong) {
    const SinCos azimuth = turn(u.y);
    const V r = hn::Sqrt(u.x);
    return normalize(to_world(frame_about(s.n), hn::Mul(r, azimuth.cos), hn::Mul(r, azimuth.sin),
                              hn::Sqrt(hn::Sub(set(1), u.x))));
  }
  const M is_diffuse = hn::Lt(u.x, s.diffuse);
  const V stretched = hn::Div(select(is_diffuse, u.x, hn::Sub(u.x, s.diffuse)),
                              select(is_diffuse, s.diffuse, hn::Sub(set(1), s.diffuse)));
  const V x = hn::Min(stretched, set(0x1.fffffep-1f));
  const SinCos azimuth = turn(u.y);
  // cos^2 = 1 - x for the cosine's lobe, (1 - x)^(2/(n+1)) for cos^n.
  const V log_cos2 =
      hn::Mul(hn::Log1p(d_, hn::Neg(x)), hn::Div(set(2), hn::Add(s.exponent, set(1))));
  const V sin2 = select(is_diffuse, x, hn::Neg(hn::Expm1(d_, log_cos2)));
  const V cos2 = select(is_diffuse, hn::Sub(set(1), x), hn::Exp(d_, log_cos2));
  const V r = hn::Sqrt(hn::Max(sin2, set(0)));
  const FrameV frame = frame_about(select(is_diffuse, s.n, s.mirror));
  return normalize(
      to_world(frame, hn::Mul(r, azimuth.cos), hn::Mul(r, azimuth.sin), hn::Sqrt(cos2)));
}

/// p^2 / (p^2 + q^2)
HWY_INLINE V power_heuristic(V p, V q) {
  const V ratio = hn::Div(q, p);
  return hn::Div(set(1), hn::MulAdd(ratio, ratio, set(1)));
}

struct LightPoints {
  V3 p;
  U quad;
};

HWY_INLINE LightPoints sample_light(const FlatScene& s, V2 u) {
  if (s.lights == 1) {
    const V3 p = set(s.lx[0], s.ly[0], s.lz[0]);
    return {add_scaled(add_scaled(p, u.x, set(s.lux[0], s.luy[0], s.luz[0])), u.y,
                       set(s.lvx[0], s.lvy[0], s.lvz[0])),
            set_word(s.light_quad[0])};
  }
  // The first light whose running sum is above u.x, which is stretched again.
  U index = set_word(0);
  V lower = set(0), upper = set(s.light_cdf[0]);
  for (std::uint32_t i = 1; i < s.lights; ++i) {
    const M beyond = hn::Ge(u.x, set(s.light_cdf[i - 1]));
    lower = select(beyond, set(s.light_cdf[i - 1]), lower);
    upper = select(beyond, set(s.light_cdf[i]), upper);
    index = hn::IfThenElse(hn::RebindMask(du_, beyond), set_word(i), index);
  }
  const V x = hn::Min(hn::Div(hn::Sub(u.x, lower), hn::Sub(upper, lower)), set(0x1.fffffep-1f));
  const V3 p = gather(s.lx, s.ly, s.lz, index);
  const U quad = hn::BitCast(
      du_, hn::GatherIndex(di_, reinterpret_cast<const std::int32_t*>(s.light_quad.data()),
                           hn::BitCast(di_, index)));
  return {add_scaled(add_scaled(p, x, gather(s.lux, s.luy, s.luz, index)), u.y,
                     gather(s.lvx, s.lvy, s.lvz, index)),
          quad};
}

/// The lanes' work on one tile.
class Lanes {
 public:
  HWY_ATTR Lanes(const FlatJob& job, carlo::Counts& counts)
      : job_(job), s_(job.scene), counts_(counts) {
    columns_ = job.tile.x1 - job.tile.x0;
    pixels_ = static_cast<std::uint32_t>(columns_ * (job.tile.y1 - job.tile.y0));
    sums_.resize(pixels_);
    paths_.alive = hn::FirstN(d_, 0);
    for (std::uint32_t i = 0; i < pixels_; ++i) {
      const auto x =
          static_cast<std::uint64_t>(job.tile.x0) + i % static_cast<std::uint32_t>(columns_);
      const auto y =
          static_cast<std::uint64_t>(job.tile.y0) + i / static_cast<std::uint32_t>(columns_);
      keys_.push_back(static_cast<std::uint32_t>(
          carlo::hash(job.seed, y * static_cast<std::uint64_t>(job.width) + x)));
    }
    pixel_of_lane_.fill(0);
  }

  template <bool phong>
  HWY_ATTR void run() {
    const std::uint64_t total = std::uint64_t{pixels_} * job_.tile.samples;
    for (std::uint64_t round = 0;; ++round) {
      if (next_ < total) start_paths(total);
      if (hn::AllFalse(d_, paths_.alive)) return;
      if (round % 4096 == 4095 && carlo::render_interrupted()) return;
      const M before = paths_.alive;
      extend<phong>();
      finish(hn::AndNot(paths_.alive, before));
    }
  }

  void means(std::span<std::array<double, 3>> result) const {
    for (std::size_t i = 0; i < pixels_; ++i)
      result[i] = sums_[i].mean(job_.tile.samples);
  }

 private:
  /// Lanes without a path take the next samples, a pixel's samples one after the other.
  HWY_ATTR void start_paths(std::uint64_t total) {
    alignas(64) std::array<std::uint32_t, lanes> fresh{}, key{}, index{};
    alignas(64) std::array<float, lanes> x{}, y{};
    alignas(64) std::array<std::uint32_t, lanes> alive;
    hn::Store(hn::IfThenElseZero(hn::RebindMask(du_, paths_.alive), set_word(1)), du_,
              alive.data());
    for (std::size_t lane = 0; lane < lanes && next_ < total; ++lane) {
      if (alive[lane] != 0) continue;
      const auto pixel = static_cast<std::uint32_t>(next_ / job_.tile.samples);
      fresh[lane] = 1;
      pixel_of_lane_[lane] = pixel;
      key[lane] = keys_[pixel];
      index[lane] = job_.tile.first_sample + static_cast<std::uint32_t>(next_ % job_.tile.samples);
      x[lane] = static_cast<float>(job_.tile.x0 + static_cast<int>(pixel) % columns_);
      y[lane] = static_cast<float>(job_.tile.y0 + static_cast<int>(pixel) / columns_);
      ++next_;
      ++counts_.paths;
    }
    const M starts = hn::RebindMask(d_, hn::Ne(hn::Load(du_, fresh.data()), set_word(0)));
    if (hn::AllFalse(d_, starts)) return;
    const U keys = hn::Load(du_, key.data()), reversed = reverse_bits(hn::Load(du_, index.data()));
    const V2 jitter = points(reversed, keys);
    const V3 d = camera_direction(hn::Add(hn::Load(d_, x.data()), jitter.x),
                                  hn::Add(hn::Load(d_, y.data()), jitter.y));
    const auto starts_u = hn::RebindMask(du_, starts);
    const carlo::Vec3 o = job_.camera.origin;
    paths_.o = select(starts, set(o.x, o.y, o.z), paths_.o);
    paths_.d = select(starts, d, paths_.d);
    paths_.beta = select(starts, set(1, 1, 1), paths_.beta);
    paths_.L = select(starts, set(0, 0, 0), paths_.L);
    paths_.pdf = select(starts, set(-1), paths_.pdf);
    paths_.last = hn::IfThenElse(starts_u, set_word(nothing), paths_.last);
    paths_.depth = hn::IfThenElse(starts_u, set_word(0), paths_.depth);
    paths_.key = hn::IfThenElse(starts_u, hn::Add(keys, set_word(pair_step)), paths_.key);
    paths_.reversed_index = hn::IfThenElse(starts_u, reversed, paths_.reversed_index);
    paths_.alive = hn::Or(paths_.alive, starts);
  }

  HWY_ATTR V2 points(U reversed_index, U key) const {
    return job_.sobol ? sobol_2d(reversed_index, key) : random_2d(reversed_index, key);
  }

  /// Through the film's point (x, y), in pixels; of length 1. Camera::ray() in lanes.
  HWY_ATTR V3 camera_direction(V x, V y) const {
    const carlo::Camera& c = job_.camera;
    const V fx = hn::MulSub(x, set(2 / static_cast<float>(job_.width)), set(1));
    const V fy = hn::NegMulAdd(y, set(2 / static_cast<float>(job_.height)), set(1));
    const V3 forward = set(c.forward.x, c.forward.y, c.forward.z);
    return normalize(add_scaled(
        add_scaled(forward, hn::Mul(fx, set(c.tan_half_x)), set(c.right.x, c.right.y, c.right.z)),
        hn::Mul(fy, set(c.tan_half_y)), set(c.up.x, c.up.y, c.up.z)));
  }

  /// Follows every lane's ray to the next surface, gathers light there and draws the next ray.
  template <bool phong>
  HWY_ATTR void extend() {
    counts_.rays += hn::CountTrue(d_, paths_.alive);
    const Hits hits = closest(s_, paths_.o, paths_.d, paths_.last);
    paths_.depth = hn::Add(paths_.depth, set_word(1));
    const M met = other(hits.quad, set_word(nothing));
    const M lost = hn::AndNot(met, paths_.alive);
    const V3 sky = set(s_.environment[0], s_.environment[1], s_.environment[2]);
    paths_.L = select(lost, paths_.L + paths_.beta * sky, paths_.L);
    paths_.alive = hn::And(paths_.alive, met);
    if (hn::AllFalse(d_, paths_.alive)) return;
    // What missed looks at parallelogram 0, for nothing.
    const U quad = hn::IfThenElseZero(hn::RebindMask(du_, met), hits.quad);
    const V3 shape_normal = gather(s_.nx, s_.ny, s_.nz, quad);
    const V cosine = hn::Neg(dot(shape_normal, paths_.d));
    const M front = hn::Gt(cosine, set(0));
    add_emission(hits.t, quad, cosine, hn::And(front, paths_.alive));
    if (s_.one_sided) {
      const U two_sided = hn::BitCast(
          du_, hn::GatherIndex(di_, reinterpret_cast<const std::int32_t*>(s_.two_sided.data()),
                               hn::BitCast(di_, quad)));
      paths_.alive = hn::And(paths_.alive, hn::Or(front, other(two_sided, set_word(0))));
    }
    const std::uint32_t last =
        job_.max_depth > 0 ? static_cast<std::uint32_t>(job_.max_depth) : longest_path;
    const M over = hn::And(same(paths_.depth, set_word(last)), paths_.alive);
    if (job_.max_depth == 0) counts_.cut += hn::CountTrue(d_, over);
    paths_.alive = hn::AndNot(over, paths_.alive);
    if (hn::AllFalse(d_, paths_.alive)) return;
    const V3 n = select(front, set(1), set(-1)) * shape_normal;
    scatter<phong>(surface_at<phong>(hits.t, quad, shape_normal, n), quad);
  }

  /// Emission met by the rays, weighed against light sampling.
  HWY_ATTR void add_emission(V t, U quad, V cosine, M seen) {
    const V3 Le = gather(s_.le_r, s_.le_g, s_.le_b, quad);
    const M bright = hn::And(seen, hn::Gt(max_element(Le), set(0)));
    if (hn::AllFalse(d_, bright)) return;
    const V light_pdf = hn::Div(hn::Mul(gather(s_.light_density, quad), hn::Mul(t, t)), cosine);
    const M whole = hn::Lt(paths_.pdf, set(0));
    const V weight = select(whole, set(1), power_heuristic(paths_.pdf, light_pdf));
    paths_.L = select(bright, paths_.L + weight * (paths_.beta * Le), paths_.L);
  }

  template <bool phong>
  HWY_ATTR Surfaces surface_at(V t, U quad, V3 shape_normal, V3 n) const {
    // The point, moved into the plane: what is lost in o + t d comes back.
    const V3 far = add_scaled(paths_.o, t, paths_.d);
    const V off = hn::Sub(gather(s_.d, quad), dot(shape_normal, far));
    Surfaces surface;
    surface.p = add_scaled(far, off, shape_normal);
    surface.n = n;
    surface.wo = set(-1) * paths_.d;
    surface.kd = set(1 / pi) * gather(s_.kd_r, s_.kd_g, s_.kd_b, quad);
    if (phong) {
      surface.exponent = gather(s_.exponent, quad);
      surface.diffuse = gather(s_.diffuse, quad);
      surface.ks = hn::Mul(hn::Add(surface.exponent, set(2)), set(0.5f / pi)) *
                   gather(s_.ks_r, s_.ks_g, s_.ks_b, quad);
      surface.mirror = add_scaled(paths_.d, hn::Mul(set(2), dot(n, surface.wo)), n);
    }
    return surface;
  }

  template <bool phong>
  HWY_ATTR void scatter(const Surfaces& surface, U quad) {
    if (s_.lights > 0) add_direct<phong>(surface, quad);
    paths_.key = hn::Add(paths_.key, set_word(pair_step));
    const V3 wi = sample_direction<phong>(surface, points(paths_.reversed_index, paths_.key));
    paths_.key = hn::Add(paths_.key, set_word(pair_step));
    const V cosine = dot(surface.n, wi);
    const Bsdfs bsdf = evaluate<phong>(surface, wi, cosine);
    const M above = hn::And(hn::Gt(cosine, set(0)), hn::Gt(bsdf.pdf, set(0)));
    paths_.alive = hn::And(paths_.alive, above);
    const V weight = phong ? hn::Div(cosine, bsdf.pdf) : set(pi);
    paths_.beta = paths_.beta * (weight * bsdf.f);
    paths_.pdf = s_.lights > 0 ? bsdf.pdf : set(-1);
    paths_.o = surface.p;
    paths_.d = wi;
    paths_.last = quad;
    roulette();
  }

  template <bool phong>
  HWY_ATTR void add_direct(const Surfaces& surface, U quad) {
    const LightPoints light = sample_light(s_, points(paths_.reversed_index, paths_.key));
    const V3 to_light = light.p - surface.p;
    const V distance2 = dot(to_light, to_light);
    const V3 wi = hn::Div(set(1), hn::Sqrt(distance2)) * to_light;
    const V cosine = dot(surface.n, wi);
    const V3 light_normal = gather(s_.nx, s_.ny, s_.nz, light.quad);
    const V light_cosine = hn::Neg(dot(light_normal, wi));
    const M faces = hn::And(hn::And(hn::Gt(cosine, set(0)), hn::Gt(light_cosine, set(0))),
                            hn::And(paths_.alive, other(light.quad, quad)));
    if (hn::AllFalse(d_, faces)) return;
    counts_.rays += hn::CountTrue(d_, faces);
    const M clear = unoccluded(s_, surface.p, to_light, quad, light.quad, faces);
    const V light_pdf =
        hn::Div(hn::Mul(gather(s_.light_density, light.quad), distance2), light_cosine);
    const Bsdfs bsdf = evaluate<phong>(surface, wi, cosine);
    const V weight = hn::Div(hn::Mul(cosine, power_heuristic(light_pdf, bsdf.pdf)), light_pdf);
    const V3 Le = gather(s_.le_r, s_.le_g, s_.le_b, light.quad);
    paths_.L = select(clear, paths_.L + weight * (paths_.beta * (bsdf.f * Le)), paths_.L);
  }

  HWY_ATTR void roulette() {
    const V q = hn::Mul(max_element(paths_.beta), set(1 / roulette_threshold));
    const M risky = hn::Lt(q, set(1));
    const V u = to_unit(
        mix(hn::Xor(mix(hn::Add(paths_.key, set_word(0x85EBCA6B))), paths_.reversed_index)));
    const M ended = hn::And(risky, hn::Ge(u, q));
    paths_.alive = hn::AndNot(ended, paths_.alive);
    paths_.beta = hn::Div(set(1), select(risky, q, set(1))) * paths_.beta;
  }

  /// Adds the radiance of paths that have ended to their pixels, in the order of the lanes.
  HWY_ATTR void finish(M ended) {
    if (hn::AllFalse(d_, ended)) return;
    alignas(64) std::array<float, lanes> r, g, b;
    alignas(64) std::array<std::uint32_t, lanes> done;
    hn::Store(paths_.L.x, d_, r.data());
    hn::Store(paths_.L.y, d_, g.data());
    hn::Store(paths_.L.z, d_, b.data());
    hn::Store(hn::IfThenElseZero(hn::RebindMask(du_, ended), set_word(1)), du_, done.data());
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (done[lane] == 0) continue;
      sums_[pixel_of_lane_[lane]].add({r[lane], g[lane], b[lane]}, counts_);
    }
  }

  const FlatJob& job_;
  const FlatScene& s_;
  carlo::Counts& counts_;
  Paths paths_;
  std::vector<carlo::BlockSum> sums_;
  std::vector<std::uint32_t> keys_;
  std::array<std::uint32_t, lanes> pixel_of_lane_;
  std::uint64_t next_ = 0;
  int columns_;
  std::uint32_t pixels_;
};

HWY_ATTR void render_tile(const FlatJob& job, std::span<std::array<double, 3>> means,
                          carlo::Counts& counts) {
  Lanes work(job, counts);
  if (job.scene.phong) {
    work.run<true>();
  } else {
    work.run<false>();
  }
  work.means(means);
}

std::string instruction_set() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {

HWY_EXPORT(render_tile);
HWY_EXPORT(instruction_set);

void render_flat(const FlatJob& job, std::span<std::array<double, 3>> means,
                 carlo::Counts& counts) {
  HWY_DYNAMIC_DISPATCH(render_tile)(job, means, counts);
}

std::string flat_instruction_set() {
  return HWY_DYNAMIC_DISPATCH(instruction_set)();
}

}  // namespace renderer
#endif
