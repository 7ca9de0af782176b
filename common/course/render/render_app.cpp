#include "course/render/render_app.h"

#include "course/cli/arguments.h"
#include "course/render/outputs.h"
#include "course/render/render_arguments.h"
#include "course/render/render_page.h"
#include "course/render/report.h"
#include "render/driver.h"
#include "scene/load_scene.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <filesystem>
#include <optional>
#include <string>

namespace carlo {
namespace {

int run(const RenderArguments& a, const IntegratorFactory& factory, const std::string& command) {
  if (a.seconds && a.spp) throw Error("give --seconds or --spp, not both");
  Scene scene = load_scene(a.scene, parse_definitions(a.definitions));
  apply(a, scene);
  const auto reference = read_reference(a.reference, scene.width, scene.height);
  const std::uint64_t seed = a.seed.value_or(1);
  const auto spp = static_cast<std::uint32_t>(scene.spp);
  const auto integrator = factory(scene, seed, spp);
  const std::filesystem::path stem = output_stem(a.output, a.scene);
  require_writable(stem);
  const auto page = page_path(a, stem);
  if (page) const AtomicFile writable(*page);

  const RenderResult result =
      render(*integrator, scene.width, scene.height,
             {.spp = spp, .seconds = a.seconds, .threads = a.threads, .progress = !a.quiet});
  RenderReport report = make_report(scene, a.scene, *integrator, seed, result);
  if (reference) report.reference = compare_with_reference(result, a.reference, *reference);
  write_outputs(stem, exr_of(result, report), result.film, report);
  if (page) write_render_page(*page, command, report, result.film, reference);

  ReportLines lines = to_lines(report);
  for (const std::string& note : scene.notes)
    lines.emplace_back("note", note);
  lines.emplace_back("written", names_of_outputs(stem));
  if (page) lines.emplace_back("page", page->string());
  if (!a.quiet) fmt::print("{}", to_text(lines));
  return result.interrupted ? 130 : 0;
}

}  // namespace

int render_app(int argc, char** argv, const IntegratorFactory& factory,
               const std::function<void(CommandLine&)>& add_options) {
  RenderArguments arguments;
  CommandLine app("Renders a scene by path tracing: PNG, EXR and a report of error against time.",
                  "./carlo render");
  add_render_options(app, arguments);
  if (add_options) add_options(app);
  if (const auto code = app.parse(argc, argv)) return *code;
  tell_page_from_scene(arguments);
  settle_scene(arguments);
  return run(arguments, factory, command_text(argc, argv));
}

}  // namespace carlo
