#include "course/render/render_page.h"

#include "course/report/format.h"
#include "course/report/machine.h"
#include "course/viewer/viewer.h"
#include "image/flip.h"
#include "support/quotes.h"

#include <fmt/core.h>

#include <string_view>

namespace carlo {
namespace {

/// The most important numbers of each kind: never a time without its error.
std::string summary(const RenderReport& r) {
  std::string text = fmt::format("{} x {} pixels, {:.6g} samples each, in {}; ", r.width, r.height,
                                 r.spp, duration_text(r.seconds));
  if (r.reference) {
    return text + fmt::format("relMSE {} against the reference",
                              number_text(r.reference->error.rel_mse, 3));
  }
  return text + fmt::format("standard error of a pixel {} % of the mean",
                            number_text(100 * r.relative_error, 2));
}

Viewer make_viewer(const Film& film, const std::optional<ExrFile>& reference) {
  Viewer viewer;
  viewer.caption = reference ? "The render and the reference" : "The render";
  viewer.images = {{"Render", film.mean(), film.standard_error()}};
  if (reference) {
    viewer.note = "The left side can also show how the render differs from the reference.";
    viewer.reference = {"Reference", reference->image, reference->standard_error};
  } else {
    viewer.note = "The left side can also show where the noise is.";
  }
  return viewer;
}

/// The report as an HTML list; its lines are too long for a table on a phone.
std::string numbers_html(const RenderReport& report, const Film& film,
                         const std::optional<ExrFile>& reference) {
  std::string html = "<dl>\n";
  const auto line = [&html](const std::string& name, const std::string& value) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_escaped(name), html_escaped(value));
  };
  for (const auto& [name, value] : to_lines(report))
    line(name, value);
  if (reference) {
    const double flip = mean_flip(flip_map(film.mean(), reference->image));
    line("FLIP", number_text(flip, 3) + ", mean over the pixels");
  }
  return html + "</dl>\n";
}

}  // namespace

void write_render_page(const std::filesystem::path& path, const std::string& command,
                       const RenderReport& report, const Film& film,
                       const std::optional<ExrFile>& reference) {
  const std::string name = std::filesystem::path(report.scene).stem().string();
  Page page(name, summary(report));
  page.section("Image");
  if (report.interrupted) page.note("The render was interrupted: this is what was finished.");
  add_viewer(page, make_viewer(film, reference));
  page.section("Numbers");
  page.raw_html(numbers_html(report, film, reference));
  page.fact("Command", command);
  page.fact("Kernel", report.kernel);
  page.fact("Seed", std::to_string(report.seed));
  page.fact("Machine", machine_text());
  page.fact("Vector instructions", instruction_sets_text());
  page.fact("Compiler", compiler_text());
  page.write(path);
}

std::string command_text(int argc, char** argv) {
  std::string command = "./carlo render";
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--default-scene") {
      ++i;  // from the script ./carlo, not typed by the reader
      continue;
    }
    command += ' ' + shell_word(argv[i]);
  }
  return command;
}

}  // namespace carlo
