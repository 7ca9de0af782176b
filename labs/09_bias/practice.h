#pragma once

#include "experiments.h"
#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// All methods side by side: the parts of practice_experiment().

namespace lab09 {

/// A scene of common/scenes, small, and its converged image.
struct PracticeScene {
  /// As large as its reference, but halved until no side exceeds `most` pixels. Throws carlo::Error
  /// if a file cannot be read.
  PracticeScene(const std::string& scene_name, int most);

  /// The camera's ray through a point of pixel (x, y): jitter in [0, 1)^2.
  Ray ray(int x, int y, Vec2 jitter) const;

  std::string name;
  carlo::Image reference;
  carlo::Image reference_error;  ///< its standard errors
  World world;
};

/// Renders a scene with `samples` >= 2 of lab 8's paths per pixel, with the features of its
/// pixels: means over up to 16 rays. Mirrors and glass have albedo 1 and their own normals. Runs on
/// all cores.
FeatureImage noisy_image(const PracticeScene& scene, int samples, std::uint64_t seed);

/// The same, with each pixel filtered by filter_pixel().
carlo::Image filtered_image(const FeatureImage& noisy, const FilterStrength& strength);

/// The result of a record's ray, for irradiance by indirect light alone: light that was reflected
/// before it arrives, or came through mirrors or glass. By lab 8's paths.
inline Arrival indirect_arrival(const World& world, const Ray& ray, Rng& rng) {
  const auto met = world.intersect(ray);
  const double distance = met ? static_cast<double>(glm::length(met->p - ray.o)) : INFINITY;
  return {lab08::trace_specular(world, ray, false, rng), distance};
}

/// How a method's square error behaves as its passes are averaged.
enum class Trend {
  unbiased,   ///< a/t
  biased,     ///< bias^2 + b/t
  consistent  ///< a power of t that must be measured, t^-1 at best
};

/// A way to make an image in passes; more passes reduce the noise.
struct PracticeMethod {
  std::string name;
  Trend trend;
  std::function<carlo::Image(int passes, std::uint64_t seed)> render;
};

/// The methods for one scene, which must outlive them; path tracing first.
std::vector<PracticeMethod> practice_methods(const PracticeScene& scene);

/// Bias and noise of an image: means over pixels and channels, relative to reference^2 + .01.
struct ImageParts : ErrorParts {
  double bias_error = 0;  ///< the standard error of bias2, if the noise of pixels is independent

  bool bias_is_seen() const { return bias2 > 2 * bias_error; }
  /// bias^2, or an upper bound if it cannot be distinguished from 0.
  double bias_at_most() const {
    return bias_is_seen() ? bias2 : std::max(bias2, 0.0) + 2 * bias_error;
  }
};

/// Computed from several images of a scene. The contribution of the reference's own noise to bias^2
/// is subtracted.
ImageParts practice_parts(const PracticeScene& scene, const std::vector<carlo::Image>& images);

/// The mean of the images of all passes, each made by pass(number from 0), on all cores.
carlo::Image mean_of_passes(int passes, const std::function<carlo::Image(int number)>& pass);

/// The result of a method after some seconds of one thread.
struct PracticeRun {
  int passes = 0;
  double seconds = 0;
  ImageParts parts;
  carlo::Image shown;  ///< one of the images

  double rel_mse() const { return parts.bias2 + parts.variance; }
};

/// All runs of a method on one scene, the longest last.
struct PracticeCurve {
  std::string name;
  Trend trend;
  std::vector<PracticeRun> runs;

  const PracticeRun& longest() const { return runs.back(); }
  /// The slope of its square error against time, but no steeper than that of noise, -1, since a
  /// steeper one cannot continue.
  double slope() const;
  /// Its square error after t seconds, by its trend; an upper bound if bias_is_bounded().
  double predicted(double t) const;
  /// It has a permanent bias, but these runs are too short to distinguish it from 0.
  bool bias_is_bounded() const { return trend == Trend::biased && !longest().parts.bias_is_seen(); }
};

/// Runs of 1/16, 1/4 and all of `seconds`, each repeated with other random numbers.
PracticeCurve measure_practice(Notebook& notebook, const PracticeScene& scene,
                               const PracticeMethod& method, double seconds);

/// The number of seconds after which the unbiased method overtakes the other for good; infinity:
/// never. A lower bound if the other's bias_is_bounded().
double overtaking(const PracticeCurve& unbiased, const PracticeCurve& other);

}  // namespace lab09
