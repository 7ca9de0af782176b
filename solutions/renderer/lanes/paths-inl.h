// Camera paths in progress, one in each lane. Included once for each instruction set.

#if defined(CARLO_PATHS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_PATHS_INL
#undef CARLO_PATHS_INL
#else
#define CARLO_PATHS_INL
#endif

#include "renderer/lanes/bsdf-inl.h"
#include "renderer/lanes/guide-inl.h"
#include "renderer/lanes/intersect-inl.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/lights-inl.h"
#include "renderer/lanes/lookup-inl.h"
#include "renderer/lanes/mesh_hits-inl.h"
#include "renderer/lanes/points-inl.h"
#include "renderer/lanes/sdf_hits-inl.h"
#include "renderer/lanes/shared_vertices-inl.h"
#include "renderer/lanes/sky-inl.h"
#include "renderer/lanes/steps-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Traces camera paths.
template <class Needs>
class Walk : Steps<Needs> {
 public:
  /// If the job has a learner, adds the paths' vertices to `visits`.
  HWY_INLINE Walk(const LaneJob& job, carlo::Counts& counts, Visits* visits = nullptr,
                  SecondVertices* seconds = nullptr)
      : Steps<Needs>(job, counts), visits_(visits), seconds_(seconds) {}

  /// Follows every path's ray to the next surface, gathers light there and samples the next ray.
  HWY_INLINE void extend(Paths& paths) const {
    Vertex vertex;
    this->find(paths, vertex);
    shade(paths, vertex);
    if (visits_ != nullptr) note(paths, vertex);
  }

  /// The same for one register of paths, or `batch` of them where there are sdfs.
  HWY_NOINLINE void extend_batch(std::span<Paths> paths) const { this->step_batch(*this, paths); }

  /// The same for camera rays of paths that pixels share, without roulette.
  HWY_NOINLINE void extend_first(Paths& paths) const {
    if constexpr (Needs::full) {
      this->step_batch(First{*this}, std::span(&paths, 1));
    } else {
      Vertex vertex;
      this->find(paths, vertex);
      shade(paths, vertex, true);
    }
  }

  /// That roulette; returns the probabilities to go on.
  HWY_INLINE V end_some(Paths& paths) const {
    const V q = hn::Min(hn::Mul(max_element(paths.beta), set(this->per_threshold_)), set(1));
    this->roulette_by(paths, q);
    return q;
  }

  // For step_batch().

  HWY_INLINE void shade(Paths& paths, Vertex& vertex, bool first = false) const {
    paths.depth = hn::Add(paths.depth, set_word(1));
    if (visits_ != nullptr) vertex.scattered = hn::FirstN(d_, 0);
    const M met = differs(vertex.hits.surface, set_word(nothing));
    add_sky(paths, hn::AndNot(met, paths.alive));
    paths.alive = hn::And(paths.alive, met);
    if (hn::AllFalse(d_, paths.alive)) return;
    const U number = this->surface_met(vertex, met);
    const Lookups found(s_, number);
    const ShadingPoints shading = this->locate(paths, vertex, number, found);
    add_emission(paths, vertex, shading);
    if constexpr (Needs::straight) return;
    if (!this->survives(paths, shading)) return;
    this->arrive(paths, shading, vertex);
    if constexpr (Needs::shared) {
      if (first)
        paths.n = each(shading.ns), seconds_->n_of_first = each(shading.n);
      else
        seconds_->template note<Needs>(paths, shading.n);
    }
    const MisRatios ratios = mis_ratios_at(paths, shading, vertex.hits.t);
    M specular = hn::FirstN(d_, 0);
    Reflections next = zeros<Reflections>();
    V next_mis_ratio = zeros<V>();
    if (Needs::full && s_.any_specular) {
      specular = this->reflect_some(paths, shading, vertex.u_lobe.x, next);
      next.weight = paths.beta * next.weight;
      // No light path has its second to last vertex on these surfaces.
      if constexpr (Needs::light_paths)
        next_mis_ratio = hn::IfThenZeroElse(
            ratios.first, this->mis_ratio_after_specular(paths.mis_ratio, shading, next));
    }
    if (!Needs::full || !hn::AllFalse(d_, paths.alive)) {
      const Surfaces surface = this->surface_at(paths.d, shading);
      // Early, since its lookups take long.
      GuidedPoints guided{vertex.u_lobe, set(1)};
      if (job_.guide != nullptr)
        guided = guided_points(*job_.guide, place_of(*job_.guide, surface.p, facing(surface.n)),
                               vertex.u_lobe);
      if (s_.lights > 0) add_direct(paths, surface, shading, vertex, ratios);
      scatter(paths, surface, shading, vertex, guided, ratios);
    }
    if (Needs::full && s_.any_specular)
      pass_on(paths, specular, next, shading, vertex.error, next_mis_ratio);
    if (Needs::full && s_.any_specular)
      this->roulette(paths, paths.roulette_scale);
    else if (!(Needs::shared && first))
      this->roulette(paths);
  }

  HWY_INLINE void gather(Paths& paths, const Vertex& vertex) const {
    if (s_.searched()) paths.L = select(vertex.to_light.clear, paths.L + vertex.direct, paths.L);
    if (visits_ != nullptr) note(paths, vertex);
  }

 private:
  /// For step_batch(): at first vertices.
  struct First {
    const Walk& walk;
    HWY_INLINE void shade(Paths& paths, Vertex& vertex) const { walk.shade(paths, vertex, true); }
    HWY_INLINE void gather(Paths& paths, const Vertex& vertex) const { walk.gather(paths, vertex); }
  };

  using Base = Steps<Needs>;
  using Base::counts_, Base::job_, Base::s_;
  Visits* visits_;
  SecondVertices* seconds_;

  /// The density of light paths whose second to last vertex is this one, over that of this path:
  /// `factor` times the BRDF's pdf of the reverse direction, or `factor` alone at the first vertex
  /// (lane_kernel.h, LightPathJob).
  struct MisRatios {
    V factor;
    M first;
    V cosine;  ///< of arrival
  };
  HWY_INLINE MisRatios mis_ratios_at(const Paths& paths, const ShadingPoints& shading, V t) const {
    if constexpr (!Needs::light_paths) return {set(0), hn::FirstN(d_, 0), set(0)};
    const M first = same(paths.depth, set_word(1));
    const V factor = hn::Div(paths.mis_ratio, shading.cosine);
    return {select(first, hn::Mul(factor, hn::Mul(t, t)), factor), first, shading.cosine};
  }
  HWY_INLINE V mis_ratio(const MisRatios& ratios, const Surfaces& surface, V cosine, V pdf) const {
    const V back = this->reverse_pdf(surface, ratios.cosine, cosine, pdf);
    return select(ratios.first, ratios.factor, hn::Mul(ratios.factor, back));
  }

  HWY_INLINE void add_sky(Paths& paths, M lost) const {
    V3 sky = set(s_.environment[0], s_.environment[1], s_.environment[2]);
    if (Needs::full && s_.sky && !hn::AllFalse(d_, lost)) sky = sky + image_around(paths, lost);
    if (job_.guide != nullptr) sky = paths.guided * sky;
    paths.L = select(lost, paths.L + paths.beta * sky, paths.L);
  }

  /// The environment map's radiance along the rays, weighted against light sampling. No light path
  /// starts there.
  HWY_INLINE V3 image_around(const Paths& paths, M lost) const {
    const Texels texels = sky_at(*s_.sky, paths.d, lost);
    V chosen = set(1);
    if (s_.choice.many())
      chosen = probabilities_in_tree(s_.choice.tree, set_word(s_.sky_light), paths.from.o, paths.n,
                                     lost);
    else if (s_.lights > 1)
      chosen = probability(paths.probabilities, sky_weight(s_.choice), set(1));
    const V by_light = hn::Div(hn::Mul(chosen, texels.pdf), paths.pdf);
    const M whole = hn::Lt(paths.pdf, set(0));
    return select(whole, set(1), this->weigh(by_light)) * texels.radiance;
  }

  /// Adds emission at the hits, weighted against light sampling and light paths.
  HWY_INLINE void add_emission(Paths& paths, const Vertex& vertex,
                               const ShadingPoints& shading) const {
    if (s_.lights == 0) return;
    M bright = hn::And(shading.front, paths.alive);
    if (!Needs::straight && s_.lights == 1 && !(Needs::full && s_.other_lights())) {
      bright = hn::And(bright, same(shading.number, set_word(s_.light_surface[0])));
      if (hn::AllFalse(d_, bright)) return;
    }
    const Numbers& at_surface = shading.at_surface;
    V density = at_surface(s_.light_density.data());
    bright = hn::And(bright, hn::Gt(density, set(0)));
    if (!Needs::straight && !job_.lights_apart.empty())
      bright = hn::AndNot(same(paths.depth, set_word(1)), bright);
    if (hn::AllFalse(d_, bright)) return;
    const V3 Le = at_surface(s_.le_r, s_.le_g, s_.le_b);
    if constexpr (Needs::straight) {  // nothing else finds this light
      paths.L = select(bright, paths.L + Le, paths.L);
      return;
    }
    const M whole = hn::Lt(paths.pdf, set(0));
    if (Needs::full && s_.any_mesh_light) {
      const M on_mesh = hn::AndNot(whole, hn::And(bright, is_from(s_.first_mesh, shading.number)));
      density = mesh_density(s_, paths.from.o, paths.n, shading.number,
                             hn::Load(du_, vertex.of_mesh.triangle.data()), on_mesh, density);
    }
    V pdf = light_pdf<Needs::full>(s_, at_surface, shading.number, density, paths.from.o,
                                   vertex.hits.t, shading.cosine);
    if (s_.lights > 1) {
      const U light = at_surface(s_.light_of.data());
      pdf = hn::Mul(pdf,
                    probability_of_light<Needs::full>(s_, paths.probabilities, light, paths.from.o,
                                                      paths.n, hn::AndNot(whole, bright)));
    }
    V weight;
    if constexpr (Needs::light_paths) {
      const V by_light = hn::IfThenZeroElse(whole, hn::Div(pdf, paths.pdf));
      const V from_light = hn::Mul(paths.mis_ratio, at_surface(s_.emission.data()));
      const M straight = same(paths.depth, set_word(1));
      weight = this->weigh(by_light, hn::IfThenZeroElse(straight, from_light));
    } else {
      weight = select(whole, set(1), this->weigh(hn::Div(pdf, paths.pdf)));
    }
    if (job_.guide != nullptr) weight = hn::Mul(weight, paths.guided);
    paths.L = select(bright, paths.L + weight * (paths.beta * Le), paths.L);
  }

  HWY_INLINE void pass_on(Paths& paths, M specular, const Reflections& next,
                          const ShadingPoints& shading, V3 error, V next_mis_ratio) const {
    this->continue_paths(paths, specular, next, shading, error);
    paths.beta = select(specular, next.weight, paths.beta);
    paths.pdf = select(specular, set(-1), paths.pdf);
    paths.roulette_scale =
        select(specular, hn::Mul(paths.roulette_scale, next.eta2), paths.roulette_scale);
    if constexpr (Needs::light_paths)
      paths.mis_ratio = select(specular, next_mis_ratio, paths.mis_ratio);
  }

  HWY_INLINE void scatter(Paths& paths, const Surfaces& surface, const ShadingPoints& shading,
                          Vertex& vertex, const GuidedPoints& guided,
                          const MisRatios& ratios) const {
    // Not into beta, by which roulette decides: where a path is guided to, there is more light.
    // Not on mirrors and glass, which lanes beside may have met.
    if (job_.guide != nullptr)
      paths.guided = select(paths.alive, hn::Mul(paths.guided, guided.per_density), paths.guided);
    const V3 wi = this->sample_wi(surface, guided.u);
    const V cosine = dot(surface.n, wi);
    const Bsdfs bsdf = this->evaluate_bsdf(surface, wi, cosine);
    const M sampled = hn::And(this->above(wi, cosine, shading), hn::Gt(bsdf.pdf, set(0)));
    paths.alive = hn::And(paths.alive, sampled);
    const V weight = this->lobes() ? hn::Div(cosine, bsdf.pdf) : set(pi);
    paths.beta = paths.beta * (weight * bsdf.f);
    paths.pdf = s_.lights > 0 ? bsdf.pdf : set(-1);
    paths.d = wi;
    if (visits_ != nullptr) vertex.scattered = paths.alive, vertex.side = facing(surface.n);
    if constexpr (Needs::light_paths)
      paths.mis_ratio =
          hn::Mul(mis_ratio(ratios, surface, cosine, bsdf.pdf), hn::Div(cosine, bsdf.pdf));
  }

  /// Notes what the learner needs of the lanes that go on.
  HWY_NOINLINE void note(const Paths& paths, const Vertex& vertex) const {
    const auto luminance = [](V3 c) HWY_ATTR { return dot(c, set(0.2126f, 0.7152f, 0.0722f)); };
    alignas(64) std::array<float, lanes> x, y, z, ux, uy, gathered, throughput;
    alignas(64) std::array<std::uint32_t, lanes> number, side;
    hn::Store(paths.from.o.x, d_, x.data());
    hn::Store(paths.from.o.y, d_, y.data());
    hn::Store(paths.from.o.z, d_, z.data());
    hn::Store(vertex.u_lobe.x, d_, ux.data());
    hn::Store(vertex.u_lobe.y, d_, uy.data());
    hn::Store(luminance(paths.L), d_, gathered.data());
    hn::Store(luminance(paths.beta), d_, throughput.data());
    hn::Store(paths.number, du_, number.data());
    hn::Store(vertex.side, du_, side.data());
    const std::uint32_t here = bits(hn::And(vertex.scattered, paths.alive));
    for (std::uint32_t left = here; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      visits_->push_back(
          {number[i], side[i], {x[i], y[i], z[i]}, {ux[i], uy[i]}, gathered[i], throughput[i]});
    }
  }

  /// Adds direct light from points sampled on the lights.
  HWY_INLINE void add_direct(Paths& paths, const Surfaces& surface, const ShadingPoints& shading,
                             Vertex& vertex, const MisRatios& ratios) const {
    if (s_.lights > 1 || s_.any_mesh_light) paths.n = each(surface.n);
    const LightPoints light = sample_light<Needs::full, Needs::light_paths>(
        s_, surface.p, surface.n, vertex.u_light, hn::Xor(paths.key, paths.reversed_index),
        paths.alive, paths.probabilities);
    const V3 to_light = light.p - surface.p;
    const V distance2 = dot(to_light, to_light), inverse = hn::Div(set(1), hn::Sqrt(distance2));
    const V3 wi = inverse * to_light;
    const V cosine = dot(surface.n, wi);
    V light_cosine = hn::Neg(dot(light.n, wi));
    if (Needs::full && s_.point_lights()) light_cosine = select(light.point, set(1), light_cosine);
    if (Needs::full && s_.sky) light_cosine = select(light.beyond, set(1), light_cosine);
    M elsewhere = differs(light.plane, paths.from.template starts_on<Needs::close>());
    // Spheres that emit inwards and meshes can light themselves.
    if (Needs::full && (s_.sphere_lights || s_.any_mesh_light))
      elsewhere = hn::Or(elsewhere, is_from(s_.first_sphere, light.plane));
    if (Needs::full && s_.sphere_lights) elsewhere = hn::And(elsewhere, light.seen);
    const M faces = hn::And(hn::And(this->above(wi, cosine, shading), hn::Gt(light_cosine, set(0))),
                            hn::And(paths.alive, elsewhere));
    if (hn::AllFalse(d_, faces)) return;
    counts_.rays += hn::CountTrue(d_, faces);
    const Segments segments{paths.from, wi, light.p, hn::Mul(distance2, inverse), light.plane};
    const M clear = unoccluded<Needs::close, Needs::full>(s_, segments, faces);
    const Bsdfs bsdf = this->evaluate_bsdf(surface, wi, cosine);
    // `solid_angle` is one over the density of wi by light sampling.
    V solid_angle = hn::Mul(hn::Mul(light.area, light_cosine), hn::Mul(inverse, inverse));
    if (Needs::full && (s_.sphere_lights || s_.sky))
      solid_angle = select(light.by_direction, light.solid_angle, solid_angle);
    V ratio = hn::Mul(bsdf.pdf, solid_angle);
    // No ray meets a point: nothing to compete with.
    if (Needs::full && s_.point_lights()) ratio = hn::IfThenZeroElse(light.point, ratio);
    V share;
    if constexpr (Needs::light_paths) {
      const V before = mis_ratio(ratios, surface, cosine, bsdf.pdf);
      share = this->weigh(ratio,
                          hn::Mul(hn::Mul(before, cosine), hn::Mul(solid_angle, light.emission)));
    } else {
      share = this->weigh(ratio);
    }
    V weight = hn::Mul(hn::Mul(cosine, solid_angle), share);
    if (job_.guide != nullptr) weight = hn::Mul(weight, paths.guided);
    const V3 direct = weight * (paths.beta * (bsdf.f * light.Le));
    if (Needs::full && s_.searched()) {
      vertex.direct = direct;
      vertex.to_light = {paths.from.clear, light.p, set(1), clear};
      if (s_.meshes) end_before_meshes(light, vertex.to_light);
    } else {
      paths.L = select(clear, paths.L + direct, paths.L);
    }
  }

  /// As in carlo::shadow_ray(), the segment ends in front of the surface that carries the light.
  HWY_INLINE void end_before_meshes(const LightPoints& light, ToLight& segment) const {
    const V3 before = off_surface(light.p, light.error, light.n, set(0, 0, 0));
    segment.to = s_.point_lights() ? select(light.point, light.p, before) : before;
    if (s_.sky) segment.to = select(light.beyond, light.p, segment.to);
    if (s_.any_mesh_light)
      segment.share = select(is_from(s_.first_mesh, light.plane), set(1 - 1e-6f), set(1));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_PATHS_INL
