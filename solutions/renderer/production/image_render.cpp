#include "renderer/production/image_render.h"

#include "course/render/outputs.h"
#include "course/render/render_page.h"
#include "render/driver.h"
#include "renderer/production/reports.h"
#include "support/atomic_file.h"

#include <fmt/core.h>

namespace carlo {

ImageRender::ImageRender(const ProductionArguments& arguments, const RenderTask& task,
                         const std::string& command)
    : a_(arguments),
      task_(task),
      command_(command),
      outputs_(output_stem(a_.output, a_.scene), task.settings, !a_.no_sums),
      page_(page_path(a_, outputs_.stem())) {
  if (page_) const AtomicFile writable(*page_);
}

int ImageRender::run(const RenderResult* start) const {
  const RenderOptions options{
      .spp = task_.spp,
      .seconds = a_.seconds,
      .threads = a_.threads,
      .progress = !a_.quiet,
      .earlier = start,
      .checkpoint = [&](const RenderResult& r) { outputs_.checkpoint(r, report_on(r)); },
      .checkpoint_seconds = a_.checkpoint};
  const RenderResult result =
      render(*task_.integrator, task_.scene.width, task_.scene.height, options);
  return finish(result, start != nullptr && start->seconds == 0);
}

int ImageRender::run(const EarlierAdaptive* start) const {
  const AdaptiveOptions options{
      .threads = a_.threads,
      .progress = !a_.quiet,
      .earlier = start,
      .checkpoint = [&](const AdaptiveResult& r) { outputs_.checkpoint(r, report_on(r)); },
      .checkpoint_seconds = a_.checkpoint};
  const AdaptiveResult result =
      render_adaptively(*task_.integrator, task_.scene.width, task_.scene.height,
                        {*a_.target_error, task_.spp, a_.seconds}, options);
  return finish(result, start != nullptr && start->seconds == 0);
}

RenderReport ImageRender::report_on(const RenderResult& result) const {
  RenderReport report = make_report(task_.scene, a_.scene, *task_.integrator, task_.seed, result);
  if (task_.reference)
    report.reference = compare_with_reference(result, a_.reference, *task_.reference);
  return report;
}

RenderReport ImageRender::report_on(const AdaptiveResult& result) const {
  RenderReport report = report_on(static_cast<const RenderResult&>(result));
  add_target(report, result.summary);
  return report;
}

template <class Result>
int ImageRender::finish(const Result& result, bool time_unknown) const {
  const RenderReport report = report_on(result);
  outputs_.write(result, report);
  if (page_) write_render_page(*page_, command_, report, result.film, task_.reference);
  ReportLines lines = to_lines(report);
  for (const std::string& note : task_.scene.notes)
    lines.emplace_back("note", note);
  if (time_unknown) {
    lines.emplace_back(
        "note",
        fmt::format("the time is that of this part: there is no report beside {}", a_.resume));
  }
  lines.emplace_back("written", outputs_.names(result));
  if (page_) lines.emplace_back("page", page_->string());
  if (!a_.quiet) fmt::print("{}", to_text(lines));
  return result.interrupted ? 130 : 0;
}

}  // namespace carlo
