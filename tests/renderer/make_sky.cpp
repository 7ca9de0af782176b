// carlo_sky FILE: writes the sky of common/scenes/image_light.xml (tests/references/README.md).

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "image/exr.h"
#include "sky.h"

#include <string>

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    std::string file;
    carlo::CommandLine app("Writes the sky of image_light.xml.", "carlo_sky");
    app.option("file", file, "common/scenes/parts/sky.exr").required();
    if (const auto code = app.parse(argc, argv)) return *code;
    carlo::write_exr(file, {sky::image()});
    return 0;
  });
}
