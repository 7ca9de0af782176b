#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/views.h"
#include "recap.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

// The Recap in the Cornell box, with a ball as the light.

namespace lab08 {
namespace {

constexpr BallLight hung{{278, 440, 279.5f}, 50};

/// The Cornell box; its light is a ball of the same power.
carlo::Scene box_with_ball() {
  carlo::Scene scene = cornell_box();
  const carlo::Material black{carlo::Diffuse{Rgb(0)}, false};
  for (carlo::Shape& shape : scene.shapes) {
    if (!shape.emits()) continue;
    const float area = Light(shape).area();
    shape.geometry = carlo::Sphere{hung.centre, hung.radius};
    shape.radiance *= area / Light(shape).area();
    shape.material = static_cast<std::uint32_t>(scene.materials.size());
  }
  scene.materials.push_back(black);
  return scene;
}

constexpr int shown_samples = 16;
constexpr double white = 1.2;

/// An image and statistics of its paths.
struct Taken {
  carlo::Image image;
  double mean = 0;
  double calls = 0, cut = 0;  ///< per path
};

/// `shown_samples` paths per pixel, each of at most this many calls.
Taken take(const View& view, RecapForm form, int most_calls, std::uint64_t seed) {
  std::vector<glm::dvec2> counts(static_cast<std::size_t>(view.size * view.size));  // calls, cut
  Taken taken;
  taken.image = render(view.size, view.size, seed, [&](int x, int y, Rng& rng) {
    glm::dvec2& count = counts[static_cast<std::size_t>(y * view.size + x)];
    return mean_of(shown_samples, [&] {
      const RecapPath path = form(view.world, hung, view.ray(x, y), most_calls, rng);
      count += glm::dvec2(path.calls, path.cut ? 1 : 0);
      return path.radiance;
    });
  });
  taken.mean = mean_value(taken.image);
  for (const glm::dvec2& count : counts) {
    taken.calls += count.x / (shown_samples * static_cast<double>(counts.size()));
    taken.cut += count.y / (shown_samples * static_cast<double>(counts.size()));
  }
  return taken;
}

/// Calls that are cut off matter here: the mean of the printed form has no limit.
void how_many_calls(Notebook& notebook, const View& view, double mean,
                    std::vector<std::string>& pictures) {
  carlo::Table table(
      {"method", "calls allowed", "mean", "mean / reference", "calls a path", "cut off"},
      {"method", "allowed", "mean", "ratio", "calls", "cut"});
  const auto add = [&](const std::string& name, RecapForm form, int most_calls) {
    const Taken taken = take(view, form, most_calls, notebook.rng().next_u64());
    table.add_row({name, most_calls, taken.mean, carlo::number_cell(taken.mean / mean),
                   carlo::number_cell(taken.calls),
                   carlo::Cell(fmt::format("{:.3g} %", 100 * taken.cut), taken.cut)});
    if (most_calls == 16) return;
    pictures.push_back(carlo::image_tile(
        fmt::format("{}, {} calls", name, most_calls),
        fmt::format("{} paths a pixel, {} calls each", shown_samples, std::lround(taken.calls)),
        taken.image, white));
  };
  for (const int most_calls : {4, 16, 256})
    add("as printed", recap_as_printed, most_calls);
  add("mended", recap_mended, 256);
  notebook.table(
      "recap_box", table,
      fmt::format("The Recap in the box, {} paths a pixel: the mean over all pixels, and "
                  "what it depends on",
                  shown_samples));
}

/// The corrected Recap beside the tracers of steps d and f.
std::vector<Result> measured(Notebook& notebook, const View& view, const Reference& reference) {
  const World& world = view.world;
  struct Method {
    std::string name;
    Trace trace;
  };
  const std::vector<Method> methods = {
      {"the Recap, mended",
       [&](const Ray& ray, Rng& rng) {
         return recap_mended(world, hung, ray, longest_path, rng).radiance;
       }},
      {"TracePath, 8.4", [&](const Ray& ray, Rng& rng) { return trace_path(world, ray, rng); }},
      {"lights by area, 8.6",
       [&](const Ray& ray, Rng& rng) { return trace_direct(world, ray, true, rng); }}};
  std::vector<Result> results;
  for (const Method& method : methods) {
    notebook.attempt([&] {
      results.push_back(
          measure(notebook, method.name, reference, shown_samples, traced(view, method.trace)));
    });
    notebook.progress(2 + static_cast<double>(results.size()), 5);
  }
  return results;
}

}  // namespace

void recap_box_experiment(Notebook& notebook) {
  notebook.begin("The Recap in the Cornell box");
  const View view(box_with_ball(), image_size(notebook, 64));
  notebook.attempt([&] {
    const Reference reference = converged(notebook, view.size, view.size, most_samples(notebook),
                                          tracer<carlo::SobolSampler>(view));
    notebook.progress(1, 5);
    notebook.say(
        "The Cornell box with a ball of the same power for a light. The ball is small: on the "
        "floor light rays come out hundreds of times too bright, and non-light rays are "
        "multiplied by a negative number. A light ray that meets a block is one more path, of "
        "two calls a vertex. How bright the picture is depends on where the calls are cut off. "
        "Corrected, its error is below that of Lab 8.6, which samples points of the whole ball, "
        "half of which face away: light rays are uniform in the cone in which the ball is seen.");
    std::vector<std::string> pictures;
    how_many_calls(notebook, view, mean_value(reference.image), pictures);
    notebook.progress(2, 5);
    const std::vector<Result> results = measured(notebook, view, reference);
    pictures.insert(pictures.begin(), carlo::image_tile("reference", "Lab 8.8, Sobol' points",
                                                        reference.image, white));
    notebook.raw_html(carlo::tiles(pictures));
    carlo::Table table = results_table();
    add_rows(table, "Cornell box", results);
    notebook.table("recap_tracers", table, "The box with a ball: error, cost and slopes");
    add_charts(notebook, "Cornell box with a ball", results);
  });
}

}  // namespace lab08
