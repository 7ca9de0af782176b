// Paths under way, one in each lane. Included once for each instruction set.

#if defined(CARLO_PATHS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_PATHS_INL
#undef CARLO_PATHS_INL
#else
#define CARLO_PATHS_INL
#endif

#include "renderer/lanes/bsdf-inl.h"
#include "renderer/lanes/intersect-inl.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/lights-inl.h"
#include "renderer/lanes/lookup-inl.h"
#include "renderer/lanes/mesh_hits-inl.h"
#include "renderer/lanes/points-inl.h"
#include "renderer/lanes/sdf_hits-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

constexpr std::uint32_t longest_path = 1 << 16;

/// The random numbers of a path: a dimension pair for the film, then two for each vertex. The film
/// has the pixel's key, vertex v the key pixel + v * key_step.
constexpr std::uint32_t key_step = 0x9E3779B1;

/// What a scene needs, for which the code is compiled: `phong` materials; `close`: spheres, or
/// parallelograms that touch others or share a plane with them; `full`: mirrors, glass, disks,
/// sdfs, meshes, spheres and points that emit.
template <bool phong_, bool close_, bool full_ = false>
struct Features {
  static constexpr bool phong = phong_, close = close_, full = full_;
};

struct Paths {
  Origins from;
  V3 d, beta, L;
  V pdf;             ///< of d; below 0: emission counts whole
  V compressed;      ///< by how much refractions have compressed radiance; 1 out of the glass
  U depth;           ///< segments so far
  U key;             ///< of the next vertex
  U reversed_index;  ///< of the sample
  U pixel;           ///< of the tile
  M alive;
};

/// The points of a dimension pair whose random word is k.
HWY_INLINE V2 points(const LaneJob& job, U reversed_index, U k) {
  return job.sobol ? sobol_2d(reversed_index, k) : random_2d(reversed_index, k);
}

/// What happens to paths at their vertices.
template <class Needs>
class Walk {
 public:
  HWY_INLINE Walk(const LaneJob& job, carlo::Counts& counts)
      : job_(job),
        s_(job.scene),
        counts_(counts),
        per_threshold_(1 / job.choices.roulette_threshold) {}

  /// Follows every path's ray to the next surface, gathers light there and draws the next ray.
  HWY_INLINE void extend(Paths& paths) const {
    Vertex vertex;
    find(paths, vertex);
    shade(paths, vertex);
  }

  /// The same for one register of paths, or `batch` of them where there are sdfs.
  HWY_NOINLINE void extend_batch(std::span<Paths> paths) const {
    const bool sdfs = !s_.sdfs.empty();
    std::array<Vertex, batch> vertices;
    for (std::size_t w = 0; w < paths.size(); ++w) {
      Vertex& vertex = vertices[w];
      find(paths[w], vertex);
      vertex.way = {paths[w].from.clear, paths[w].d, paths[w].alive};
      vertex.to_light.clear = hn::FirstN(d_, 0);
    }
    if (sdfs) meet_sdfs(s_, vertices);
    for (std::size_t w = 0; w < paths.size(); ++w) {
      Vertex& vertex = vertices[w];
      if (s_.meshes) {
        meet_meshes(s_, vertex.way.o, vertex.way.d, vertex.way.wanted, vertex.of_mesh, vertex.hits);
      }
      shade(paths[w], vertex);
    }
    if (!s_.searched()) return;
    if (sdfs) block_by_sdfs(s_, vertices);
    for (std::size_t w = 0; w < paths.size(); ++w) {
      ToLight& way = vertices[w].to_light;
      if (s_.meshes) block_by_meshes(s_, way.o, way.to, way.share, way.clear);
      const V3 whole = paths[w].L + vertices[w].direct;
      paths[w].L = select(way.clear, whole, paths[w].L);
    }
  }

 private:
  HWY_INLINE void find(const Paths& paths, Vertex& vertex) const {
    counts_.rays += hn::CountTrue(d_, paths.alive);
    // Ahead of what they serve: the processor works on them while it waits for the intersection.
    const U k = mix(paths.key);
    vertex.u_light = points(job_, paths.reversed_index, k);
    vertex.u_lobe = points(job_, paths.reversed_index, second_word(k));
    vertex.hits = closest<Needs::close, Needs::full>(s_, paths.from, paths.d);
  }

  HWY_INLINE void shade(Paths& paths, Vertex& vertex) const {
    const Hits& hits = vertex.hits;
    paths.depth = hn::Add(paths.depth, set_word(1));
    const M met = differs(hits.surface, set_word(nothing));
    add_sky(paths, hn::AndNot(met, paths.alive));
    paths.alive = hn::And(paths.alive, met);
    if (hn::AllFalse(d_, paths.alive)) return;
    // What missed looks at surface 0, for nothing.
    const U number = hn::IfThenElseZero(hn::RebindMask(du_, met), hits.surface);
    const Numbers at_surface(number, s_.surfaces);
    V3 p, shape_normal;
    place(paths, hits.t, number, at_surface, p, shape_normal);
    if (Needs::full && s_.searched()) place_searched(vertex, paths.alive, number, p, shape_normal);
    const V cosine = hn::Neg(dot(shape_normal, paths.d));
    const M front = hn::Gt(cosine, set(0));
    add_emission(paths, hits.t, number, at_surface, cosine, hn::And(front, paths.alive));
    const Numbers material(at_surface(s_.material.data()), s_.materials);
    if (s_.one_sided) {
      const M two_sided = differs(material(s_.two_sided.data()), set_word(0));
      paths.alive = hn::And(paths.alive, hn::Or(front, two_sided));
    }
    end_long_paths(paths);
    if (hn::AllFalse(d_, paths.alive)) return;
    const V side = hn::CopySign(set(1), cosine);
    arrive(paths, hits.t, p, number, at_surface);
    const V3 normal = side * shape_normal;
    if (Needs::full && s_.searched())
      paths.from.clear = off_surface(p, vertex.error, normal, paths.d);
    paths.key = hn::Add(paths.key, set_word(key_step));
    M specular = hn::FirstN(d_, 0);
    Reflections reflections{};
    if (Needs::full && s_.any_specular) {
      specular = hn::And(paths.alive, differs(material(s_.specular.data()), set_word(0)));
      reflections = reflect(paths.d, normal, front, material(s_.ks_r, s_.ks_g, s_.ks_b),
                            material(s_.ior.data()), vertex.u_lobe.x);
      reflections.weight = paths.beta * reflections.weight;
      paths.alive = hn::AndNot(specular, paths.alive);
    }
    if (!Needs::full || !hn::AllFalse(d_, paths.alive))
      scatter(paths, surface_at(paths.d, p, normal, material), vertex);
    if (Needs::full && s_.any_specular)
      go_on(paths, specular, reflections, p, vertex.error, normal);
    roulette(paths);
  }

  /// The weight of a sample against another technique whose density is `ratio` times as large.
  HWY_INLINE V weigh(V ratio) const {
    const V other_part = job_.choices.power_heuristic ? hn::Mul(ratio, ratio) : ratio;
    return hn::Div(set(1), hn::Add(other_part, set(1)));
  }

  HWY_INLINE void add_sky(Paths& paths, M lost) const {
    const V3 sky = set(s_.environment[0], s_.environment[1], s_.environment[2]);
    paths.L = select(lost, paths.L + paths.beta * sky, paths.L);
  }

  HWY_INLINE void end_long_paths(Paths& paths) const {
    const std::uint32_t last =
        job_.max_depth > 0 ? static_cast<std::uint32_t>(job_.max_depth) : longest_path;
    const M over = hn::And(same(paths.depth, set_word(last)), paths.alive);
    if (job_.max_depth == 0) counts_.cut += hn::CountTrue(d_, over);
    paths.alive = hn::AndNot(over, paths.alive);
  }

  /// The point that was met, moved onto the surface (what is lost in o + t d comes back), and the
  /// shape's normal there.
  HWY_INLINE void place(const Paths& paths, V t, U number, const Numbers& at_surface, V3& p,
                        V3& normal) const {
    const V3 far = add_scaled(paths.from.o, t, paths.d);
    normal = at_surface(s_.nx, s_.ny, s_.nz);
    p = add_scaled(far, hn::Sub(at_surface(s_.d.data()), dot(normal, far)), normal);
    if constexpr (Needs::close) {
      const M flat = hn::RebindMask(d_, hn::Gt(set_word(s_.first_sphere), number));
      if (hn::AllTrue(d_, flat)) return;
      const V3 center = at_surface(s_.cx, s_.cy, s_.cz);
      const V radius = at_surface(s_.radius.data());
      const V3 outward = normalize(far - center);
      normal = select(flat, normal, hn::CopySign(set(1), radius) * outward);
      p = select(flat, p, add_scaled(center, hn::Abs(radius), outward));
    }
  }

  /// Of the lanes that met an sdf or a mesh, and of all the rounding error.
  HWY_INLINE void place_searched(Vertex& vertex, M alive, U number, V3& p, V3& normal) const {
    if (!s_.sdfs.empty()) place_on_sdfs(s_, vertex, number, p, normal);
    vertex.error = rounding_of(p);
    if (!s_.meshes) return;
    const M here = hn::And(is_from(s_.first_mesh, number), alive);
    place_on_meshes(s_, vertex.of_mesh, here, p, normal, vertex.error);
  }

  /// Emission met by the rays, weighed against light sampling.
  HWY_INLINE void add_emission(Paths& paths, V t, U number, const Numbers& at_surface, V cosine,
                               M seen) const {
    if (s_.lights == 0) return;
    M bright = seen;
    if (s_.lights == 1 && !(Needs::full && s_.point_lights())) {
      bright = hn::And(seen, same(number, set_word(s_.light_surface[0])));
      if (hn::AllFalse(d_, bright)) return;
    }
    const V density = at_surface(s_.light_density.data());
    bright = hn::And(bright, hn::Gt(density, set(0)));
    if (hn::AllFalse(d_, bright)) return;
    const V pdf = light_pdf<Needs::full>(s_, at_surface, number, density, paths.from.o, t, cosine);
    const M whole = hn::Lt(paths.pdf, set(0));
    const V weight = select(whole, set(1), weigh(hn::Div(pdf, paths.pdf)));
    const V3 Le = at_surface(s_.le_r, s_.le_g, s_.le_b);
    paths.L = select(bright, paths.L + weight * (paths.beta * Le), paths.L);
  }

  /// The next rays start here.
  HWY_INLINE void arrive(Paths& paths, V t, V3 p, U number, const Numbers& at_surface) const {
    paths.from.o = p;
    paths.from.last = number;
    if constexpr (Needs::close) {
      paths.from.plane = s_.coplanar ? at_surface(s_.plane.data()) : number;
      const M hidden = hn::Lt(t, hn::Mul(set(64 * rounding), coordinates(p)));
      paths.from.came = select(hidden, set(-2) * paths.d, paths.d);
    }
    if constexpr (Needs::full) paths.from.through = hn::FirstN(d_, 0);
  }

  HWY_INLINE Surfaces surface_at(V3 d, V3 p, V3 n, const Numbers& material) const {
    Surfaces surface;
    surface.p = p;
    surface.n = n;
    surface.kd = material(s_.kd_r, s_.kd_g, s_.kd_b);
    if constexpr (Needs::phong) {
      surface.exponent = material(s_.exponent.data());
      surface.diffuse = material(s_.diffuse.data());
      surface.ks = material(s_.ks_r, s_.ks_g, s_.ks_b);
      surface.mirror = add_scaled(d, hn::Mul(set(-2), dot(n, d)), n);
    }
    return surface;
  }

  /// From mirrors and glass, of normal n on the side that the path came from.
  HWY_INLINE void go_on(Paths& paths, M specular, const Reflections& next, V3 p, V3 error,
                        V3 n) const {
    paths.alive = hn::Or(paths.alive, specular);
    paths.beta = select(specular, next.weight, paths.beta);
    paths.d = select(specular, next.d, paths.d);
    paths.pdf = select(specular, set(-1), paths.pdf);
    paths.compressed = select(specular, hn::Mul(paths.compressed, next.eta2), paths.compressed);
    paths.from.through = hn::And(specular, next.through);
    if (s_.searched() && !hn::AllFalse(d_, paths.from.through)) {
      const V3 beyond = off_surface(p, error, set(-1) * n, set(0, 0, 0));
      paths.from.clear = select(paths.from.through, beyond, paths.from.clear);
    }
  }

  HWY_INLINE void scatter(Paths& paths, const Surfaces& surface, Vertex& vertex) const {
    if (s_.lights > 0) add_direct(paths, surface, vertex);
    const V3 wi = sample_direction<Needs::phong>(surface, vertex.u_lobe);
    const V cosine = dot(surface.n, wi);
    const Bsdfs bsdf = evaluate<Needs::phong>(surface, wi, cosine);
    const M above = hn::And(hn::Gt(cosine, set(0)), hn::Gt(bsdf.pdf, set(0)));
    paths.alive = hn::And(paths.alive, above);
    const V weight = Needs::phong ? hn::Div(cosine, bsdf.pdf) : set(pi);
    paths.beta = paths.beta * (weight * bsdf.f);
    paths.pdf = s_.lights > 0 ? bsdf.pdf : set(-1);
    paths.d = wi;
  }

  /// Light that arrives straight from points drawn on the lights.
  HWY_INLINE void add_direct(Paths& paths, const Surfaces& surface, Vertex& vertex) const {
    const LightPoints light = sample_light<Needs::full>(s_, surface.p, vertex.u_light);
    const V3 to_light = light.p - surface.p;
    const V distance2 = dot(to_light, to_light), inverse = hn::Div(set(1), hn::Sqrt(distance2));
    const V3 wi = inverse * to_light;
    const V cosine = dot(surface.n, wi);
    V light_cosine = hn::Neg(dot(light.n, wi));
    if (Needs::full && s_.point_lights()) light_cosine = select(light.point, set(1), light_cosine);
    M elsewhere = differs(light.plane, paths.from.starts_on<Needs::close>());
    // A sphere that emits inwards lights itself, and so does a mesh.
    if (Needs::full && (s_.sphere_lights || s_.any_mesh_light))
      elsewhere = hn::Or(elsewhere, is_from(s_.first_sphere, light.plane));
    if (Needs::full && s_.sphere_lights) elsewhere = hn::And(elsewhere, light.seen);
    const M faces = hn::And(hn::And(hn::Gt(cosine, set(0)), hn::Gt(light_cosine, set(0))),
                            hn::And(paths.alive, elsewhere));
    if (hn::AllFalse(d_, faces)) return;
    counts_.rays += hn::CountTrue(d_, faces);
    const Segments way{paths.from, wi, light.p, hn::Mul(distance2, inverse), light.plane};
    const M clear = unoccluded<Needs::close, Needs::full>(s_, way, faces);
    const Bsdfs bsdf = evaluate<Needs::phong>(surface, wi, cosine);
    // Solid angle: one over the density of wi by light sampling.
    V solid_angle = hn::Mul(hn::Mul(light.area, light_cosine), hn::Mul(inverse, inverse));
    if (Needs::full && s_.sphere_lights)
      solid_angle = select(light.by_cone, light.solid_angle, solid_angle);
    V ratio = hn::Mul(bsdf.pdf, solid_angle);
    // No ray meets a point: nothing to compete with.
    if (Needs::full && s_.point_lights()) ratio = hn::IfThenZeroElse(light.point, ratio);
    const V weight = hn::Mul(hn::Mul(cosine, solid_angle), weigh(ratio));
    const V3 direct = weight * (paths.beta * (bsdf.f * light.Le));
    if (Needs::full && s_.searched()) {
      vertex.direct = direct;
      vertex.to_light = {paths.from.clear, light.p, set(1), clear};
      if (s_.meshes) end_before_meshes(light, vertex.to_light);
    } else {
      paths.L = select(clear, paths.L + direct, paths.L);
    }
  }

  /// carlo::shadow_ray(): the way ends in front of what the lamp is fixed to.
  HWY_INLINE void end_before_meshes(const LightPoints& light, ToLight& way) const {
    const V3 before = off_surface(light.p, light.error, light.n, set(0, 0, 0));
    way.to = s_.point_lights() ? select(light.point, light.p, before) : before;
    if (s_.any_mesh_light)
      way.share = select(is_from(s_.first_mesh, light.plane), set(1 - 1e-6f), set(1));
  }

  HWY_INLINE void roulette(Paths& paths) const {
    V q = hn::Mul(max_element(paths.beta), set(per_threshold_));
    if (Needs::full && s_.any_specular) q = hn::Div(q, paths.compressed);
    const M risky = hn::Lt(q, set(1));
    const U k = hn::Mul(paths.key, set_word(0x85EBCA6B));
    const V u = to_unit(job_.sobol ? nested_hash(paths.reversed_index, mix(k))
                                   : mix(hn::Xor(k, paths.reversed_index)));
    const M ended = hn::And(risky, hn::Ge(u, q));
    paths.alive = hn::AndNot(ended, paths.alive);
    paths.beta = hn::Div(set(1), select(risky, q, set(1))) * paths.beta;
  }

  const LaneJob& job_;
  const LaneScene& s_;
  carlo::Counts& counts_;
  float per_threshold_;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_PATHS_INL
