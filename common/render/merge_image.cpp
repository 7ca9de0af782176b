#include "render/merge_image.h"

#include "image/exr.h"
#include "image/metrics.h"
#include "render/outputs.h"
#include "render/report.h"
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
  report.expect_asks(part.least_light_chance);
  report.sampler = part.settings.at("sampler");
  report.max_depth = number_of<int>(part.settings.at("max_depth")).value_or(0);
  report.seed = number_of<std::uint64_t>(part.settings.at("seed")).value_or(0);
  report.parts = part.parts;
  report.share = merge.share();
  return report;
}

std::string write_merged(const Merge& merge, const MergeOutput& how) {
  const PartHeader& part = merge.header();
  std::optional<ExrFile> reference;
  if (!how.reference.empty()) {
    reference = read_exr(how.reference);
    compare(reference->image, Image(part.grid.width, part.grid.height));
  }
  RenderSettings settings = part.settings;
  settings.erase("version");
  // A render goes on from its first samples only.
  const Outputs outputs(output_stem(how.output, part.scene), settings,
                        merge.complete() && how.sums);
  RenderResult result = [&] {
    Progress progress("merging", how.progress);
    return merge.run([&](double fraction) { progress.update(fraction); });
  }();
  RenderReport report = report_of(merge, result);
  if (reference) report.reference = compare_with_reference(result, how.reference, *reference);
  outputs.write(result, report);
  std::string text = to_text(report);
  if (!merge.complete()) text += fmt::format("  {:<16} {}\n", "missing", merge.missing());
  return text + fmt::format("  {:<16} {}\n", "written", outputs.names(result));
}

}  // namespace carlo
