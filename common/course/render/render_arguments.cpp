#include "course/render/render_arguments.h"

#include "course/cli/arguments.h"
#include "course/render/outputs.h"
#include "render/scene_film.h"
#include "scene/sampler_kind.h"
#include "support/error.h"
#include "support/number.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace carlo {

namespace fs = std::filesystem;

void add_render_options(CommandLine& app, RenderArguments& a) {
  app.option("scene", a.scene, "scene file, Mitsuba 0.6-style XML (default: the Cornell box)");
  app.option("--default-scene", a.default_scene).hidden();  // for the script ./carlo
  app.option("--spp", a.spp, "samples a pixel (default: the scene's)").range(1u, 1u << 28);
  app.option("--seconds", a.seconds, "render for about this long instead").range(0.0, 1e7);
  app.option("--size", a.size, "film size, WIDTHxHEIGHT (default: the scene's)");
  app.option("--max-depth", a.max_depth, "longest path in segments, 0 for no limit")
      .range(0, 1 << 20);
  app.option("--sampler", a.sampler, "independent, stratified or sobol").one_of(sampler_names());
  app.option("--seed", a.seed, "another seed gives independent noise (default: 1)");
  app.option("--threads", a.threads, "default: one for each core").range(1, 1024);
  app.option("-D,--define", a.definitions, "NAME=VALUE for a $NAME of the scene");
  app.option("-o,--output", a.output,
             "base name of .png, .exr, .error.png and .json (default: out/SCENE)");
  app.option("--reference", a.reference, "EXR to measure the error against");
  app.option("--page", a.page, "also a page to look at the image (default: out/SCENE.html)")
      .words(0, 1)
      .type_name("FILE.html");
  app.flag("--quiet", a.quiet, "no progress bar, no report on stdout");
}

static int parse_whole(std::string_view text, const std::string& all) {
  if (const auto value = number_of<int>(text)) return *value;
  throw Error("--size is WIDTHxHEIGHT, for example 256x256, got '{}'", all);
}

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& definitions) {
  std::map<std::string, std::string> map;
  for (const std::string& d : definitions) {
    const auto equals = d.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw Error("-D takes NAME=VALUE, got '{}'", d);
    }
    if (!map.emplace(d.substr(0, equals), d.substr(equals + 1)).second) {
      throw Error("-D {} was given twice", d.substr(0, equals));
    }
  }
  return map;
}

void apply(const RenderArguments& a, Scene& scene) {
  if (!a.size.empty()) {
    const auto x = std::min(a.size.find('x'), a.size.size());
    const int width = parse_whole(std::string_view(a.size).substr(0, x), a.size);
    const int height =
        parse_whole(std::string_view(a.size).substr(std::min(x + 1, a.size.size())), a.size);
    resize(scene, width, height);
  }
  if (a.spp) scene.spp = static_cast<int>(*a.spp);
  if (a.max_depth) scene.max_depth = *a.max_depth;
  if (!a.sampler.empty()) scene.sampler = sampler_kind(a.sampler);
}

void tell_page_from_scene(RenderArguments& a) {
  if (!a.page || a.page->empty() || fs::path(*a.page).extension() == ".html") return;
  if (!a.scene.empty()) throw Error("--page takes a file that ends in .html, got '{}'", *a.page);
  a.scene = std::exchange(*a.page, "");
}

void settle_scene(RenderArguments& a) {
  if (a.scene.empty()) a.scene = a.default_scene;
  if (a.scene.empty()) throw Error("which scene? (see ./carlo render --help)");
}

std::optional<fs::path> page_path(const RenderArguments& a, const fs::path& stem) {
  if (!a.page) return std::nullopt;
  return a.page->empty() ? with_suffix(stem, ".html") : fs::path(*a.page);
}

}  // namespace carlo
