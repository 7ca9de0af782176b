#include "renderer/production/reports.h"

#include "course/json/json_fields.h"

#include <fmt/core.h>

#include <string>

namespace carlo {

static std::string target_text(const AdaptiveSummary& a) {
  std::string text =
      fmt::format("{:.3g} % of a pixel: within it are {:.1f} % of the pixels (expected)",
                  100 * a.target, 100 * a.within);
  if (a.capped > 0) {
    text += fmt::format("; {:.1f} % were ended by --spp, --seconds or Ctrl-C", 100 * a.capped);
  }
  return text;
}

static std::string samples_text(const AdaptiveSummary& a) {
  return fmt::format(
      "a pixel: {} to {}, median {}; map: dark blue {}, yellow {}; {:.1f} % of all served "
      "decisions",
      a.least, a.most, a.median, a.least, a.most, 100 * a.decided_only);
}

static void fields(JsonFields& json, const AdaptiveSummary& a) {
  json.also("relative_error", a.target);
  json.also("confidence", 0.95);
  json.also("floor", a.floor);
  json.also("reached", a.within);
  json.also("capped", a.capped);
  json.also("decided_only", a.decided_only);
  json.also("spp_min", std::uint64_t{a.least});
  json.also("spp_median", std::uint64_t{a.median});
  json.also("spp_max", std::uint64_t{a.most});
}

void add_target(RenderReport& report, const AdaptiveSummary& summary) {
  report.light_samples = summary.light_samples;
  report.behind_error = {{"target", target_text(summary)}, {"samples", samples_text(summary)}};
  report.fields.emplace_back([summary](JsonFields& json) { json("target", summary); });
}

void add_parts(RenderReport& report, std::uint64_t parts, double share) {
  report.where = fmt::format("in {} part{}", parts, parts == 1 ? "" : "s");
  report.fields.emplace_back([parts, share](JsonFields& json) {
    json.also("parts", parts);
    json.also("share", share);
  });
  if (share == 1) return;
  std::string text = fmt::format("{:.4g} % of the samples are there", 100 * share);
  if (report.finished < 1) {
    text += fmt::format(
        "; {:.4g} % of the pixels have some, the rest are black; means are over the sampled pixels",
        100 * report.finished);
  }
  report.behind_image = {{"PARTIAL", text}};
}

}  // namespace carlo
