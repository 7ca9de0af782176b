// The verbs bench and fuzz: the suite's measurements, and random bytes for all code that reads
// input from outside.

#include "course/verbs/course.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

/// Another renderer: what --peer calls it, and its Python module, installed from PyPI. Without a
/// name: what all their scripts need.
struct PeerModule {
  std::string name, module;
};
const PeerModule peer_modules[]{{"", "numpy<3"},
                                {"mitsuba", "mitsuba==3.9.1"},
                                {"cycles", "bpy==5.0.1"},
                                {"luxcore", "pyluxcore==2.11.2"}};

/// Builds a program of the suite and replaces this process with it.
[[noreturn]] void become(Course& course, const std::string& program, const Words& before,
                         const Words& words) {
  course.building.build({program});
  Words command = list_of({course.building.program(program)});
  throw HandOver{(command += before) += words};
}

/// Puts all measurements on one page, or those that were asked for.
[[noreturn]] void bench_page(Course& course, const Words& words) {
  for (const std::string& word : words)
    if (asks_for_help(word)) become(course, "carlo_bench", {}, {"--help"});
  const fs::path& root = course.tree.root;
  Words arguments =
      list_of({"--scenes", root / "common/scenes", "--references", root / "tests/references/scenes",
               "--peer-scripts", root / "solutions/renderer/bench/peers", "--scratch",
               course.building.folder() / "bench"});
  become(course, "carlo_bench", arguments, words);
}

/// Installs other renderers in a folder of their own; a renderer that this Python cannot install is
/// not measured. `only`: one of them, or "" for all.
void install_peers(const Tree& tree, const fs::path& folder, const std::string& only) {
  tree.need({"build", "peers"});
  if (!fs::exists(folder / "bin/pip") && run({"python3", "-m", "venv", folder}) != 0)
    fail({"no Python environment in ", folder.string()});
  for (const auto& [name, module] : peer_modules) {
    if (!only.empty() && !name.empty() && only != name) continue;
    if (fs::exists(folder / module)) continue;
    say({"carlo: installing ", module, " in ", folder, " ...\n"});
    const int code = run({folder / "bin/pip", "install", "--quiet", "--disable-pip-version-check",
                          "--only-binary", ":all:", module},
                         {.output = 2});
    if (code == 0) {
      const std::ofstream done(folder / module);
    } else {
      say({"carlo: cannot install ", module, ": no network, or no build for this Python\n"});
    }
  }
}

/// The word behind an option, or behind its "="; "" if it is not among the words.
std::string value_of(const std::string& option, const Words& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].starts_with(option + "=")) return words[i].substr(option.size() + 1);
    if (words[i] == option && i + 1 < words.size()) return words[i + 1];
  }
  return "";
}

/// One of Mitsuba's variants needs to find LLVM.
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

[[noreturn]] void bench_peers(Course& course, Words words) {
  const auto conventions = std::find(words.begin(), words.end(), "--conventions");
  const bool table = conventions != words.end();
  const std::string program = table ? "carlo_bench_conventions" : "carlo_bench";
  if (table) words.erase(conventions);
  for (const std::string& word : words)
    if (asks_for_help(word)) become(course, program, {}, {"--help"});
  const fs::path peers = course.tree.root / "build/peers";
  install_peers(course.tree, peers, value_of("--peer", words));
  point_to_llvm();
  if (table) {
    become(course, program,
           list_of({"--python", peers / "bin/python", "--peer-scripts",
                    course.tree.root / "solutions/renderer/bench/peers"}),
           words);
  }
  Words arguments =
      list_of({"--only", "peers", "--peers", peers / "bin/python", "--page", "out/peers.html"});
  bench_page(course, arguments += words);
}

[[noreturn]] void bench_render(Course& course, const Words& words) {
  // Instruction sets other than the widest of this machine are compiled on request.
  for (const std::string& word : words)
    if (word.starts_with("--kernel")) course.building.every_instruction_set();
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
  if (what == "peers") bench_peers(course, rest);
  if (what == "render") bench_render(course, rest);
  if (what == "build" || what == "tests") {
    Words command = list_of({root / "tests/profile" / joined({what, ".sh"})});
    throw HandOver{command += rest};
  }
  fail({"bench takes options for the whole page, or one of render, peers, build, tests (got '",
        what, "')"});
}

static const Verb bench_verb("bench", bench);

static int fuzz(Course& course, const Words& words) {
  const fs::path& root = course.tree.root;
  course.tree.need({"build", "develop"});
  Building fuzzed(course.tree, "fuzz");
  fuzzed.build({"carlo_fuzz", "carlo_render"});
  Words command = list_of(
      {root / "tests/fuzz/run.sh", "--build", fuzzed.folder(), "--keep", root / "out/fuzz"});
  throw HandOver{command += words};
}

static const Verb fuzz_verb("fuzz", fuzz);

}  // namespace carlo::verbs
