// The verb bench: the suite's measurements.

#include "course/verbs/course.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

/// Of the renderers beside ours, the one thing that comes from PyPI.
const char* const peer_modules[]{"mitsuba==3.9.1", "bpy==5.0.1", "pyluxcore==2.11.2"};

/// Builds what stands beside GSL, which CMake looks for only while it configures.
void build_integrators(Course& course) {
  course.tree.need({"build", "bench"});
  course.building.configure_anew();
  course.building.build({"carlo_bench_integrators"});
}

/// Builds a program of the suite and hands over to it.
[[noreturn]] void become(Course& course, const std::string& program, const Words& before,
                         const Words& words) {
  course.building.build({program});
  Words command = list_of({course.building.program(program)});
  throw HandOver{(command += before) += words};
}

void measure(const Words& command) {
  std::string said;
  const int code = run_gathering(command, {}, said);
  if (code != 0) fail({fs::path(command[0]).filename().string(), " failed"});
}

/// The labs' own programs measure first; carlo_bench reads what they found. Returns its arguments.
Words measured_labs(Course& course, bool full) {
  const fs::path found = course.building.folder() / "bench";
  build_integrators(course);
  course.building.build({"carlo_bench", "lab03_solution"});
  fs::create_directories(found);
  say({"carlo: estimators and generators of labs 03 and 04 ...\n"});
  const std::string integrators = found / "integrators.json",
                    generators = found / "generators.json";
  measure(list_of({course.building.program("carlo_bench_integrators"), "--repetitions",
                   full ? "201" : "51", "--json", integrators}));
  Words lab =
      list_of({course.building.program("lab03_solution"), "--no-page", "--json", generators});
  if (!full) lab.push_back("--quick");
  measure(lab);
  return list_of({"--integrators", integrators, "--generators", generators});
}

/// Everything on one page, or the parts that are wished.
[[noreturn]] void bench_page(Course& course, const Words& words) {
  std::string only = "labs";
  bool full = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (asks_for_help(words[i])) become(course, "carlo_bench", {}, {"--help"});
    if (words[i] == "--full") full = true;
    if (starts_with(words[i], "--only=")) only = words[i].substr(7);
    if (words[i] == "--only" && i + 1 < words.size()) only = words[i + 1];
  }
  const fs::path& root = course.tree.root;
  Words arguments =
      list_of({"--scenes", root / "common/scenes", "--references", root / "tests/references/scenes",
               "--peer-scripts", root / "solutions/renderer/bench/peers", "--scratch",
               course.building.folder() / "bench"});
  arguments += words;
  if (joined({",", only, ","}).find(",labs,") != std::string::npos)
    arguments += measured_labs(course, full);
  become(course, "carlo_bench", arguments, {});
}

/// Other renderers, in a folder of their own: what this Python does not take is not measured.
void install_peers(const Tree& tree, const fs::path& folder) {
  tree.need({"build", "peers"});
  if (!fs::exists(folder / "bin/pip") && run({"python3", "-m", "venv", folder}) != 0)
    fail({"no Python environment in ", folder.string()});
  for (const std::string module : peer_modules) {
    if (fs::exists(folder / module)) continue;
    say({"carlo: installing ", module, " in ", folder, " ...\n"});
    const int code = run({folder / "bin/pip", "install", "--quiet", "--disable-pip-version-check",
                          "--only-binary", ":all:", module},
                         {.output = 2});
    if (code == 0) {
      const std::ofstream done(folder / module);
    } else {
      say({"carlo: no ", module, " for this Python, or no network\n"});
    }
  }
}

/// One of Mitsuba's variants looks for LLVM.
void point_to_llvm() {
  std::error_code ec;
  for (const auto& folder : fs::directory_iterator("/usr/lib", ec)) {
    std::error_code none;
    for (const auto& file : fs::directory_iterator(folder.path(), none)) {
      const std::string name = file.path().filename();
      if (name == "libLLVM-19.so" || name.rfind("libLLVM.so.19", 0) == 0)
        ::setenv("DRJIT_LIBLLVM_PATH", file.path().c_str(), 0);
    }
  }
}

[[noreturn]] void bench_peers(Course& course, const Words& words) {
  for (const std::string& word : words)
    if (asks_for_help(word)) become(course, "carlo_bench", {}, {"--help"});
  const fs::path peers = course.tree.root / "build/peers";
  install_peers(course.tree, peers);
  point_to_llvm();
  Words arguments =
      list_of({"--only", "peers", "--peers", peers / "bin/python", "--page", "out/peers.html"});
  bench_page(course, arguments += words);
}

[[noreturn]] void bench_render(Course& course, const Words& words) {
  // Other instruction sets than this machine's widest are compiled on request.
  for (const std::string& word : words)
    if (starts_with(word, "--kernel")) course.building.every_instruction_set();
  become(course, "carlo_bench_render", {"--references", course.tree.root / "tests/references"},
         words);
}

bool is_for_page(const std::string& word) {
  const std::string option = word.substr(0, word.find('='));
  return word == "--full" || is_one_of(option, {"--only", "--seed", "--page"});
}

}  // namespace

static int bench(Course& course, const Words& words) {
  const std::string what = words.empty() ? "" : words[0];
  if (words.empty() || is_for_page(what)) bench_page(course, words);
  const fs::path& root = course.tree.root;
  const Words rest = behind(words, 1);
  const Words scenes = list_of({"--folder", root / "common/scenes"});
  if (what == "peers") bench_peers(course, rest);
  if (what == "render") bench_render(course, rest);
  if (what == "paths") become(course, "carlo_bench_paths", scenes, rest);
  if (what == "target-error") become(course, "carlo_bench_target_error", scenes, rest);
  if (what == "integrators") {
    build_integrators(course);
    become(course, "carlo_bench_integrators", {}, rest);
  }
  if (what == "build" || what == "tests") {
    Words command = list_of({root / "tests/profile" / joined({what, ".sh"})});
    throw HandOver{command += rest};
  }
  fail(
      {"bench measures everything, or: render, paths, target-error, integrators, build, "
       "tests (got '",
       what, "')"});
}

static const Verb bench_verb("bench", bench);

}  // namespace carlo::verbs
