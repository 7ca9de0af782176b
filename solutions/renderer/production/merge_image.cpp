#include "renderer/production/merge_image.h"

#include "course/render/outputs.h"
#include "course/render/report.h"
#include "image/exr.h"
#include "renderer/production/reports.h"
#include "renderer/production/resumable_outputs.h"
#include "support/number.h"
#include "support/progress.h"

#include <fmt/core.h>

#include <cstdint>
#include <optional>

namespace carlo {

static RenderReport report_of(const Merge& merge, const RenderResult& result) {
  const PartHeader& part = merge.header();
  RenderReport report = make_report(result);
  report.scene = part.scene;
  report.needs = part.needs;
  report.kernel = part.settings.at("kernel");
  report.expect_light_samples(part.least_light_probability);
  report.sampler = part.settings.at("sampler");
  report.max_depth = number_of<int>(part.settings.at("max_depth")).value_or(0);
  report.seed = number_of<std::uint64_t>(part.settings.at("seed")).value_or(0);
  add_parts(report, part.parts, merge.share());
  return report;
}

std::string write_merged(const Merge& merge, const MergeOutput& how) {
  const PartHeader& part = merge.header();
  const auto reference = read_reference(how.reference, part.grid.width, part.grid.height);
  RenderSettings settings = part.settings;
  settings.erase("version");
  // A render can only be continued from a gapless sequence of first samples.
  const ResumableOutputs outputs(output_stem(how.output, part.scene), settings,
                                 merge.complete() && how.sums);
  RenderResult result = [&] {
    Progress progress("merging", how.progress);
    return merge.run([&](double fraction) { progress.update(fraction); });
  }();
  RenderReport report = report_of(merge, result);
  if (reference) report.reference = compare_with_reference(result, how.reference, *reference);
  outputs.write(result, report);
  ReportLines lines = to_lines(report);
  if (!merge.complete()) lines.emplace_back("missing", merge.missing());
  lines.emplace_back("written", outputs.names(result));
  return to_text(lines);
}

}  // namespace carlo
