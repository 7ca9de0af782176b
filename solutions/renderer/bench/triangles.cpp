#include "context.h"
#include "course/cli/program.h"
#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "geometry/embree.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"
#include "scenes/knot.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/wall_clock.h"

#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

// The cost of a mesh: memory compared with Embree's own, the time to the first pixel, and the time
// per path.

namespace bench {
namespace {

namespace fs = std::filesystem;
using carlo::Error;
using carlo::Scene;

/// Writes a knot of about `triangles` triangles, and a scene that shows it, flat, under a light;
/// returns the scene's path. The folder must exist. Throws Error.
std::filesystem::path write_knot_scene(const std::filesystem::path& folder, int triangles) {
  const std::string name = fmt::format("knot_{}", triangles);
  carlo::write_knot(folder / (name + ".ply"), triangles);
  std::filesystem::path scene = folder / (name + ".xml");
  carlo::write_file(scene, fmt::format(R"(<scene version="0.6.0">
<integrator type="path"><integer name="maxDepth" value="4"/></integrator>
<sensor type="perspective"><float name="fov" value="40"/>
<transform name="toWorld"><lookat origin="0, 1, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
<sampler type="sobol"><integer name="sampleCount" value="4"/></sampler>
<film type="hdrfilm"><integer name="width" value="128"/><integer name="height" value="128"/>
<rfilter type="box"/></film></sensor>
<bsdf type="twosided" id="white"><bsdf type="diffuse"><rgb name="reflectance" value="0.7"/></bsdf>
</bsdf>
<shape type="ply"><string name="filename" value="{}.ply"/>
<boolean name="faceNormals" value="true"/><ref id="white"/></shape>
<shape type="rectangle"><transform name="toWorld"><rotate x="1" angle="90"/>
<translate y="3"/></transform>
<emitter type="area"><rgb name="radiance" value="8"/></emitter></shape>
</scene>
)",
                                       name));
  return scene;
}

/// The path of this program's file.
std::filesystem::path this_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

double resident_bytes() {
  std::ifstream in("/proc/self/statm");
  double pages = 0, resident = 0;
  in >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

bool add_bytes(void* sum, ssize_t bytes, bool /*post*/) {
  *static_cast<std::atomic<std::int64_t>*>(sum) += bytes;
  return true;
}

/// The memory that Embree alone needs for the scene's meshes: vertices, indices and its tree, built
/// as ours is.
double embree_bytes(const Scene& scene) {
  std::atomic<std::int64_t> sum = 0;
  RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) throw Error("Embree did not start");
  rtcSetDeviceMemoryMonitorFunction(device, add_bytes, &sum);
  RTCScene embree = rtcNewScene(device);
  rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(embree, RTC_BUILD_QUALITY_HIGH);
  for (const carlo::Shape& shape : scene.shapes) {
    const auto* mesh = std::get_if<carlo::Mesh>(&shape.geometry);
    if (mesh == nullptr) continue;
    RTCGeometry geometry = carlo::embree_triangles(device, *mesh);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(embree);
  const auto bytes = static_cast<double>(sum.load());
  rtcReleaseScene(embree);
  rtcReleaseDevice(device);
  return bytes;
}

struct Costs {
  double ours, peak, embree;                  ///< bytes
  double first_pixel, first_pixel_processor;  ///< seconds from the program's start
  double path;                                ///< processor seconds
};

/// Measures in a process of its own, so that one mesh's memory does not hide another's.
Costs measure_apart(const fs::path& scene) {
  const auto c = nlohmann::json::parse(
                     carlo::output_of({this_program().string(), "--mesh-costs", scene.string()}))
                     .get<std::vector<double>>();
  return {c.at(0), c.at(1), c.at(2), c.at(3), c.at(4), c.at(5)};
}

carlo::Cell megabytes(double bytes) {
  return {fmt::format("{} MB", carlo::number_text(bytes / 1e6, 3)), bytes};
}

template <class Member>
Spread spread_of(const std::vector<Costs>& runs, Member member) {
  std::vector<double> values;
  for (const Costs& run : runs)
    values.push_back(run.*member);
  return spread(values);
}

}  // namespace

void print_mesh_costs(const fs::path& path) {
  const carlo::WallClock clock;
  const carlo::Stopwatch stopwatch;
  const double before = resident_bytes();
  const Scene scene = carlo::load_scene(path);
  const auto integrator = renderer::make_path_integrator(scene, {.seed = 1, .spp = 1});
  carlo::Tile tile{scene.width / 2, scene.height / 2, scene.width / 2 + 1, scene.height / 2 + 1};
  tile.samples = 1;
  std::array<std::array<double, 3>, 1> mean{};
  carlo::Counts counts;
  integrator->render(tile, mean, counts);
  const double first = clock.seconds();
  const double processor = stopwatch.seconds();
  const double ours = resident_bytes() - before;
  const double peak = std::max(peak_bytes() - before, ours);
  const Rendered rendered = render_timed(*integrator, scene, 8);
  fmt::print("[{}, {}, {}, {}, {}, {}]\n", ours, peak, embree_bytes(scene), first, processor,
             rendered.seconds / rendered.paths);
}

void bench_triangles(Context& context) {
  context.begin("Scaling: triangles");
  context.page().prose(
      "A torus knot of ever more triangles under a light, without vertex normals. Memory is what the program grows by until its "
      "first pixel, the peak what it had in between; Embree's own is a bare Embree scene of the "
      "same triangles, its vertices and indices among it. Each row is measured in a program of "
      "its own.");
  const std::vector<int> sizes = {1000, 10'000, 100'000, 1'000'000};
  const int runs = context.options().full ? 5 : 3;
  fs::create_directories(context.options().scratch);
  carlo::Table table({"triangles", "memory", "peak", "Embree's own", "ratio", "first pixel",
                      "of processor", "processor time a path"},
                     {"triangles", "bytes", "peak_bytes", "embree_bytes", "ratio", "first_pixel",
                      "first_pixel_processor", "seconds_a_path"});
  carlo::Series path{"a path", {}}, first{"first pixel", {}};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const fs::path scene = write_knot_scene(context.options().scratch, sizes[i]);
    std::vector<Costs> all;
    for (int run = 0; run < runs; ++run)
      all.push_back(measure_apart(scene));
    const double ours = spread_of(all, &Costs::ours).median;
    const double embree = spread_of(all, &Costs::embree).median;
    const double seconds = spread_of(all, &Costs::path).median;
    const double processor = spread_of(all, &Costs::first_pixel_processor).median;
    table.add_row({static_cast<std::int64_t>(sizes[i]), megabytes(ours),
                   megabytes(spread_of(all, &Costs::peak).median), megabytes(embree),
                   embree < 1e6 ? carlo::empty_cell() : carlo::number_cell(ours / embree),
                   carlo::seconds_cell(spread_of(all, &Costs::first_pixel).median),
                   carlo::seconds_cell(processor), carlo::seconds_cell(seconds)});
    path.points.push_back({static_cast<double>(sizes[i]), seconds});
    first.points.push_back({static_cast<double>(sizes[i]), processor});
    context.progress(static_cast<double>(i + 1) / static_cast<double>(sizes.size()));
  }
  context.page().charts({{"Time a path",
                          "one thread, scalar kernel, paths of four segments at most",
                          {"triangles", carlo::Unit::count},
                          {"processor seconds", carlo::Unit::seconds},
                          {path}},
                         {"Time to the first pixel",
                          "reading the mesh, building the tree",
                          {"triangles", carlo::Unit::count},
                          {"processor seconds", carlo::Unit::seconds},
                          {first}}});
  context.table(
      "triangles", table,
      fmt::format("Medians of {} runs; no ratio below a megabyte, where the program's fixed part "
                  "is most of it",
                  runs));
}

}  // namespace bench
