#include "conventions.h"

#include "image/exr.h"
#include "render/driver.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

namespace fs = std::filesystem;

/// The images that rows name: maps of 8 x 4 texels.
void write_maps(const fs::path& scratch) {
  carlo::Image columns(8, 4), first_row(8, 4), grey(8, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      columns.at(x, y) = carlo::Rgb(static_cast<float>(x + 1));
      first_row.at(x, y) = carlo::Rgb(y == 0 ? 1.0f : 0.1f);
      grey.at(x, y) = carlo::Rgb(0.5f);
    }
  }
  carlo::write_exr(scratch / "columns.exr", {columns});
  carlo::write_exr(scratch / "first_row.exr", {first_row});
  carlo::write_exr(scratch / "grey.exr", {grey});
}

carlo::Scene load(const std::string& inside, const fs::path& scratch) {
  fs::create_directories(scratch);
  write_maps(scratch);
  const fs::path file = scratch / "scene.xml";
  carlo::write_file(file, "<scene version=\"3.0.0\">" + inside + "</scene>\n");
  carlo::Scene scene = carlo::load_scene(file);
  scene.sampler = carlo::SamplerKind::independent;  // its standard errors are unbiased
  return scene;
}

}  // namespace

std::vector<Convention> conventions() {
  std::vector<Convention> all = mitsuba_rows();
  for (const auto& rows : {cycles_rows(), luxcore_rows()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

std::string name_of(Peer peer) {
  switch (peer) {
    case Peer::cycles:
      return "cycles";
    case Peer::mitsuba:
      return "mitsuba";
    case Peer::luxcore:
      return "luxcore";
  }
  throw carlo::Error("a peer without a name");
}

double z_of(const Estimate& a, const Estimate& b) {
  if (a.value == b.value) return 0;
  const double rounding = 1e-5 * std::max(std::abs(a.value), std::abs(b.value));
  return (a.value - b.value) / std::hypot(a.standard_error, b.standard_error, rounding);
}

Estimate our_value(const Convention& row, const fs::path& scratch, std::uint32_t times) {
  const carlo::Scene scene = load(row.scene.shared + row.scene.ours, scratch);
  const std::uint32_t spp = times * row.samples;
  const auto integrator = renderer::make_path_integrator(scene, {.seed = 1, .spp = spp});
  const carlo::RenderResult result = carlo::render(*integrator, scene.width, scene.height,
                                                   {.spp = spp, .threads = 1, .progress = false});
  const carlo::Image mean = result.film.mean(), error = result.film.standard_error();
  const auto [x0, y0, x1, y1] = row.scene.window;
  double sum = 0, squares = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      for (int c = 0; c < 3; ++c) {
        sum += static_cast<double>(mean.at(x, y)[c]) / 3;
        // The channels of a path are as good as equal, and the pixels are independent.
        const double e = error.at(x, y)[c];
        squares += e * e / 3;
      }
    }
  }
  const double pixels = (x1 - x0) * (y1 - y0);
  return {sum / pixels, std::sqrt(squares) / pixels};
}

nlohmann::json peer_task(const Convention& row, const fs::path& scratch) {
  const carlo::Scene scene = load(row.scene.shared + row.scene.stand_in, scratch);
  nlohmann::json task = peer_scene(scene, row.peer);
  const carlo::Vec3& o = scene.camera.origin;
  if (task["camera"]["origin"] != nlohmann::json{o.x, o.y, o.z}) {
    throw carlo::Error("{}: the largest coordinate must lie in [1/2, 1)", row.what);
  }
  task["peer"] = name_of(row.peer);
  task["theirs"] = row.theirs;
  task["samples"] = row.samples;
  task["window"] = row.scene.window;
  task["maps"] = fs::absolute(scratch).string() + "/";
  return task;
}

}  // namespace bench
