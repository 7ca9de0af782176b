#include "renderer/production/merge_image.h"

#include "course/render/outputs.h"
#include "course/render/report.h"
#include "renderer/production/reports.h"
#include "renderer/production/resumable_outputs.h"
#include "support/number.h"
#include "support/progress.h"

#include <cstdint>
#include <optional>

namespace carlo {

static RenderReport report_of(const Merge& merge, const RenderResult& result) {
  RenderReport report = make_report(result);
  report.scene = merge.scene();
  report.needs = merge.part().needs;
  report.kernel = merge.settings().at("kernel");
  report.expect_asks(merge.part().least_light_chance);
  report.sampler = merge.settings().at("sampler");
  report.max_depth = number_of<int>(merge.settings().at("max_depth")).value_or(0);
  report.seed = number_of<std::uint64_t>(merge.settings().at("seed")).value_or(0);
  tell_parts(report, merge.part().parts, merge.share());
  return report;
}

/// A render can only be continued if it has all its first samples, so an incomplete merge remains a
/// part.
static ResumableOutputs outputs_of(const Merge& merge, const MergeOutput& how) {
  RenderSettings settings = merge.settings();
  std::optional<Part> part;
  if (merge.complete()) {
    settings.erase("version");
  } else {
    part = merge.part();
  }
  return {output_stem(how.output, merge.scene()), settings, how.sums, part};
}

std::string write_merged(const Merge& merge, const MergeOutput& how) {
  const auto reference = read_reference(how.reference, merge.grid().width, merge.grid().height);
  const ResumableOutputs outputs = outputs_of(merge, how);
  const RenderResult result = [&] {
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
