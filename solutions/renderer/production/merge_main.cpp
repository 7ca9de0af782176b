// `./carlo merge`: merges parts of a render into its image, or into one part.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "renderer/production/merge.h"
#include "renderer/production/merge_image.h"
#include "renderer/production/part.h"
#include "support/error.h"
#include "support/progress.h"

#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace carlo;
namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> parts;
  std::string output, reference;
  bool partial = false, no_sums = false, quiet = false;
};

void add_options(CommandLine& app, Arguments& a) {
  app.option("parts", a.parts, "what ./carlo render --shard I/N has written, in any order")
      .required();
  app.option("-o,--output", a.output,
             "base name of .png, .exr, .error.png and .json (default: out/SCENE); with the ending "
             ".part they become one part, to be merged again");
  app.flag("--partial", a.partial, "make an image although some samples are missing");
  app.option("--reference", a.reference, "EXR to measure the error against");
  app.flag("--no-sums", a.no_sums, "a smaller EXR, which cannot be resumed");
  app.flag("--quiet", a.quiet, "no progress bar, no report on stdout");
  app.footer("The result is bit-identical to a render on a single machine.");
}

void merge_to_part(const Merge& merge, const Arguments& a) {
  if (a.partial || a.no_sums || !a.reference.empty()) {
    throw Error("--partial, --no-sums and --reference are for images, and {} is a part", a.output);
  }
  const RenderResult result = [&] {
    Progress progress("merging", !a.quiet);
    return merge.run([&](double fraction) { progress.update(fraction); });
  }();
  write_part(a.output, merge.header(), result.film);
  if (a.quiet) return;
  fmt::print("  {:<16} {}: {:.4g} % of all samples, from {} parts\n", "written", a.output,
             100 * merge.share(), merge.header().parts);
}

void merge_to_image(const Merge& merge, const Arguments& a) {
  if (!merge.complete() && !a.partial) {
    throw Error("{} are missing; --partial merges what is there", merge.missing());
  }
  const std::string report = write_merged(
      merge,
      {.output = a.output, .reference = a.reference, .sums = !a.no_sums, .progress = !a.quiet});
  if (!a.quiet) fmt::print("{}", report);
}

}  // namespace

int main(int argc, char** argv) {
  return run_main([&] {
    Arguments arguments;
    CommandLine app("Merges parts of a render: PNG, EXR and a report, or a larger part.",
                    "./carlo merge");
    add_options(app, arguments);
    if (const auto code = app.parse(argc, argv)) return *code;
    const Merge merge(std::vector<fs::path>(arguments.parts.begin(), arguments.parts.end()));
    if (fs::path(arguments.output).extension() == part_suffix) {
      merge_to_part(merge, arguments);
    } else {
      merge_to_image(merge, arguments);
    }
    return 0;
  });
}
