#include "context.h"
#include "course/report/stopwatch.h"
#include "image/metrics.h"
#include "methods.h"
#include "render/scene_film.h"
#include "scene/load_scene.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <thread>
#include <utility>

// How the cost of a path grows with threads, lights and depth.

namespace bench {
namespace {

using carlo::Scene;

Scene load(const Context& context, const std::string& name, int size) {
  Scene scene = carlo::load_scene(context.options().scenes / (name + ".xml"));
  carlo::resize(scene, size, size);
  scene.sampler = carlo::SamplerKind::sobol;
  return scene;
}

/// A way to render and the results of its runs.
struct Case {
  std::string name;
  Scene scene;
  Method method;
  std::vector<double> seconds_a_path = {}, efficiency = {};
  std::string kernel = {};
  double mean = 0;  ///< of the image, over channels
};

/// The runs of all cases alternate. With a reference, the efficiency is measured as well.
void run_all(Context& context, std::vector<Case>& cases, std::uint32_t samples, int runs,
             const Reference* reference = nullptr) {
  double done = 0;
  for (int run = 0; run < runs; ++run) {
    for (Case& c : cases) {
      const std::uint64_t seed = context.options().seed + static_cast<std::uint64_t>(run);
      const auto integrator = make_integrator(c.method, c.scene, seed, samples);
      const Rendered rendered = render_timed(*integrator, c.scene, samples);
      c.kernel = integrator->name();
      c.seconds_a_path.push_back(rendered.seconds / rendered.paths);
      const auto mean = carlo::mean_radiance(rendered.film).value;
      c.mean += (mean[0] + mean[1] + mean[2]) / 3 / runs;
      if (reference != nullptr) {
        const double mse = carlo::compare(rendered.film.mean(), reference->image).mse;
        c.efficiency.push_back(1 / (std::max(mse - reference->noise, 1e-30) * rendered.seconds));
      }
      context.progress(++done / (runs * static_cast<double>(cases.size())));
    }
  }
}

int runs_of(const Context& context) {
  return context.options().full ? 7 : 3;
}

/// The scene with its rectangular light cut into n x n parts: the same image.
Scene with_light_cut(Scene scene, int n) {
  const auto light = std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const auto& shape) {
    return shape.emits() && std::holds_alternative<carlo::Parallelogram>(shape.geometry);
  });
  if (light == scene.shapes.end()) throw carlo::Error("the scene has no rectangular light");
  const carlo::Shape whole = *light;
  const auto quad = std::get<carlo::Parallelogram>(whole.geometry);
  scene.shapes.erase(light);
  const carlo::Vec3 u = quad.u / static_cast<float>(n), v = quad.v / static_cast<float>(n);
  for (int i = 0; i < n * n; ++i) {
    carlo::Shape part = whole;
    const int column = i % n, row = i / n;
    part.geometry = carlo::Parallelogram{
        quad.origin + static_cast<float>(column) * u + static_cast<float>(row) * v, u, v};
    scene.shapes.push_back(part);
  }
  return scene;
}

}  // namespace

void bench_threads(Context& context) {
  context.begin("Scaling: threads");
  context.page().prose(
      "The same render on more threads. The time on the clock tells how much sooner the image is "
      "there, if nothing else runs on the machine (its load stands at the page's end); processor "
      "time a path tells what the threads cost each other, busy machine or not.");
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<int> threads;
  for (int t = 1; t < cores; t *= 2)
    threads.push_back(t);
  threads.push_back(cores);
  const Scene scene = load(context, "cornell_phong", 128);
  const std::uint32_t samples = context.options().full ? 256 : 64;
  const auto integrator = make_integrator(Method::best, scene, context.options().seed, samples);
  std::vector<std::vector<double>> wall(threads.size()), processor(threads.size());
  const int runs = runs_of(context) + 2;
  for (int run = 0; run < runs; ++run) {
    for (std::size_t i = 0; i < threads.size(); ++i) {
      const carlo::Stopwatch stopwatch;
      const carlo::RenderResult result =
          carlo::render(*integrator, scene.width, scene.height,
                        {.spp = samples, .threads = threads[i], .progress = false});
      processor[i].push_back(stopwatch.seconds() / static_cast<double>(result.counts.paths));
      wall[i].push_back(result.seconds);
    }
    context.progress(static_cast<double>(run + 1) / runs);
  }
  carlo::Table table({"threads", "time on the clock [range]", "x one thread",
                      "processor time a path [range]", "x one thread"},
                     {"threads", "seconds", "speedup", "processor_a_path", "processor_ratio"});
  for (std::size_t i = 0; i < threads.size(); ++i) {
    const Spread w = spread(wall[i]), p = spread(processor[i]);
    const double faster = spread(wall[0]).median / w.median;
    const double dearer = p.median / spread(processor[0]).median;
    table.add_row({threads[i], seconds_spread_cell(w), carlo::number_cell(faster),
                   seconds_spread_cell(p), carlo::number_cell(dearer)});
  }
  context.table("threads", table,
                fmt::format("{}; cornell_phong, 128 x 128 pixels, {} samples; medians of {} runs",
                            integrator->name(), samples, runs));
}

void bench_lights(Context& context) {
  context.begin("Scaling: lights");
  context.page().prose(
      "The Cornell box, whose light is cut into ever more parts. The image stays the same, so the "
      "error shows what choosing among lights costs besides time.");
  const int size = context.options().full ? 64 : 32;
  const Reference reference =
      read_reference(context.options().references / "cornell_lambert.exr", size);
  const Scene scene = load(context, "cornell_lambert", size);
  std::vector<Case> cases;
  for (const int n : {1, 2, 4, 8}) {
    for (const Method method : {Method::scalar, Method::best})
      cases.push_back({std::to_string(n * n), with_light_cut(scene, n), method});
  }
  run_all(context, cases, 128, runs_of(context), &reference);
  carlo::Table table({"lights", "kernel", "processor time a path [range]", "1 / (MSE s) [range]"},
                     {"lights", "kernel", "seconds_a_path", "efficiency"});
  std::string last;
  for (const Case& c : cases) {
    // Printed only once where the best kernel is the scalar one.
    if (std::exchange(last, c.name + c.kernel) == c.name + c.kernel) continue;
    table.add_row({carlo::Cell(c.name, std::stod(c.name)), c.kernel,
                   seconds_spread_cell(spread(c.seconds_a_path)),
                   spread_cell(spread(c.efficiency))});
  }
  context.table("lights", table,
                fmt::format("cornell_lambert, 128 samples, one thread; medians of {} runs",
                            runs_of(context)));
}

void bench_depth(Context& context) {
  context.begin("Scaling: depth");
  context.page().prose(
      "Longer paths cost more and bring less: each line's light is that of paths of at most so "
      "many segments, over that of all paths.");
  const Scene scene = load(context, "cornell_lambert", 64);
  std::vector<Case> cases;
  for (const int depth : {1, 2, 3, 4, 8, 16, 0}) {
    for (const Method method : {Method::scalar, Method::best}) {
      cases.push_back({depth == 0 ? "no limit" : std::to_string(depth), scene, method});
      cases.back().scene.max_depth = depth;
    }
  }
  run_all(context, cases, 32, runs_of(context));
  carlo::Table table({"segments", "kernel", "processor time a path [range]", "share of the light"},
                     {"segments", "kernel", "seconds_a_path", "share"});
  for (const Case& c : cases) {
    const double share = c.mean / cases.back().mean;
    table.add_row({c.name, c.kernel, seconds_spread_cell(spread(c.seconds_a_path)),
                   carlo::number_cell(share, 4)});
  }
  context.table(
      "depth", table,
      fmt::format("cornell_lambert, 32 samples, one thread; medians of {} runs", runs_of(context)));
}

void bench_needs(Context& context) {
  context.begin("What unused features cost");
  context.page().prose(
      "The renderer chooses its kernel by what the scene needs. Here the diffuse Cornell box is "
      "rendered by the kernel that is chosen for it; by the same one made to know Phong surfaces "
      "too, for the sake of one whose glossy part is a ten millionth; and by the scalar kernel, "
      "which knows everything. The images are the same but for noise.");
  const Scene scene = load(context, "cornell_lambert", 64);
  Scene glossy = scene;
  for (carlo::Shape& shape : glossy.shapes) {
    if (!shape.emits()) continue;
    auto& material = glossy.materials[shape.material].model;
    if (const auto* diffuse = std::get_if<carlo::Diffuse>(&material)) {
      material = carlo::Phong{diffuse->reflectance, carlo::Rgb(1e-7f), 30};
    }
  }
  std::vector<Case> cases = {{"chosen for the scene", scene, Method::best},
                             {"with Phong surfaces as well", glossy, Method::best},
                             {"with everything", scene, Method::scalar}};
  run_all(context, cases, context.options().full ? 256 : 64, runs_of(context) + 4);
  carlo::Table table({"kernel", "its name", "processor time a path [range]", "x chosen"},
                     {"kernel", "name", "seconds_a_path", "ratio"});
  for (const Case& c : cases) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < c.seconds_a_path.size(); ++i)
      ratios.push_back(c.seconds_a_path[i] / cases.front().seconds_a_path[i]);
    table.add_row({c.name, c.kernel, seconds_spread_cell(spread(c.seconds_a_path)),
                   spread_cell(spread(ratios))});
  }
  context.table("needs", table,
                fmt::format("cornell_lambert, one thread; medians of {} runs, ratios within each",
                            runs_of(context) + 4));
}

}  // namespace bench
