// Light sampling, one point per lane. Included once for each instruction set.

#if defined(CARLO_LIGHTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_LIGHTS_INL
#undef CARLO_LIGHTS_INL
#else
#define CARLO_LIGHTS_INL
#endif

#include "renderer/lanes/bsdf-inl.h"
#include "renderer/lanes/choice-inl.h"
#include "renderer/lanes/intersect-inl.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/light_tree-inl.h"
#include "renderer/lanes/lookup-inl.h"
#include "renderer/lanes/mesh_hits-inl.h"
#include "renderer/lanes/sky-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Sampled points of lights: uniform over a light's area, over the directions to a sphere, or with
/// a density of directions to the environment map.
struct LightPoints {
  V3 p, n, Le;
  V area;  ///< one over the density per area; finally includes the choice of the light
  U plane;
  // Only with Features::full:
  M seen =
      zeros<M>();  ///< false for a sphere where rounding hides which side of it the point is on
  M by_direction = zeros<M>();  ///< the density is per solid angle:
  V solid_angle = zeros<V>();   ///< one over that density
  M point = zeros<M>();         ///< there is no n, and Le is intensity
  M beyond = zeros<M>();        ///< there is no n: on the environment map, p beyond all
                                ///< surfaces
  V3 error = zeros<V3>();       ///< of p, if the scene has meshes
  /// LaneScene::emission or point_emission; 0 for the environment map, where no path starts.
  /// Only with Features::light_paths.
  V emission = zeros<V>();
  U surface = zeros<U>(), light = zeros<U>(), triangle = zeros<U>();
};

HWY_INLINE V3 across(V3 corner, V2 u, V3 edge_u, V3 edge_v) {
  return add_scaled(add_scaled(corner, u.x, edge_u), u.y, edge_v);
}

template <bool light_paths>
HWY_INLINE LightPoints sample_only_light(const LaneScene& s, V2 u) {
  const std::uint32_t i = s.light_surface[0];
  LightPoints points{across(set(s.lx[0], s.ly[0], s.lz[0]), u, set(s.lux[0], s.luy[0], s.luz[0]),
                            set(s.lvx[0], s.lvy[0], s.lvz[0])),
                     set(s.nx[i], s.ny[i], s.nz[i]), set(s.le_r[i], s.le_g[i], s.le_b[i]),
                     set(1 / s.light_density[i]), set_word(s.plane[i])};
  if constexpr (light_paths) points.emission = set(s.emission[i]), points.surface = set_word(i);
  return points;
}

HWY_INLINE M is_from(std::uint32_t first, U number) {
  return hn::Not(hn::RebindMask(d_, hn::Gt(set_word(first), number)));
}
/// True if light `index` is a surface.
HWY_INLINE M of_surface(const LaneScene& s, U index) {
  M other = is_from(s.first_point, index);
  if (s.sky) other = hn::Or(other, same(index, set_word(s.sky_light)));
  return hn::Not(other);
}
HWY_INLINE M is_sphere(const LaneScene& s, U surface) {
  return hn::AndNot(is_from(s.first_sdf, surface), is_from(s.first_sphere, surface));
}

/// Maps u uniformly to the disk of radius 1 about the origin.
HWY_INLINE V2 in_disk(V2 u) {
  const V r = hn::Sqrt(u.x);
  const SinCos azimuth = turn(u.y);
  return {hn::Mul(r, azimuth.cos), hn::Mul(r, azimuth.sin)};
}

/// Emitting spheres, one per lane.
struct SphereLights {
  V3 center;
  V radius;       ///< below 0: emits inwards
  V coordinates;  ///< LaneScene's
};
HWY_INLINE SphereLights sphere_lights(const LaneScene& s, const Numbers& at_surface) {
  return {at_surface(s.cx, s.cy, s.cz), at_surface(s.radius.data()),
          at_surface(s.coordinates.data())};
}

/// Bounds the rounding error of the distance between a point and such a sphere.
HWY_INLINE V blur(const SphereLights& ball, V3 p) {
  return hn::Mul(set(rounding), hn::Add(coordinates(p), ball.coordinates));
}

/// The cone of directions that a sphere subtends: 1 - cos of half its angle, which is below a
/// quarter turn; `seen` where the point p lies outside the sphere despite rounding.
struct Cones {
  V3 axis;
  V distance, one_minus_cos;
  M seen;
};
HWY_INLINE Cones cone_of(const SphereLights& ball, V3 p) {
  const V3 to_center = ball.center - p;
  const V distance2 = dot(to_center, to_center), distance = hn::Sqrt(distance2);
  const V sin2 = hn::Min(hn::Div(hn::Mul(ball.radius, ball.radius), distance2), set(1));
  const V cosine = hn::Sqrt(hn::Sub(set(1), sin2));
  return {hn::Div(set(1), distance) * to_center, distance, hn::Div(sin2, hn::Add(set(1), cosine)),
          hn::Gt(hn::Sub(distance, ball.radius), blur(ball, p))};
}

/// The near point in a direction of the cone, or any point of a sphere that emits inwards. Whether
/// that is behind the sphere itself, or whether rounding hides that it faces p, is tested later.
HWY_INLINE void sample_spheres(const SphereLights& ball, V3 p, V2 u, M chosen,
                               LightPoints& points) {
  const Cones cone = cone_of(ball, p);
  const M outwards = hn::Gt(ball.radius, set(0));
  // 1 - cos is uniform.
  const V h = hn::Mul(u.x, select(outwards, cone.one_minus_cos, set(2)));
  const SinCos azimuth = turn(u.y);
  const V z = hn::Sub(set(1), h), r = hn::Sqrt(hn::Mul(h, hn::Sub(set(2), h)));
  // The distance to the near end of the chord in that direction; and that end relative to the
  // center, computed so that it stays accurate when the distance is a thousand times the radius.
  const V aside = hn::Mul(cone.distance, r);
  const V half =
      hn::Sqrt(hn::Max(mul_sub(ball.radius, ball.radius, hn::Mul(aside, aside)), set(0)));
  const V t = hn::Sub(hn::Mul(cone.distance, z), half);
  const V back = mul_add(h, hn::Add(cone.distance, t), half);
  const V side = select(outwards, hn::Mul(t, r), r), ahead = select(outwards, hn::Neg(back), z);
  const V3 n = normalize(to_world(frame_about(cone.axis), hn::Mul(side, azimuth.cos),
                                  hn::Mul(side, azimuth.sin), ahead));
  points.p = select(chosen, add_scaled(ball.center, hn::Abs(ball.radius), n), points.p);
  points.n = select(chosen, hn::CopySign(set(1), ball.radius) * n, points.n);
  points.by_direction = hn::And(chosen, outwards);
  const V cosine_by_distance = dot(points.n, p - points.p);
  // From outside, the near half of such a sphere hides everything that faces p.
  const M inside = hn::Le(hn::Sub(cone.distance, hn::Abs(ball.radius)), blur(ball, p));
  const M faces = hn::And(inside, hn::Gt(cosine_by_distance, blur(ball, p)));
  points.seen = hn::Or(hn::Not(chosen), select_mask(outwards, cone.seen, faces));
  points.solid_angle = hn::Mul(points.area, cone.one_minus_cos);
}

/// Inputs of scalar code, for lanes whose lights are meshes.
struct LaneColumns : LanePoints {
  alignas(64) std::array<float, lanes> ux, uy;
  alignas(64) std::array<std::uint32_t, lanes> surface, triangle;

  const MeshLight& mesh(const LaneScene& s, std::size_t i) const {
    return *s.mesh_lights[surface[i] - s.first_mesh];
  }
};

/// Samples points on lights that are meshes, for the lanes that chose one; `draw` samples one lane.
template <class Draw>
HWY_INLINE void sample_lane_by_lane(const LaneScene& s, const LaneColumns& lane, M chosen,
                                    LightPoints& light, const Draw& draw) {
  PointColumns points{};
  alignas(64) std::array<float, lanes> area{};
  alignas(64) std::array<std::uint32_t, lanes> triangle{};
  for (std::uint32_t left = bits(chosen); left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    const MeshLight::Sample sample = draw(lane.mesh(s, i), i);
    points.set(i, sample.point);
    triangle[i] = sample.triangle;
    area[i] = sample.density > 0 ? static_cast<float>(1 / sample.density) : 0.0f;
  }
  light.p = select(chosen, points.at(points.px, points.py, points.pz), light.p);
  light.n = select(chosen, points.at(points.nx, points.ny, points.nz), light.n);
  light.error = select(chosen, points.at(points.ex, points.ey, points.ez), light.error);
  light.area = select(chosen, hn::Load(d_, area.data()), light.area);
  light.triangle = hn::Load(du_, triangle.data());
}

/// Samples meshes for points p of surfaces with normals n.
inline HWY_NOINLINE void sample_meshes(const LaneScene& s, const V3& p, const V3& n, V2 u, M chosen,
                                       LightPoints& light) {
  LaneColumns lane;
  lane.set_point(p, n);
  hn::Store(u.x, d_, lane.ux.data()), hn::Store(u.y, d_, lane.uy.data());
  hn::Store(light.surface, du_, lane.surface.data());
  sample_lane_by_lane(s, lane, chosen, light, [&](const MeshLight& mesh, std::size_t i) {
    return mesh.sample(lane.p(i), lane.n(i), {lane.ux[i], lane.uy[i]});
  });
}

/// Samples meshes uniformly over their area.
inline HWY_NOINLINE void start_on_meshes(const LaneScene& s, V2 u, M chosen, LightPoints& light) {
  LaneColumns lane;
  hn::Store(u.x, d_, lane.ux.data()), hn::Store(u.y, d_, lane.uy.data());
  hn::Store(light.surface, du_, lane.surface.data());
  sample_lane_by_lane(s, lane, chosen, light, [&](const MeshLight& mesh, std::size_t i) {
    return mesh.sample({lane.ux[i], lane.uy[i]});
  });
}

/// The density per area with which sample_meshes() draws points of these triangles.
inline HWY_NOINLINE V mesh_density(const LaneScene& s, const V3& p, const V3& n, U surface,
                                   U triangle, M asked, V otherwise) {
  if (hn::AllFalse(d_, asked)) return otherwise;
  LaneColumns lane;
  lane.set_point(p, n);
  hn::Store(surface, du_, lane.surface.data());
  hn::Store(triangle, du_, lane.triangle.data());
  alignas(64) std::array<float, lanes> density;
  hn::Store(otherwise, d_, density.data());
  for (std::uint32_t left = bits(asked); left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    density[i] =
        static_cast<float>(lane.mesh(s, i).density(lane.p(i), lane.n(i), lane.triangle[i]));
  }
  return hn::Load(d_, density.data());
}

/// Samples directions to the environment map, as seen from p.
HWY_INLINE void sample_beyond(const LaneScene& s, V3 p, V2 u, LightPoints& points) {
  const SkyDirections sky = sample_sky(*s.sky, u);
  const M beyond = points.beyond;
  points.p = select(beyond, add_scaled(p, set(s.sky_far), sky.wi), points.p);
  points.Le = select(beyond, sky.texel.radiance, points.Le);
  points.solid_angle = select(beyond, hn::Div(set(1), sky.texel.pdf), points.solid_angle);
}

/// Points of the lights `index`. `on_spheres` samples spheres, `on_meshes` meshes, and `on_sky` the
/// environment map.
template <bool full, bool light_paths, class OnSpheres, class OnMeshes, class OnSky>
HWY_INLINE LightPoints draw_light(const LaneScene& s, U index, V2 u, const OnSpheres& on_spheres,
                                  const OnMeshes& on_meshes, const OnSky& on_sky) {
  const Numbers light(index, s.lights);
  const U surface = light(s.light_surface.data());
  const Numbers at_surface(surface, s.surfaces);
  if (full && s.disk_lights) {
    const M disk = hn::AndNot(is_from(s.first_sphere, surface), is_from(s.first_disk, surface));
    const V2 place = in_disk(u);
    u = {select(disk, place.x, u.x), select(disk, place.y, u.y)};
  }
  LightPoints points{
      across(light(s.lx, s.ly, s.lz), u, light(s.lux, s.luy, s.luz), light(s.lvx, s.lvy, s.lvz)),
      at_surface(s.nx, s.ny, s.nz), at_surface(s.le_r, s.le_g, s.le_b),
      hn::Div(set(1), at_surface(s.light_density.data())),
      s.coplanar ? at_surface(s.plane.data()) : surface};
  if constexpr (light_paths) {
    points.emission = at_surface(s.emission.data());
    points.light = index;
  }
  if constexpr (full || light_paths) points.surface = surface;
  if (full && s.sphere_lights) {
    on_spheres(sphere_lights(s, at_surface), u, is_sphere(s, surface), points);
  }
  if (full && s.meshes) {
    points.error = rounding_of(points.p);
    if (s.any_mesh_light) {
      // Lights that are no surfaces have surface number 0.
      const M on_mesh = hn::And(is_from(s.first_mesh, surface), of_surface(s, index));
      on_meshes(u, on_mesh, points);
    }
  }
  if (full && s.point_lights()) {
    points.point = is_from(s.first_point, index);
    points.p = select(points.point, light(s.lx, s.ly, s.lz), points.p);
    points.Le = select(points.point, light(s.intensity_r, s.intensity_g, s.intensity_b), points.Le);
    points.area = select(points.point, set(1), points.area);
    points.plane =
        hn::IfThenElse(hn::RebindMask(du_, points.point), set_word(nothing), points.plane);
    points.seen = hn::Or(points.seen, points.point);
    points.by_direction = hn::AndNot(points.point, points.by_direction);
    if constexpr (light_paths)
      points.emission = select(points.point, light(s.point_emission.data()), points.emission);
  }
  if (full && s.sky) {
    points.beyond = same(index, set_word(s.sky_light));
    points.by_direction = hn::Or(points.by_direction, points.beyond);
    points.seen = hn::Or(points.seen, points.beyond);
    points.plane =
        hn::IfThenElse(hn::RebindMask(du_, points.beyond), set_word(nothing), points.plane);
    if constexpr (light_paths) points.emission = hn::IfThenZeroElse(points.beyond, points.emission);
    if (!hn::AllFalse(d_, points.beyond)) on_sky(u, points);
  }
  return points;
}

/// Chooses lights for points p of surfaces with normals n and samples them as seen from there;
/// `probabilities` receives the probabilities of the choice if there are several. `seed`: a random
/// word for each lane. Lanes that are not alive may be left out.
template <bool full, bool light_paths>
HWY_INLINE LightPoints sample_light(const LaneScene& s, V3 p, V3 n, V2 u, U seed, M alive,
                                    LightProbabilities& probabilities) {
  if (!full && s.lights == 1) return sample_only_light<light_paths>(s, u);
  Picked picked{set_word(0), set(1)};
  if (full && s.choice.many()) {
    picked = pick_in_tree(s.choice.tree, p, n, seed, alive, u.x);
  } else if (s.lights > 1) {
    alignas(64) Weights weights;
    probabilities = weigh_lights(s.choice, p, n, weights);
    picked = pick_light(s.choice, weights, probabilities, seed, u.x);
  }
  LightPoints points = draw_light<full, light_paths>(
      s, picked.index, u,
      [&](const SphereLights& ball, V2 place, M chosen, LightPoints& light)
          HWY_ATTR { sample_spheres(ball, p, place, chosen, light); },
      [&](V2 place, M chosen, LightPoints& light)
          HWY_ATTR { sample_meshes(s, p, n, place, chosen, light); },
      [&](V2 place, LightPoints& light) HWY_ATTR { sample_beyond(s, p, place, light); });
  if (s.lights == 1) return points;
  V per_probability = hn::Div(set(1), picked.probability);
  if (full && s.choice.many())
    per_probability = hn::IfThenElseZero(hn::Gt(picked.probability, set(0)), per_probability);
  points.area = hn::Mul(points.area, per_probability);
  points.solid_angle = hn::Mul(points.solid_angle, per_probability);
  return points;
}

/// Samples uniformly over each light's area; never the environment map.
template <bool full>
HWY_INLINE LightPoints sample_start(const LaneScene& s, V2 u) {
  const U index = pick_start<full>(s.choice, s.lights, u.x);
  return draw_light<full, true>(
      s, index, u,
      [&](const SphereLights& ball, V2 place, M chosen, LightPoints& points) HWY_ATTR {
        const V z = neg_mul_add(place.x, set(2), set(1));
        const V r = hn::Sqrt(hn::Max(neg_mul_add(z, z, set(1)), set(0)));
        const SinCos azimuth = turn(place.y);
        const V3 outward = normalize({hn::Mul(r, azimuth.cos), hn::Mul(r, azimuth.sin), z});
        points.p = select(chosen, add_scaled(ball.center, hn::Abs(ball.radius), outward), points.p);
        points.n = select(chosen, hn::CopySign(set(1), ball.radius) * outward, points.n);
      },
      [&](V2 place, M chosen, LightPoints& points)
          HWY_ATTR { start_on_meshes(s, place, chosen, points); },
      [](V2, LightPoints&) HWY_ATTR {});
}

/// The probability with which sample_light() chooses a light at points p of surfaces with normals
/// n, where `probabilities` is what it returned.
template <bool full>
HWY_INLINE V probability_of_light(const LaneScene& s, const LightProbabilities& probabilities,
                                  U light, const V3& p, const V3& n, M asked) {
  if (full && s.choice.many()) return probabilities_in_tree(s.choice.tree, light, p, n, asked);
  return probability_of(s.choice, probabilities, light, p, n);
}

/// The density per solid angle with which sample_light() draws, at p, the point that the ray from
/// there meets at distance t, once it has chosen this light. `density` is the surface's
/// light_density, or mesh_density() for a mesh.
template <bool full>
HWY_INLINE V light_pdf(const LaneScene& s, const Numbers& at_surface, U surface, V density, V3 p,
                       V t, V cosine) {
  const V by_area = hn::Div(hn::Mul(density, hn::Mul(t, t)), cosine);
  if (!full || !s.sphere_lights) return by_area;
  const M ball = is_sphere(s, surface);
  const SphereLights of_ball = sphere_lights(s, at_surface);
  const Cones cone = cone_of(of_ball, p);
  const M outwards = hn::Gt(of_ball.radius, set(0));
  const V by_direction = hn::Div(density, cone.one_minus_cos);
  const M seen = select_mask(outwards, cone.seen, hn::Gt(hn::Mul(cosine, t), blur(of_ball, p)));
  const V of_sphere = hn::IfThenElseZero(seen, select(outwards, by_direction, by_area));
  return select(ball, of_sphere, by_area);
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_LIGHTS_INL
