// Paths in progress, one in each lane: the steps shared by camera paths and light paths. Included
// once for each instruction set.

#if defined(CARLO_STEPS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_STEPS_INL
#undef CARLO_STEPS_INL
#else
#define CARLO_STEPS_INL
#endif

#include "renderer/lanes/bsdf-inl.h"
#include "renderer/lanes/choice-inl.h"
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

/// The features of a scene that the code is compiled for: `phong` materials; `close`: spheres, or
/// parallelograms that touch others or share a plane with them; `full`: mirrors, glass, disks,
/// sdfs, meshes, emitting spheres, point lights, an environment map. `light_paths`: some paths
/// start at the lights, and others leave contributions to them (light_paths-inl.h). `straight`: all
/// paths end at their first surface (straight-inl.h). `shared`: pixels share what their paths find
/// (sharing-inl.h).
template <bool phong_, bool close_, bool full_ = false, bool light_paths_ = false,
          bool straight_ = false, bool shared_ = false>
struct Features {
  static constexpr bool phong = phong_, close = close_, full = full_, light_paths = light_paths_,
                        straight = straight_, shared = shared_;
};

struct Paths {
  Origins from;
  V3 d, beta, L;
  V pdf;             ///< of d; below 0: emission counts fully
  V roulette_scale;  ///< roulette takes beta relative to this: radiance scaled by refraction is not
                     ///< brighter
  U depth;           ///< segments so far
  U key;             ///< of the next vertex
  U reversed_index;  ///< of the sample
  U number;          ///< among the tile's samples (Starts::allow), or a call's light paths
  M alive;
  V3 n;                              ///< of the surface that d leaves, on its side,
  LightProbabilities probabilities;  ///< and the probabilities with which lights were chosen there,
                                     ///< if there are several
  V guided;                          ///< one over the densities of guided points: all that a path
                                     ///< finds is worth so much more or less
  V mis_ratio;                       ///< for Features::light_paths (lane_kernel.h, LightPathJob)
  // For a light path:
  U light, triangle;  ///< where it started
  U pixel;            ///< the pixel in which the camera sees its vertex
  V splat_luminance;  ///< the luminance of its splats
  V splat_products;   ///< the sum of the products of all pairs of splats
};

/// The column entries of a surface and its material.
struct Lookups {
  HWY_INLINE Lookups(const LaneScene& s, U surface)
      : at_surface(surface, s.surfaces), material(at_surface(s.material.data()), s.materials) {}

  Numbers at_surface, material;
};

/// The shading points, on the side that the paths came from. The lookups are kept apart: their
/// masks are an array, which would force all of this into memory.
struct ShadingPoints {
  U number;  ///< of the surface
  const Numbers &at_surface, &material;
  V3 p, n;
  V3 ns;     ///< to shade with: n, or by a mesh's vertex normals
  V cosine;  ///< of the angle of arrival, above 0
  M front;   ///< the surface's own side
};

/// The points of the dimension pair with random word k.
HWY_INLINE V2 points(const LaneJob& job, U reversed_index, U k) {
  return job.sobol ? sobol_2d(reversed_index, k) : random_2d(reversed_index, k);
}

/// The steps of camera paths and light paths alike at their vertices.
template <class Needs>
class Steps {
 public:
  HWY_INLINE Steps(const LaneJob& job, carlo::Counts& counts)
      : job_(job),
        s_(job.scene),
        counts_(counts),
        per_threshold_(1 /
                       ((job.scene.meshes ? with_meshes : 1) * job.choices.roulette_threshold)) {}

 protected:
  /// Extends one register of paths, or `batch` of them if there are sdfs, to their next vertices;
  /// there `walk` shades them and then gathers the contributions of unoccluded segments to_light.
  template <class Walk>
  HWY_INLINE void step_batch(const Walk& walk, std::span<Paths> paths) const {
    const bool sdfs = !s_.sdfs.empty();
    std::array<Vertex, batch> vertices;
    for (std::size_t w = 0; w < paths.size(); ++w) {
      Vertex& vertex = vertices[w];
      find(paths[w], vertex);
      vertex.ray = {paths[w].from.clear, paths[w].d, paths[w].alive};
      vertex.to_light.clear = hn::FirstN(d_, 0);
    }
    if (sdfs) intersect_sdfs(s_, vertices);
    for (std::size_t w = 0; w < paths.size(); ++w) {
      Vertex& vertex = vertices[w];
      if (s_.meshes) {
        intersect_meshes(s_, vertex.ray.o, vertex.ray.d, vertex.ray.wanted, vertex.of_mesh,
                         vertex.hits);
      }
      walk.shade(paths[w], vertex);
    }
    if (sdfs) occlude_by_sdfs(s_, vertices);
    for (std::size_t w = 0; w < paths.size(); ++w) {
      ToLight& segment = vertices[w].to_light;
      if (s_.meshes) occlude_by_meshes(s_, segment.o, segment.to, segment.share, segment.clear);
      walk.gather(paths[w], vertices[w]);
    }
  }

  HWY_INLINE void find(const Paths& paths, Vertex& vertex) const {
    counts_.rays += hn::CountTrue(d_, paths.alive);
    // Computed ahead of use, so that the processor has work while it waits for the intersection.
    if (job_.max_depth != 1) {
      const U k = mix(paths.key);
      vertex.u_light = points(job_, paths.reversed_index, k);
      vertex.u_lobe = points(job_, paths.reversed_index, second_word(k));
    }
    vertex.hits = closest<Needs::close, Needs::full>(s_, paths.from, paths.d, paths.alive);
  }

  /// The MIS weight of a sample against another technique whose density is `ratio` times as large.
  HWY_INLINE V weigh(V ratio) const {
    const V other_part = job_.choices.power_heuristic ? hn::Mul(ratio, ratio) : ratio;
    return hn::Div(set(1), hn::Add(other_part, set(1)));
  }
  /// The MIS weight against two others.
  HWY_INLINE V weigh(V ratio, V other) const { return weigh(together(ratio, other)); }
  /// The ratio of a single technique with the same weight as two.
  HWY_INLINE V together(V a, V b) const {
    return job_.choices.power_heuristic ? hn::Sqrt(mul_add(a, a, hn::Mul(b, b))) : hn::Add(a, b);
  }

  /// Paths::mis_ratio after mirrors and glass, which choose a direction and its reverse with the
  /// same probability.
  HWY_INLINE V mis_ratio_after_specular(V mis_ratio, const ShadingPoints& shading,
                                        const Reflections& next) const {
    return hn::Div(hn::Mul(mis_ratio, hn::Abs(dot(shading.n, next.d))), shading.cosine);
  }

  /// Lanes that missed read surface 0 and ignore it.
  HWY_INLINE U surface_met(const Vertex& vertex, M met) const {
    return hn::IfThenElseZero(hn::RebindMask(du_, met), vertex.hits.surface);
  }

  HWY_INLINE ShadingPoints locate(const Paths& paths, Vertex& vertex, U number,
                                  const Lookups& found) const {
    V3 p, normal;
    place(paths, vertex.hits.t, number, found.at_surface, p, normal);
    if (Needs::full && s_.searched()) place_searched(vertex, paths.alive, number, p, normal);
    const V along = dot(normal, paths.d);
    const V side = hn::CopySign(set(1), hn::Neg(along));
    const V3 n = side * normal;
    return {number,
            found.at_surface,
            found.material,
            p,
            n,
            Needs::full && s_.smooth ? side * vertex.ns : n,
            hn::Abs(along),
            hn::Lt(along, set(0))};
  }

  /// Ends paths on black sides and at the maximum length; true if any path continues.
  HWY_INLINE bool survives(Paths& paths, const ShadingPoints& shading) const {
    if (s_.one_sided) {
      const M two_sided = differs(shading.material(s_.two_sided.data()), set_word(0));
      paths.alive = hn::And(paths.alive, hn::Or(shading.front, two_sided));
    }
    end_long_paths(paths);
    return !hn::AllFalse(d_, paths.alive);
  }

  HWY_INLINE void end_long_paths(Paths& paths) const {
    const std::uint32_t last =
        job_.max_depth > 0 ? static_cast<std::uint32_t>(job_.max_depth) : longest_path;
    const M over = hn::And(same(paths.depth, set_word(last)), paths.alive);
    if (job_.max_depth == 0) counts_.cut += hn::CountTrue(d_, over);
    paths.alive = hn::AndNot(over, paths.alive);
  }

  /// The point of the hit, moved onto the surface (which restores what o + t d lost), and the
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

  /// Points and normals of the lanes that hit an sdf or a mesh; rounding errors for all.
  HWY_INLINE void place_searched(Vertex& vertex, M alive, U number, V3& p, V3& normal) const {
    if (!s_.sdfs.empty()) place_on_sdfs(s_, vertex, number, p, normal);
    vertex.error = rounding_of(p);
    if (!s_.meshes) return;
    const M here = hn::And(is_from(s_.first_mesh, number), alive);
    place_on_meshes(s_, vertex.of_mesh, here, p, normal, vertex.ns, vertex.error);
  }

  /// Starts the next rays here.
  HWY_INLINE void arrive(Paths& paths, const ShadingPoints& shading, const Vertex& vertex) const {
    paths.from.o = each(shading.p);
    paths.from.last = shading.number;
    if constexpr (Needs::close) {
      paths.from.plane = s_.coplanar ? shading.at_surface(s_.plane.data()) : shading.number;
      const M hidden = hn::Lt(vertex.hits.t, hn::Mul(set(64 * rounding), coordinates(shading.p)));
      paths.from.arrival = select(hidden, set(-2) * paths.d, paths.d);
    }
    if constexpr (Needs::full) paths.from.through = hn::FirstN(d_, 0);
    if (Needs::full && s_.searched())
      paths.from.clear = off_surface(shading.p, vertex.error, shading.n, paths.d);
    paths.key = hn::Add(paths.key, set_word(key_step));
  }

  /// Separates the paths on mirrors and glass, and computes their next directions.
  HWY_INLINE M reflect_some(Paths& paths, const ShadingPoints& shading, V u,
                            Reflections& next) const {
    const Numbers& material = shading.material;
    const M specular = hn::And(paths.alive, differs(material(s_.specular.data()), set_word(0)));
    const V3 reflectance = material(s_.ks_r, s_.ks_g, s_.ks_b);
    const V ior = material(s_.ior.data());
    const V3 n = Needs::full && s_.smooth ? specular_normal(paths, shading, ior) : shading.n;
    next = reflect(paths.d, n, shading.front, reflectance, ior, u);
    paths.alive = hn::AndNot(specular, paths.alive);
    return specular;
  }

  /// The normals by which mirrors and glass reflect: those to shade with, unless a direction then
  /// ends on the wrong side of the triangle. They let some rays circle in glass for ever, where its
  /// triangles would let them out: after 64 vertices the triangles count.
  HWY_INLINE V3 specular_normal(const Paths& paths, const ShadingPoints& shading, V ior) const {
    const V3 any = set(1, 1, 1);
    const Reflections back = reflect(paths.d, shading.ns, shading.front, any, ior, set(-1)),
                      through = reflect(paths.d, shading.ns, shading.front, any, ior, set(2));
    const M wrong = hn::Or(hn::Le(dot(shading.n, back.d), set(0)),
                           hn::And(through.through, hn::Ge(dot(shading.n, through.d), set(0))));
    const M long_path =
        hn::And(hn::Gt(ior, set(0)), hn::RebindMask(d_, hn::Gt(paths.depth, set_word(64))));
    return select(hn::Or(wrong, long_path), shading.n, shading.ns);
  }

  /// True where wi lies above the triangle, too, and not only as its vertex normals have it.
  HWY_INLINE M above(V3 wi, V cosine, const ShadingPoints& shading) const {
    const M above = hn::Gt(cosine, set(0));
    if (!Needs::full || !s_.smooth) return above;
    return hn::And(above, hn::Gt(dot(shading.n, wi), set(0)));
  }

  /// True if there are lobes. Code compiled for all features asks the scene, so that a scene
  /// without lobes has the same bits as with code compiled without them.
  HWY_INLINE bool lobes() const { return Needs::phong && (!Needs::full || s_.phong); }
  HWY_INLINE Bsdfs evaluate_bsdf(const Surfaces& surface, V3 wi, V cosine) const {
    return lobes() ? evaluate<Needs::phong>(surface, wi, cosine)
                   : evaluate<false>(surface, wi, cosine);
  }
  HWY_INLINE V3 sample_wi(const Surfaces& surface, V2 u) const {
    return lobes() ? sample_direction<Needs::phong>(surface, u)
                   : sample_direction<false>(surface, u);
  }
  HWY_INLINE V reverse_pdf(const Surfaces& surface, V arrival, V cosine, V pdf) const {
    return lobes() ? reverse_pdf_of<Needs::phong>(surface, arrival, cosine, pdf)
                   : reverse_pdf_of<false>(surface, arrival, cosine, pdf);
  }

  HWY_INLINE Surfaces surface_at(V3 d, const ShadingPoints& shading) const {
    const Numbers& material = shading.material;
    Surfaces surface;  // without lobes the rest is not read
    surface.p = each(shading.p);
    surface.n = each(shading.ns);
    surface.kd = each(material(s_.kd_r, s_.kd_g, s_.kd_b));
    if (lobes()) {
      surface.exponent = material(s_.exponent.data());
      surface.diffuse = material(s_.diffuse.data());
      surface.ks = material(s_.ks_r, s_.ks_g, s_.ks_b);
      surface.mirror = add_scaled(d, hn::Mul(set(-2), dot(shading.ns, d)), shading.ns);
    }
    return surface;
  }

  /// Continues the paths on mirrors and glass.
  HWY_INLINE void continue_paths(Paths& paths, M specular, const Reflections& next,
                                 const ShadingPoints& shading, V3 error) const {
    paths.alive = hn::Or(paths.alive, specular);
    paths.d = select(specular, next.d, paths.d);
    paths.from.through = hn::And(specular, next.through);
    if (s_.searched() && !hn::AllFalse(d_, paths.from.through)) {
      const V3 beyond = off_surface(shading.p, error, set(-1) * shading.n, set(0, 0, 0));
      paths.from.clear = select(paths.from.through, beyond, paths.from.clear);
    }
  }

  /// Roulette by the throughput relative to `whole`.
  HWY_INLINE void roulette(Paths& paths, V whole) const {
    const V q = hn::Div(hn::Mul(max_element(paths.beta), set(per_threshold_)), whole);
    roulette_by(paths, q);
  }
  HWY_INLINE void roulette(Paths& paths) const {
    roulette_by(paths, hn::Mul(max_element(paths.beta), set(per_threshold_)));
  }
  HWY_INLINE void roulette_by(Paths& paths, V q) const {
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
  /// Rays are so much dearer among triangles that paths had better end earlier (lanes/README.md).
  static constexpr float with_meshes = 1.6f;
  float per_threshold_;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_STEPS_INL
