#include "course/report/format.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/images.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

// Step g: where a cache is wrong. A thin wall separates a floor under an open sky from a dark
// chamber, and a thin board lies over another chamber. No light enters either: all irradiance there
// has leaked.

namespace lab09 {
namespace {

/// Everything is black; the sky has radiance 1. The floor, z = 0, needs no shape: no ray goes down.
std::unique_ptr<World> black_world(const std::vector<carlo::Parallelogram>& walls) {
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(0)}, true}};
  for (const carlo::Parallelogram& wall : walls)
    scene.shapes.push_back({wall, 0, Rgb(0)});
  scene.lights.environment = Rgb(1);
  return std::make_unique<World>(std::move(scene));
}

/// A chamber of this height over x in [0, 2], y in [-2, 2]; its wall at x = 0 is infinitely thin.
std::unique_ptr<World> chamber(float height) {
  const Vec3 up(0, 0, height);
  return black_world({{{0, -2, 0}, {0, 4, 0}, up},
                      {{2, -2, 0}, {0, 4, 0}, up},
                      {{0, -2, 0}, {2, 0, 0}, up},
                      {{0, 2, 0}, {2, 0, 0}, up},
                      {up + Vec3(0, -2, 0), {2, 0, 0}, {0, 4, 0}}});
}

Record record_at(const World& world, Vec3 p, Rng& rng) {
  const LookAround look = [&](Vec3 wi) {
    const auto met = world.intersect({p + Vec3(0, 0, 1e-5f), wi});
    if (!met) return Arrival{world.environment(), INFINITY};
    return Arrival{met->Le, std::max(static_cast<double>(glm::length(met->p - p)), 1e-6)};
  };
  return make_record(p, {0, 0, 1}, 8, look, rng);
}

/// interpolate(), but with records in front serving as well, as if all lay on the floor.
std::optional<Rgb> interpolate_anyway(std::vector<Record> records, Vec3 p, Vec3 n, double most) {
  for (Record& record : records)
    record.p -= glm::dot(record.p - p, n) * n;
  return interpolate(records, p, n, most);
}

struct LeakSetting {
  double most = 0.3, nearest = 0, farthest = 2;
  bool asks_in_front = true;
};

float cached_on_floor(const World& world, Cache& cache, const LeakSetting& setting, Vec3 p,
                      Rng& rng) {
  const Vec3 up(0, 0, 1);
  if (!setting.asks_in_front) {
    if (const auto E = interpolate_anyway(cache.near(p), p, up, setting.most)) return E->r;
  }
  return cached_irradiance(cache, p, up, setting.most, [&] { return record_at(world, p, rng); }).r;
}

/// Irradiance over pi, seen from above: 1 under an open sky.
struct FloorImage {
  std::vector<double> grey;
  double leaked = 0;  ///< the mean in the dark part
  double records = 0;
};

constexpr int floor_cells = 80;
constexpr float floor_half = 0.5f;

float cell_middle(int i) {
  return (2 * (static_cast<float>(i) + 0.5f) / floor_cells - 1) * floor_half;
}

/// Both sides of the thin wall, row by row, as a renderer scans an image.
FloorImage beside_wall(const World& world, const LeakSetting& setting, Rng rng) {
  Cache cache(setting.most, setting.nearest, setting.farthest);
  FloorImage image;
  for (int row = 0; row < floor_cells; ++row) {
    for (int column = 0; column < floor_cells; ++column) {
      const Vec3 p(cell_middle(column), cell_middle(row), 0);
      const float E = cached_on_floor(world, cache, setting, p, rng);
      image.grey.push_back(static_cast<double>(E / carlo::pi_f));
      if (p.x > 0) image.leaked += image.grey.back() * 2 / (floor_cells * floor_cells);
    }
  }
  image.records = static_cast<double>(cache.records().size());
  return image;
}

/// First the top of the board that covers the chamber, then the floor below it.
double below_board(float height, const LeakSetting& setting, Rng rng) {
  const auto world = chamber(height);
  Cache cache(setting.most, setting.nearest, setting.farthest);
  double leaked = 0;
  constexpr int cells = 24;
  for (const float z : {height * 1.0001f, 0.0f}) {
    for (int i = 0; i < cells * cells; ++i) {
      const int row = i / cells, column = i % cells;
      const Vec3 p(0.5f + static_cast<float>(column) / cells, static_cast<float>(row) / cells, z);
      const float E = cached_on_floor(*world, cache, setting, p, rng);
      if (z == 0) leaked += static_cast<double>(E / carlo::pi_f) / (cells * cells);
    }
  }
  return leaked;
}

void thin_wall(Notebook& notebook) {
  const auto world = chamber(1);
  carlo::Table table({"most", "nearest", "records", "leaked"});
  std::vector<std::string> pictures;
  const auto add = [&](const LeakSetting& setting, bool shown) {
    // The leak depends on where records happen to be made: take the mean of several runs.
    const int runs = notebook.repetitions(64);
    FloorImage image;
    double leaked = 0, records = 0;
    for (int run = 0; run < runs; ++run) {
      image = beside_wall(*world, setting, notebook.rng());
      leaked += image.leaked / runs;
      records += image.records / runs;
    }
    table.add_row({setting.most, setting.nearest,
                   carlo::Cell(fmt::format("{:.0f}", records), records),
                   carlo::percent_cell(leaked, 2)});
    if (!shown) return;
    pictures.push_back(
        carlo::image_tile(fmt::format("most = {}, nearest {}", carlo::number_text(setting.most),
                                      carlo::number_text(setting.nearest)),
                          fmt::format("{:.0f} records, {}\u00a0% leaked", image.records,
                                      carlo::number_text(100 * image.leaked, 2)),
                          carlo::grey_image(image.grey, floor_cells), 1));
  };
  for (const double most : {0.1, 0.2, 0.3, 0.4, 0.6})
    add({most, 0}, most == 0.2 || most == 0.4);
  for (const double nearest : {0.1, 0.3})
    add({0.2, nearest}, true);
  notebook.say(
      "A floor from above: open sky to the left, a dark chamber to the right, and an infinitely "
      "thin wall between them. Near the wall distances are short, so that a record's reach shrinks "
      "with its distance from the wall, and where errors are kept small it ends before the wall. A "
      "lower bound on distances saves records in corners, and takes that protection away.");
  notebook.raw_html(carlo::tiles(pictures));
  notebook.table("thin_wall", table, "What leaks into the dark, in parts of the open sky");
}

void thin_board(Notebook& notebook) {
  carlo::Table table({"height", "asked what is in front", "leaked"}, {"height", "asks", "leaked"});
  for (const float height : {0.1f, 0.03f, 0.005f}) {
    for (const bool asks : {true, false}) {
      LeakSetting setting;
      setting.farthest = 1;
      setting.asks_in_front = asks;
      table.add_row({carlo::number_cell(static_cast<double>(height), 2), asks ? "yes" : "no",
                     carlo::percent_cell(below_board(height, setting, notebook.rng()), 2)});
    }
  }
  notebook.say(
      "A board under the open sky, and the dark floor at some height below it. Records on the "
      "board see far, and their normals are the floor's: for Ward's estimate the floor is next "
      "door. Only the test for records in front keeps them from being used there, and it "
      "tolerates a hundredth of their distance, which here is 1.");
  notebook.table("thin_board", table, "What leaks through a board, in parts of the open sky");
}

}  // namespace

void leak_experiment(Notebook& notebook) {
  notebook.begin("Step g: light that leaks");
  notebook.attempt([&] {
    thin_wall(notebook);
    notebook.progress(2, 3);
    thin_board(notebook);
  });
}

}  // namespace lab09
