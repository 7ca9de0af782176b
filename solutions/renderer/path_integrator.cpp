#include "path_integrator.h"

#include "bsdf.h"
#include "geometry/intersector.h"
#include "geometry/shadow_ray.h"
#include "lanes/lane_integrator.h"
#include "lanes/lane_kernel.h"
#include "lanes/lane_scene.h"
#include "lights.h"
#include "numeric/robust.h"
#include "sampling/samplers.h"
#include "scene/match.h"
#include "scene/needs.h"
#include "scene/sampler_kind.h"
#include "support/error.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace renderer {
namespace {

using carlo::Counts;
using carlo::Hit;
using carlo::Ray;
using carlo::Scene;

/// A closed scene without absorption has endless paths, which are cut at this length and reported;
/// with roulette, at albedo .999, a path has this length with probability e^-64.
constexpr int longest_path = 1 << 16;

/// Roulette from the first bounce on (threshold 1) makes paths cheap but the image noisy; no
/// roulette does the opposite. relMSE x seconds on the Cornell boxes is least near this value.
constexpr float roulette_threshold = 0.25f;

/// Sampler dimensions: two for the film, then a fixed number for each vertex of the path.
constexpr std::uint32_t film_dimensions = 2, vertex_dimensions = 8;
/// Vertex normals let some rays circle in glass for ever, where its triangles would let them out:
/// after this many vertices the triangles count.
constexpr std::uint32_t smooth_glass_dimensions = film_dimensions + 64 * vertex_dimensions;
/// Within a vertex: light choice and point (3), lobe and direction (3), roulette (1).
constexpr std::uint32_t light_dimension = 0, lobe_dimension = 3, roulette_dimension = 6;

struct Surface {
  std::variant<ModifiedPhong, carlo::Mirror, carlo::Dielectric> bsdf;
  bool two_sided;
};

Surface make_surface(const carlo::Material& material) {
  struct Visitor {
    decltype(Surface::bsdf) operator()(const carlo::Diffuse& m) const {
      return ModifiedPhong(m.reflectance, Rgb(0), 0);
    }
    decltype(Surface::bsdf) operator()(const carlo::Phong& m) const {
      return ModifiedPhong(m.kd, m.ks, m.exponent);
    }
    decltype(Surface::bsdf) operator()(const carlo::Mirror& m) const { return m; }
    decltype(Surface::bsdf) operator()(const carlo::Dielectric& m) const { return m; }
  };
  return {std::visit(Visitor{}, material.model), material.two_sided};
}

/// The weight of a sample of density p against another technique of density q.
/// Source: Veach, "Robust Monte Carlo methods for light transport simulation", section 9.2.4.
float power_heuristic(float p, float q) {
  const float r = q / p;
  return 1 / (1 + r * r);
}

float max_channel(Rgb c) {
  return std::max({c.r, c.g, c.b});
}

template <class Sampler>
class PathIntegrator final : public carlo::Integrator {
 public:
  PathIntegrator(const Scene& scene, const PathOptions& options)
      : scene_(scene), options_(options), intersector_(scene), lights_(scene) {
    for (const carlo::Material& material : scene.materials) {
      surfaces_.push_back(make_surface(material));
    }
  }

  std::string name() const override { return "scalar path tracer, Embree"; }

  double least_light_probability() const override {
    return scene_.max_depth == 1 ? 1 : lights_.least_probability();  // pixels see lights then
  }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              Counts& counts) const override {
    const std::uint64_t seed = carlo::stream_seed(options_.seed, tile.stream);
    std::size_t i = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        carlo::BlockSum sum;
        for (std::uint32_t s = 0; s < tile.samples; ++s) {
          sum.add(sample(x, y, seed, tile.first_sample + s, counts), counts);
        }
        means[i++] = sum.mean(tile.samples);
      }
    }
  }

 private:
  /// A path in progress: the next ray, its throughput, and how its direction was sampled.
  struct Path {
    Ray ray;
    Rgb beta{1};
    Rgb L{0};
    float eta_scale =
        1;  ///< scaling of radiance by refraction so far; undone when the path leaves the glass
    bool nee_done = false;  ///< was next-event estimation done for the ray's direction?
    float pdf = 0;          ///< if so: the pdf of the ray's direction,
    ShadingPoint vertex;    ///< and where it started
    std::uint32_t dimension = film_dimensions;  ///< the first dimension of the current vertex
  };

  Rgb sample(int x, int y, std::uint64_t seed, std::uint32_t index, Counts& counts) const {
    const auto pixel = static_cast<std::uint32_t>(y * scene_.width + x);
    Sampler sampler({seed, pixel, index, options_.spp});
    const Vec2 jitter = sampler.next_2d();
    const Vec2 film((static_cast<float>(x) + jitter.x) / static_cast<float>(scene_.width),
                    (static_cast<float>(y) + jitter.y) / static_cast<float>(scene_.height));
    Path path;
    path.ray = scene_.camera.ray(film);
    ++counts.paths;
    for (int depth = 1; extend(path, sampler, depth == scene_.max_depth, counts); ++depth) {
      path.dimension += vertex_dimensions;
      if (depth == longest_path || (depth % 1024 == 0 && carlo::render_interrupted())) {
        ++counts.cut;
        break;
      }
    }
    return path.L;
  }

  /// Follows the path's ray to the next surface, gathers light there and samples the next ray;
  /// false when the path ends.
  bool extend(Path& path, Sampler& sampler, bool last, Counts& counts) const {
    Hit hit;
    ++counts.rays;
    if (!intersector_.intersect(path.ray, hit)) {
      path.L += path.beta * beyond(path);
      return false;
    }
    const carlo::Shape& shape = scene_.shapes[hit.shape];
    const Vec3 wo = -path.ray.d;
    const bool front = glm::dot(hit.n, wo) > 0;
    if (front && shape.emits()) path.L += path.beta * emitted(path, hit, shape.radiance);
    if (last) return false;
    const Surface& surface = surfaces_[shape.material];
    const bool seen = front || surface.two_sided;  ///< one-sided surfaces are black on their back
    const Vec3 normal = front ? hit.ns : -hit.ns;
    return carlo::match(
        surface.bsdf,
        [&](const ModifiedPhong& bsdf) {
          return seen && scatter(path, sampler, hit, normal, bsdf, counts);
        },
        [&](const carlo::Mirror& mirror) {
          return seen && scatter_mirror(path, sampler, hit, normal, mirror);
        },
        [&](const carlo::Dielectric& glass) {
          return scatter_dielectric(path, sampler, hit, front, glass);
        });
  }

  /// The radiance along a ray that hit no shape; the environment map is weighted against next-event
  /// estimation.
  Rgb beyond(const Path& path) const {
    const auto& [points, environment, envmap] = scene_.lights;
    (void)points;  // no ray hits a point
    if (!envmap) return environment;
    const EnvmapTable::Texel texel = lights_.beyond(path.vertex, path.ray.d);
    const float weight = path.nee_done ? power_heuristic(path.pdf, texel.pdf) : 1;
    return environment + weight * texel.radiance;
  }

  /// Emission at the hit, weighted against next-event estimation.
  Rgb emitted(const Path& path, const Hit& hit, Rgb radiance) const {
    if (!path.nee_done) return radiance;
    return radiance * power_heuristic(path.pdf, lights_.pdf(path.vertex, hit));
  }

  bool scatter(Path& path, Sampler& sampler, const Hit& hit, Vec3 normal, const ModifiedPhong& bsdf,
               Counts& counts) const {
    if (bsdf.black()) return false;
    const Vec3 wo = -path.ray.d;
    sampler.seek(path.dimension + light_dimension);
    const float u_light = sampler.next_1d();
    const Vec2 u_point = sampler.next_2d();
    if (!lights_.empty()) {
      path.L += path.beta * direct(hit, normal, wo, bsdf, u_light, u_point, counts);
    }
    sampler.seek(path.dimension + lobe_dimension);
    const float u_lobe = sampler.next_1d();
    const auto next = bsdf.sample(normal, wo, u_lobe, sampler.next_2d());
    if (!next || !reflects(hit, wo, next->wi)) return false;
    path.beta *= next->weight;
    path.pdf = next->pdf;
    path.vertex = {{hit.p, hit.p_error}, normal};
    path.nee_done = !lights_.empty();
    spawn(path, hit, next->wi);
    return survives_roulette(path, sampler);
  }

  /// Light that reaches the surface directly from a light, by sampling lights.
  Rgb direct(const Hit& hit, Vec3 normal, Vec3 wo, const ModifiedPhong& bsdf, float u_light,
             Vec2 u_point, Counts& counts) const {
    const auto light = lights_.sample({{hit.p, hit.p_error}, normal}, u_light, u_point);
    if (!light) return Rgb(0);
    const Vec3 wi = glm::normalize(light->p - hit.p);
    const ModifiedPhong::Value value = bsdf.evaluate(normal, wo, wi);
    if (!(value.pdf > 0) || !reflects(hit, wo, wi)) return Rgb(0);
    const carlo::ShadowRay shadow =
        carlo::shadow_ray(carlo::offset_origin(hit.p, hit.p_error, hit.n, wo, wi), light->p,
                          light->p_error, light->n, light->shades_itself);
    ++counts.rays;
    if (intersector_.occluded(shadow.ray, shadow.length, light->shape)) return Rgb(0);
    const Rgb reflected = value.f * light->radiance * glm::dot(normal, wi);
    if (light->pdf == 0) return reflected;  // no ray hits a point light: no weight
    return reflected * (power_heuristic(light->pdf, value.pdf) / light->pdf);
  }

  static bool scatter_mirror(Path& path, Sampler& sampler, const Hit& hit, Vec3 normal,
                             const carlo::Mirror& mirror) {
    path.beta *= mirror.reflectance;
    path.nee_done = false;
    const Vec3 wo = -path.ray.d, wi = glm::normalize(reflect(normal, wo));
    spawn(path, hit, reflects(hit, wo, wi) ? wi : glm::normalize(reflect(hit.n, wo)));
    return survives_roulette(path, sampler);
  }

  bool scatter_dielectric(Path& path, Sampler& sampler, const Hit& hit, bool front,
                          const carlo::Dielectric& glass) const {
    const Vec3 wo = -path.ray.d;
    const float eta = front ? glass.ext_ior / glass.int_ior : glass.int_ior / glass.ext_ior;
    const Vec3 flat = front ? hit.n : -hit.n;
    const bool smooth = is_smooth(hit) && path.dimension < smooth_glass_dimensions;
    Vec3 normal = smooth ? (front ? hit.ns : -hit.ns) : flat;
    Refraction refraction = refract(normal, wo, eta);
    if (smooth && !(reflects(hit, wo, reflect(normal, wo)) &&
                    (!refraction.wt || !reflects(hit, wo, *refraction.wt)))) {
      normal = flat;
      refraction = refract(normal, wo, eta);
    }
    path.nee_done = false;
    sampler.seek(path.dimension + lobe_dimension);
    if (sampler.next_1d() < refraction.reflectance || !refraction.wt) {
      spawn(path, hit, glm::normalize(reflect(normal, wo)));
    } else {
      // Radiance is compressed into a smaller solid angle in the denser medium.
      path.beta *= refraction.eta * refraction.eta;
      path.eta_scale *= refraction.eta * refraction.eta;
      spawn(path, hit, *refraction.wt);
    }
    return survives_roulette(path, sampler);
  }

  static bool is_smooth(const Hit& hit) { return hit.ns != hit.n; }

  /// True unless wi, as seen from the triangle and not from its vertex normals, lies behind the
  /// surface.
  static bool reflects(const Hit& hit, Vec3 wo, Vec3 wi) {
    return !is_smooth(hit) || (glm::dot(hit.n, wo) > 0) == (glm::dot(hit.n, wi) > 0);
  }

  /// Starts the path's next ray at the surface in direction d.
  static void spawn(Path& path, const Hit& hit, Vec3 d) {
    path.ray = {carlo::offset_origin(hit.p, hit.p_error, hit.n, -path.ray.d, d), d};
  }

  /// Russian roulette: a path whose throughput has fallen below roulette_threshold ends with the
  /// corresponding probability.
  static bool survives_roulette(Path& path, Sampler& sampler) {
    const float q = max_channel(path.beta) / (path.eta_scale * roulette_threshold);
    if (q >= 1) return true;
    sampler.seek(path.dimension + roulette_dimension);
    if (!(sampler.next_1d() < q)) return false;
    path.beta /= q;
    return true;
  }

  const Scene& scene_;
  PathOptions options_;
  carlo::Intersector intersector_;
  Lights lights_;
  std::vector<Surface> surfaces_;
};

bool vector_kernel_suits(const Scene& scene) {
  return lanes_suit_machine() && LaneScene::suits(carlo::needs(scene), scene);
}

}  // namespace

bool light_paths_suit(const Scene& scene) {
  return vector_kernel_suits(scene) && !carlo::needs(scene).vertex_normals;
}

std::unique_ptr<carlo::Integrator> make_path_integrator(const Scene& scene,
                                                        const PathOptions& options) {
  const bool bidirectional = options.technique == Technique::bidirectional;
  if (bidirectional && carlo::needs(scene).vertex_normals) {
    throw carlo::Error(
        "light paths do not know vertex normals, which a mesh of this scene has; render with "
        "--technique path, or set its faceNormals to true");
  }
  if (options.kernel == Kernel::best && vector_kernel_suits(scene)) {
    LaneChoices choices = options.choices;
    if (bidirectional) choices.light_paths = 1;
    const bool automatic = options.technique == Technique::automatic;
    return make_lane_integrator(scene, options.seed, choices,
                                {.spp = options.spp,
                                 .light_paths = automatic,
                                 .guidance = options.guidance,
                                 .share = options.share});
  }
  if (bidirectional) {
    throw carlo::Error(
        "only the vector kernel traces light paths, and it does not suit this scene");
  }
  switch (scene.sampler) {
    case carlo::SamplerKind::independent:
      return std::make_unique<PathIntegrator<carlo::IndependentSampler>>(scene, options);
    case carlo::SamplerKind::stratified:
      return std::make_unique<PathIntegrator<carlo::StratifiedSampler>>(scene, options);
    case carlo::SamplerKind::sobol:
      return std::make_unique<PathIntegrator<carlo::SobolSampler>>(scene, options);
  }
  throw carlo::Error("the scalar kernel does not know the sampler {}",
                     carlo::name_of(scene.sampler));
}

}  // namespace renderer
