// Packages of npm that some verbs need.

#include "course/verbs/course.h"
#include "support/atomic_file.h"

#include <filesystem>
#include <string>

namespace carlo::verbs {

void install_packages(const Tree& tree, const std::string& from, const std::string& to,
                      const std::string& what) {
  namespace fs = std::filesystem;
  const fs::path folder = tree.root / to, lock = tree.root / from / "package-lock.json",
                 installed = folder / "node_modules/.installed";
  const std::string wanted = read_file(lock);
  if (fs::exists(installed) && read_file(installed) == wanted) return;
  tree.need({"npm"});
  say({"carlo: installing ", what, " ...\n"});
  fs::create_directories(folder);
  for (const char* name : {"package.json", "package-lock.json"})
    fs::copy_file(tree.root / from / name, folder / name, fs::copy_options::overwrite_existing);
  std::string said;
  const int code =
      run_gathering(list_of({"bash", "-c", R"(cd "$0" && exec "$@")", folder, "npm", "ci",
                             "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"}),
                    {}, said);
  if (code != 0) {
    say({said});
    fail({"npm could not install ", what, ", which takes a network the first time"});
  }
  write_file(installed, wanted);
}

}  // namespace carlo::verbs
