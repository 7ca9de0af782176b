#include "context.h"
#include "course/report/format.h"
#include "course/report/measure.h"
#include "course/viewer/viewer.h"
#include "image/metrics.h"
#include "methods.h"
#include "render/scene_film.h"
#include "scene/load_scene.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

// Error against samples and against seconds: integrators and samplers on scenes.

namespace bench {
namespace {

using carlo::SamplerKind;
using carlo::Scene;

/// Films, samples and runs of a short and of a full benchmark.
struct Plan {
  std::vector<std::string> scenes;
  int size, runs;
  std::vector<std::uint32_t> samples;
};

Plan plan(const Options& options) {
  if (!options.full) {
    return {
        {"cornell_lambert", "cornell_phong", "soft_shadows", "caustics"}, 32, 5, {4, 16, 64, 256}};
  }
  const std::set<std::string> all = reference_scenes(options);
  return {{all.begin(), all.end()}, 64, 5, {4, 16, 64, 256, 1024}};
}

/// All runs of one way with one number of samples.
struct Rung {
  std::uint32_t samples;
  std::vector<double> seconds, mse, rel_mse;

  /// The error without the reference's own contribution.
  double error(double mean_square, double noise) const {
    return std::sqrt(std::max(mean_square - noise, 0.0));
  }
};

struct Measured {
  Way way;
  std::vector<Rung> rungs;
};

/// The runs of all ways alternate, so that disturbances of the machine affect all of them.
std::vector<Measured> measure(Context& context, Scene scene, const Reference& reference,
                              const Plan& p, double from, double to) {
  std::vector<Measured> all;
  for (const Way& way : ways_for(scene)) {
    all.push_back({way, {}});
    for (const std::uint32_t samples : p.samples)
      all.back().rungs.push_back({samples, {}, {}, {}});
  }
  double work = 0, done = 0;
  for (const std::uint32_t samples : p.samples)
    work += samples;
  work *= static_cast<double>(all.size()) * p.runs;
  for (int run = 0; run < p.runs; ++run) {
    for (std::size_t r = 0; r < p.samples.size(); ++r) {
      for (Measured& m : all) {
        scene.sampler = m.way.sampler;
        Rung& rung = m.rungs[r];
        // A line fit needs errors from independent points, so each rung has its own seed.
        const std::uint64_t seed =
            context.options().seed + 16 * static_cast<std::uint64_t>(run) + r;
        const auto integrator = make_integrator(m.way.method, scene, seed, rung.samples);
        const Rendered rendered = render_timed(*integrator, scene, rung.samples);
        const carlo::ImageError error = carlo::compare(rendered.film.mean(), reference.image);
        rung.seconds.push_back(rendered.seconds);
        rung.mse.push_back(error.mse);
        rung.rel_mse.push_back(error.rel_mse);
        done += rung.samples;
        context.progress(from + (to - from) * done / work);
      }
    }
  }
  return all;
}

/// The chart and table entries of one way.
struct Slopes {
  carlo::Series samples, seconds;
};

/// The points are medians; the lines are fitted to all runs above the reference's noise.
Slopes slopes(const Measured& m, double noise) {
  Slopes result;
  result.samples.name = result.seconds.name = m.way.label();
  std::vector<double> samples, seconds, errors;
  for (const Rung& rung : m.rungs) {
    const double error = rung.error(spread(rung.mse).median, noise);
    result.samples.points.push_back({static_cast<double>(rung.samples), error});
    result.seconds.points.push_back({spread(rung.seconds).median, error});
    for (std::size_t i = 0; i < rung.mse.size(); ++i) {
      if (rung.mse[i] < 2 * noise || rung.seconds[i] <= 0) continue;
      samples.push_back(static_cast<double>(rung.samples));
      seconds.push_back(rung.seconds[i]);
      errors.push_back(rung.error(rung.mse[i], noise));
    }
  }
  const auto distinct = [](std::vector<double> x) {
    std::sort(x.begin(), x.end());
    return std::unique(x.begin(), x.end()) - x.begin();
  };
  if (distinct(samples) >= 4) {
    result.samples.fit = carlo::fit_power_law(samples, errors);
    result.seconds.fit = carlo::fit_power_law(seconds, errors);
  }
  return result;
}

/// 1 / (MSE x s) of each run with the most samples.
Spread efficiency(const Measured& m, double noise) {
  const Rung& last = m.rungs.back();
  std::vector<double> values;
  for (std::size_t i = 0; i < last.mse.size(); ++i)
    values.push_back(1 / (std::max(last.mse[i] - noise, 1e-30) * last.seconds[i]));
  return spread(values);
}

void report(Context& context, const std::string& scene, const std::vector<Measured>& all,
            const Reference& reference) {
  carlo::Chart by_samples{scene + ": error against samples",
                          "one thread; medians of the runs, and lines with 95 % bands",
                          {"samples a pixel", carlo::Unit::count},
                          {"RMS error of a pixel"},
                          {}};
  carlo::Chart by_seconds{scene + ": error against time",
                          "the same runs",
                          {"processor seconds", carlo::Unit::seconds},
                          {"RMS error of a pixel"},
                          {}};
  carlo::Table table(
      {"integrator, sampler", "time", "RMS error", "relMSE", "1 / (MSE s) [range]", "x scalar",
       "slope"},
      {"way", "seconds", "rms_error", "rel_mse", "efficiency", "ratio", "slope_samples"});
  const auto base = std::find_if(all.begin(), all.end(), [](const Measured& m) {
    return m.way.method == Method::scalar && m.way.sampler == SamplerKind::independent;
  });
  const double scalar = efficiency(*base, reference.noise).median;
  for (const Measured& m : all) {
    const Slopes lines = slopes(m, reference.noise);
    if (m.way.sampler != SamplerKind::stratified) {
      by_samples.series.push_back(lines.samples);
      by_seconds.series.push_back(lines.seconds);
    }
    const Rung& last = m.rungs.back();
    const Spread e = efficiency(m, reference.noise);
    table.add_row({m.way.label(), carlo::seconds_cell(spread(last.seconds).median),
                   carlo::number_cell(lines.samples.points.back().y),
                   carlo::number_cell(spread(last.rel_mse).median), spread_cell(e),
                   carlo::number_cell(e.median / scalar), carlo::slope_cell(lines.samples.fit)});
  }
  context.page().charts({by_samples, by_seconds});
  context.table("scene_" + scene, table,
                fmt::format("{}, {} samples a pixel, {} x {} pixels, processor seconds of one "
                            "thread; medians of {} runs",
                            scene, all.front().rungs.back().samples, reference.image.width,
                            reference.image.height, all.front().rungs.back().mse.size()));
}

}  // namespace

void bench_scenes(Context& context) {
  const Plan p = plan(context.options());
  context.begin("Scenes: integrators and samplers");
  context.page().prose(
      "The same scenes by the lecture's recursive tracer, lab 8's iterative one, and the "
      "reference renderer's scalar and vector kernels. Efficiency 1 / (MSE x s) is what a method "
      "gives for its time: twice as much is the same error in half the time. The runs of all rows "
      "take turns; ratios are within this run. Errors are against reference images, whose own "
      "noise is taken off. Root mean square errors of independent samples fall with slope -0.5.");
  const auto count = static_cast<double>(p.scenes.size());
  for (std::size_t i = 0; i < p.scenes.size(); ++i) {
    Scene scene = carlo::load_scene(context.options().scenes / (p.scenes[i] + ".xml"));
    carlo::resize(scene, p.size, p.size);
    const Reference reference =
        read_reference(context.options().references / (p.scenes[i] + ".exr"), p.size);
    const auto number = static_cast<double>(i);
    const auto all = measure(context, scene, reference, p, number / count, (number + 1) / count);
    report(context, p.scenes[i], all, reference);
  }
}

void bench_equal_time(Context& context) {
  context.begin("What the same time buys");
  const char* name = "cornell_phong";
  const double seconds = context.options().full ? 10 : 1;
  Scene scene = carlo::load_scene(context.options().scenes / fmt::format("{}.xml", name));
  const Reference reference =
      read_reference(context.options().references / fmt::format("{}.exr", name), 128);
  carlo::resize(scene, 128, 128);
  carlo::Viewer viewer;
  viewer.caption =
      fmt::format("{}, about {} of processor time each", name, carlo::duration_text(seconds));
  viewer.note = "Choose two images, or look at the left one's difference from the reference.";
  carlo::Table table({"integrator, sampler", "samples a pixel", "time", "relMSE"},
                     {"way", "samples", "seconds", "rel_mse"});
  const std::vector<Way> ways = {{Method::recursive, SamplerKind::independent},
                                 {Method::iterative, SamplerKind::independent},
                                 {Method::scalar, SamplerKind::sobol},
                                 {Method::best, SamplerKind::sobol}};
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Way& way = ways[i];
    scene.sampler = way.sampler;
    const std::uint64_t seed = context.options().seed;
    // The second of two pilots: the first one also pays for one-time work.
    const auto pilot = make_integrator(way.method, scene, seed, 2);
    (void)render_timed(*pilot, scene, 2);
    const double each = std::max(render_timed(*pilot, scene, 2).seconds / 2, 1e-6);
    const auto samples =
        2 * static_cast<std::uint32_t>(std::clamp(std::round(seconds / each / 2), 1.0, 1e5));
    const auto integrator = make_integrator(way.method, scene, seed, samples);
    const Rendered rendered = render_timed(*integrator, scene, samples);
    const carlo::Image mean = rendered.film.mean();
    const double rel_mse = carlo::compare(mean, reference.image).rel_mse;
    table.add_row({way.label(), static_cast<std::int64_t>(samples),
                   carlo::seconds_cell(rendered.seconds), carlo::number_cell(rel_mse)});
    viewer.images.push_back({way.label(), mean, rendered.film.standard_error()});
    context.progress(static_cast<double>(i + 1) / static_cast<double>(ways.size()));
  }
  viewer.reference = {"reference image", reference.image};
  carlo::add_viewer(context.page(), viewer);
  context.table("equal_time", table, "The images above; relMSE against the reference image");
}

}  // namespace bench
