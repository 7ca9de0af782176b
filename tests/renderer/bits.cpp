// carlo_bits: the SHA-256 of each scene's sums, by both techniques, guided, and shared, on each
// instruction set of this machine, and by the scalar kernel. Every machine, compiler and standard
// library must reproduce those in tests/references/bits.txt (written by tests/references/bits.sh).

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "grader/grade/sha256.h"
#include "lane_scenes.h"
#include "render/driver.h"
#include "render/scene_film.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/path_integrator.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace carlo;

// Small enough to take seconds; blocks of 2 samples.
constexpr int width = 48, height = 36;
constexpr std::uint32_t spp = 16;

struct Way {
  std::string name;
  renderer::PathOptions options;
  bool vector_kernel;
};

std::vector<Way> ways() {
  using enum renderer::Technique;
  std::vector<Way> ways;
  ways.push_back({"path", {.spp = spp, .technique = path}, true});
  ways.push_back({"bidirectional", {.spp = spp, .technique = bidirectional}, true});
  ways.push_back({"guided", {.spp = spp, .guidance = renderer::Guidance::always}, true});
  ways.push_back({"shared", {.spp = spp, .choices = {.share = true}}, true});
  ways.push_back({"scalar", {.spp = spp, .kernel = renderer::Kernel::scalar}, false});
  return ways;
}

void add(grader::Sha256& digest, const ExactSum& sum) {
  std::string bytes;
  for (const std::uint32_t word : sum.words()) {
    for (int shift = 0; shift < 32; shift += 8)
      bytes += static_cast<char>(static_cast<unsigned char>(word >> shift));
  }
  digest.add(bytes);
}

/// Digests everything that a render computes: the pixels' exact sums, and its counts.
std::string digest_of(const RenderResult& result) {
  grader::Sha256 digest;
  for (int y = 0; y < result.film.height(); ++y) {
    for (int x = 0; x < result.film.width(); ++x) {
      const PixelSums& sums = result.film.sums(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        add(digest, sums.sum[c]), add(digest, sums.squares[c]);
    }
  }
  add(digest, result.covariance.splats);
  for (const ExactSum& sum : result.covariance.shared) {
    if (!(sum == ExactSum{})) add(digest, sum);
  }
  const Counts& counts = result.counts;
  digest.add(fmt::format("{} {} {} {} {}", counts.paths, counts.rays, counts.light_paths,
                         counts.cut, counts.bad));
  return digest.hex();
}

/// The number of pixels in which two images differ, and the largest difference, relative to the
/// larger value.
std::string difference(const Film& a, const Film& b) {
  int pixels = 0;
  double most = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      double here = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double p = a.mean(x, y, c), q = b.mean(x, y, c);
        if (p != q) here = std::max(here, std::abs(p - q) / std::max(p, q));
      }
      pixels += here > 0 ? 1 : 0;
      most = std::max(most, here);
    }
  }
  return fmt::format("{} of {} pixels, by up to {:.2g}", pixels, a.width() * a.height(), most);
}

/// Digests by "scene way".
using Digests = std::map<std::string, std::string>;

Digests read(const std::string& path) {
  std::istringstream file(read_file(path));
  Digests digests;
  std::string scene, way, digest;
  while (file >> scene >> way >> digest)
    digests[fmt::format("{} {}", scene, way)] = digest;
  return digests;
}

/// Prints the differences; returns true if there are any.
class Comparison {
 public:
  explicit Comparison(std::optional<Digests> expected) : expected_(std::move(expected)) {}

  void look_at(const std::string& name, const Scene& scene, const Way& way) {
    const std::string row = name + " " + way.name;
    renderer::use_instruction_set("");
    std::vector<std::string> sets{""};
    if (way.vector_kernel) sets = renderer::lane_instruction_sets();
    std::optional<Film> first;
    for (const std::string& set : sets) {
      renderer::use_instruction_set(set);
      const auto integrator = renderer::make_path_integrator(scene, way.options);
      const RenderResult result =
          render(*integrator, scene.width, scene.height, {.spp = spp, .progress = false});
      if (result.interrupted) throw Error("interrupted");
      const std::string digest = digest_of(result);
      if (!first) {
        first = result.film;
        found[row] = digest;
        if (expected_ && (*expected_)[row] != digest)
          complain(row, set, "other sums than the file's");
      } else if (digest != found[row]) {
        complain(
            row, set,
            fmt::format("other sums than with {}: {}", sets[0], difference(*first, result.film)));
      }
    }
  }

  Digests found;
  bool same = true;

 private:
  void complain(const std::string& row, const std::string& set, const std::string& what) {
    fmt::print("{}{}: {}\n", row, set.empty() ? "" : ", " + set, what);
    same = false;
  }

  std::optional<Digests> expected_;
};

/// If a ray meets several surfaces at once, the one that the scalar kernel takes depends on the
/// order in which Embree tests them, and that depends on the processor. This scene shows it.
bool depends_on_embree(const std::string& scene, const Way& way) {
  return scene == "polished" && !way.vector_kernel;
}

void write(const std::string& path, const Digests& digests) {
  std::string text;
  for (const auto& [row, digest] : digests)
    text += fmt::format("{} {}\n", row, digest);
  write_file(path, text);
}

}  // namespace

int main(int argc, char** argv) {
  return run_main([&] {
    std::string path;
    bool make = false;
    CommandLine app("Compares the sums of all scenes with those that every machine must reach.",
                    "carlo_bits");
    app.option("file", path, "tests/references/bits.txt").required();
    app.flag("--write", make, "make the file again");
    if (const auto code = app.parse(argc, argv)) return *code;
    Comparison comparison(make ? std::nullopt : std::optional(read(path)));
    std::vector<lane_scenes::Named> scenes = lane_scenes::all();
    for (auto& [name, scene] : scenes) {
      resize(scene, width, height);
      for (const Way& way : ways()) {
        if (way.options.technique == renderer::Technique::bidirectional &&
            !renderer::light_paths_suit(scene))
          continue;
        if (way.options.choices.share && !renderer::LaneScene(scene).can_share()) continue;
        if (!depends_on_embree(name, way)) comparison.look_at(name, scene, way);
      }
    }
    if (comparison.same && make) write(path, comparison.found);
    if (comparison.same) fmt::print("{} rows, all the same\n", comparison.found.size());
    return comparison.same ? 0 : 1;
  });
}
