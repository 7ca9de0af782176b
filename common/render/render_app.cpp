#include "render/render_app.h"

#include "cli/arguments.h"
#include "cli/atomic_file.h"
#include "cli/error.h"
#include "cli/number.h"
#include "image/exr.h"
#include "render/driver.h"
#include "render/outputs.h"
#include "render/render_page.h"
#include "render/report.h"
#include "render/resume.h"
#include "render/shard_render.h"
#include "scene/load_scene.h"
#include "scene/sampler_kind.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// Samples a pixel at most with --target-error.
constexpr int default_cap = 1 << 16;

struct Arguments {
  std::string scene, default_scene, output, reference, size, sampler;
  std::vector<std::string> definitions;
  std::optional<std::uint32_t> spp;
  std::optional<double> seconds, target_error;
  std::optional<int> max_depth;
  std::optional<std::string> page;
  std::optional<std::uint64_t> seed;
  int threads = 0;
  bool quiet = false;
  std::string resume;
  double checkpoint = 60;
  bool no_sums = false;
  std::optional<std::string> shard;
};

void add_common_options(CommandLine& app, Arguments& a) {
  app.option("scene", a.scene, "scene file, Mitsuba 0.6-style XML (default: the Cornell box)");
  app.option("--default-scene", a.default_scene).hidden();  // for the script ./carlo
  app.option("--spp", a.spp, "samples a pixel (default: the scene's)").range(1u, 1u << 28);
  app.option("--seconds", a.seconds, "render for about this long instead").range(0.0, 1e7);
  app.option("--target-error", a.target_error,
             "sample each pixel until its relative error is this, such as .01, at 95 % "
             "confidence; --spp (default: 65536) and --seconds are limits then");
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
  app.option("--resume", a.resume,
             "go on with the render in this EXR, with its scene and settings, up to --spp, for "
             "--seconds more, or to its --target-error");
  app.option("--checkpoint", a.checkpoint, "seconds after which a long render's EXR is written")
      .range(0.0, 1e7)
      .show_default();
  app.flag("--no-sums", a.no_sums, "a smaller EXR, which cannot be resumed");
  app.option("--shard", a.shard,
             "the I-th of N shares of the samples alone, into a part, OUTPUT.part, for ./carlo "
             "merge; the same command goes on with a killed one")
      .type_name("I/N");
  app.flag("--quiet", a.quiet, "no progress bar, no report on stdout");
}

int parse_whole(std::string_view text, const std::string& all) {
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

void apply(const Arguments& a, Scene& scene) {
  if (!a.size.empty()) {
    const auto x = std::min(a.size.find('x'), a.size.size());
    const int width = parse_whole(std::string_view(a.size).substr(0, x), a.size);
    const int height =
        parse_whole(std::string_view(a.size).substr(std::min(x + 1, a.size.size())), a.size);
    resize(scene, width, height);
  }
  if (a.target_error) scene.spp = default_cap;
  if (a.spp) scene.spp = static_cast<int>(*a.spp);
  if (a.max_depth) scene.max_depth = *a.max_depth;
  if (!a.sampler.empty()) scene.sampler = sampler_kind(a.sampler);
}

/// `--page SCENE.xml` names the scene, not the page.
void tell_page_from_scene(Arguments& a) {
  if (!a.page || a.page->empty() || fs::path(*a.page).extension() == ".html") return;
  if (!a.scene.empty()) throw Error("--page takes a file that ends in .html, got '{}'", *a.page);
  a.scene = std::exchange(*a.page, "");
}

/// Where the page goes, if one is wanted.
std::optional<fs::path> page_path(const Arguments& a, const fs::path& stem) {
  if (!a.page) return std::nullopt;
  return a.page->empty() ? with_suffix(stem, ".html") : fs::path(*a.page);
}

/// Refuses what does not go together.
void check(const Arguments& a) {
  if (a.shard) {
    const auto refuse = [](bool given, const char* option, const char* why) {
      if (given) throw Error("--shard does not go with {}: {}", option, why);
    };
    refuse(a.seconds.has_value(), "--seconds", "a share is of a number of samples, --spp");
    refuse(a.target_error.has_value(), "--target-error",
           "each pixel's number of samples would hang on those of other shards");
    refuse(!a.resume.empty(), "--resume", "the same command goes on with a killed shard");
    refuse(a.no_sums, "--no-sums", "a part is its sums");
    refuse(!a.reference.empty(), "--reference", "./carlo merge compares, with all the samples");
    refuse(a.page.has_value(), "--page", "a part is no image yet");
  }
  if (a.seconds && a.spp && !a.target_error) {
    throw Error("give --seconds or --spp: both are for --target-error only");
  }
  if (a.target_error && !(*a.target_error > 0 && *a.target_error < 1)) {
    throw Error("--target-error is a fraction between 0 and 1, such as .01, got {}",
                *a.target_error);
  }
}

/// A render goes on as it began: with its target, or without one.
void take_over_target(Arguments& a, const EarlierRender& earlier) {
  const std::optional<double> target = earlier.target_error();
  if (!target) {
    if (a.target_error)
      throw Error("{} has no target error: it goes on by --spp or --seconds", a.resume);
    if (!a.spp && !a.seconds)
      throw Error("--resume goes on up to --spp N or for --seconds S: which?");
    return;
  }
  if (a.target_error.value_or(*target) != *target) {
    throw Error("cannot resume {}: its target error is {}, this render's {}", a.resume, *target,
                *a.target_error);
  }
  a.target_error = target;
  if (!a.spp) a.spp = static_cast<std::uint32_t>(earlier.number("spp_limit"));
}

/// What the command line leaves open is as in the earlier render.
void take_over(Arguments& a, const EarlierRender& earlier) {
  take_over_target(a, earlier);
  if (a.scene.empty()) a.scene = earlier.setting("scene");
  if (a.definitions.empty()) a.definitions = earlier.definitions();
  if (a.size.empty()) a.size = fmt::format("{}x{}", earlier.width(), earlier.height());
  if (a.sampler.empty()) a.sampler = earlier.setting("sampler");
  if (!a.max_depth) a.max_depth = static_cast<int>(earlier.number("max_depth"));
  if (!a.seed) a.seed = earlier.number("seed");
  if (a.output.empty()) a.output = fs::path(a.resume).replace_extension().string() + ".exr";
}

/// The result that a render goes on from.
RenderResult result_of(const EarlierRender& earlier, const Arguments& a, const Scene& scene) {
  if (a.target_error) {
    auto state = std::make_shared<const AdaptiveState>(earlier.adaptive_state());
    RenderResult result{.film = state->film(), .counts = earlier.counts()};
    result.seconds = earlier.seconds(result.film);
    result.adaptive_state = std::move(state);
    return result;
  }
  RenderResult result{
      .film = earlier.film(), .counts = earlier.counts(), .lamp_ties = earlier.lamp_ties()};
  result.seconds = earlier.seconds(result.film);
  const std::uint32_t block = result.film.block();
  const auto pixels =
      static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
  if (a.spp && (*a.spp % block != 0 || *a.spp * pixels <= result.film.samples())) {
    throw Error("--spp {} is no way to go on from {:.6g}: expected more, a multiple of {}", *a.spp,
                static_cast<double>(result.film.samples()) / static_cast<double>(pixels), block);
  }
  return result;
}

int run(Arguments a, const IntegratorFactory& factory, const std::string& command) {
  check(a);
  std::optional<Shard> shard;
  if (a.shard) shard = shard_of(*a.shard);
  std::optional<EarlierRender> earlier;
  if (!a.resume.empty()) {
    earlier.emplace(a.resume);
    take_over(a, *earlier);
  }
  Scene scene = load_scene(a.scene, parse_definitions(a.definitions));
  apply(a, scene);
  std::optional<ExrFile> reference;
  if (!a.reference.empty()) {
    reference = read_exr(a.reference);
    compare(reference->image, Image(scene.width, scene.height));
  }

  const std::uint64_t seed = a.seed.value_or(1);
  const auto spp = static_cast<std::uint32_t>(scene.spp);
  const std::uint32_t planned = earlier ? static_cast<std::uint32_t>(earlier->number("planned_spp"))
                                : a.target_error ? adaptive_strata
                                                 : spp;
  const auto integrator = factory(scene, seed, planned);
  RenderSettings settings =
      render_settings(scene, integrator->name(), seed, planned, a.definitions);
  if (shard) {
    return render_shard(scene, *integrator,
                        {.shard = *shard,
                         .scene = a.scene,
                         .output = a.output,
                         .settings = settings,
                         .spp = spp,
                         .threads = a.threads,
                         .checkpoint_seconds = a.checkpoint,
                         .quiet = a.quiet});
  }
  if (a.target_error) {
    settings["target_error"] = fmt::format("{}", *a.target_error);
    settings["spp_limit"] = std::to_string(spp);
  }
  std::optional<RenderResult> start;
  if (earlier) {
    earlier->require_same(settings);
    start = result_of(*earlier, a, scene);
  }
  const Outputs outputs(output_stem(a.output, a.scene), settings, !a.no_sums);
  const std::optional<fs::path> page = page_path(a, outputs.stem());
  if (page) const AtomicFile writable(*page);
  const auto report_on = [&](const RenderResult& result) {
    RenderReport report = make_report(scene, result);
    report.scene = a.scene;
    report.kernel = integrator->name();
    report.seed = seed;
    if (reference) report.reference = compare_with_reference(result, a.reference, *reference);
    return report;
  };
  const RenderOptions options{
      .spp = spp,
      .seconds = a.seconds,
      .threads = a.threads,
      .progress = !a.quiet,
      .target_error = a.target_error,
      .earlier = start ? &*start : nullptr,
      .checkpoint = [&](const RenderResult& r) { outputs.checkpoint(r, report_on(r)); },
      .checkpoint_seconds = a.checkpoint};
  const RenderResult result = render(*integrator, scene.width, scene.height, options);
  const RenderReport report = report_on(result);
  outputs.write(result, report);
  if (page) write_render_page(*page, command, report, result.film, reference);
  if (!a.quiet) {
    fmt::print("{}", to_text(report));
    for (const std::string& note : scene.notes)
      fmt::print("  {:<16} {}\n", "note", note);
    if (start && start->seconds == 0) {
      fmt::print("  {:<16} the time is that of this part: no report lies beside {}\n", "note",
                 a.resume);
    }
    fmt::print("  {:<16} {}\n", "written", outputs.names(result));
    if (page) fmt::print("  {:<16} {}\n", "page", page->string());
  }
  return result.interrupted ? 130 : 0;
}

}  // namespace

int render_app(int argc, char** argv, const IntegratorFactory& factory,
               const std::function<void(CommandLine&)>& add_options) {
  Arguments arguments;
  CommandLine app("Renders a scene by path tracing: PNG, EXR and a report of error against time.",
                  "./carlo render");
  add_common_options(app, arguments);
  if (add_options) add_options(app);
  if (const auto code = app.parse(argc, argv)) return *code;
  tell_page_from_scene(arguments);
  if (arguments.scene.empty() && arguments.resume.empty()) {
    arguments.scene = arguments.default_scene;
    if (arguments.scene.empty()) throw Error("which scene? (see ./carlo render --help)");
  }
  return run(arguments, factory, command_text(argc, argv));
}

}  // namespace carlo
