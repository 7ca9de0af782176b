// carlo_watch: ./carlo watch. A separate program, so that only those who watch wait for its
// compilation.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/watch/watch.h"

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    carlo::WatchOptions options;
    carlo::CommandLine app("Judges an exercise whenever its file is saved", "./carlo watch");
    app.option("lab", options.lab, "which lab").required();
    app.option("--root", options.root, "the folder of the tree").show_default();
    app.option("--build", options.build, "where ninja builds").required();
    app.flag("--poll", options.look,
             "look at the files, where the system does not tell of changes");
    if (const auto code = app.parse(argc, argv)) return *code;
    return carlo::watch(options);
  });
}
