// libFuzzer's two functions. CARLO_FUZZ_TARGET says which of the readers is meant,
// CARLO_FUZZ_FOLDER where files may be put: the target's seeds go to its `seeds`, to begin with.

#include "fuzz/target.h"
#include "support/error.h"

#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

namespace carlo::fuzz {
namespace {

std::vector<std::string> no_seeds() {
  return {};
}

constexpr std::array<Target, 14> all{{
    {"archive", "zip and tar archives that are handed in", read_archive, no_seeds},
    {"exr", "images, and renders to go on with", read_exr, exr_seeds},
    {"frame", "what a worker sends back", read_frame, frame_seeds},
    {"hdr", "images around scenes", read_hdr, no_seeds},
    {"messages", "a compiler's output", read_messages, messages_seeds},
    {"numbers", "numbers in scenes and arguments", read_numbers, no_seeds},
    {"obj", "meshes", read_obj, no_seeds},
    {"params", "a probe's parameters", read_params, params_seeds},
    {"part", "parts of renders", read_part, part_seeds},
    {"ply", "meshes", read_ply, no_seeds},
    {"questions", "what a judge has asked, as JSON", read_questions, questions_seeds},
    {"record", "a graded submission, as JSON", read_record, record_seeds},
    {"scene", "scene files", read_scene, no_seeds},
    {"symbols", "what nm prints", read_symbols, symbols_seeds},
}};

const Target* chosen = nullptr;
std::filesystem::path folder;

double processor_seconds() {
  std::timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string from_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

void choose() {
  const std::string name = from_environment("CARLO_FUZZ_TARGET");
  std::string names;
  for (const Target& target : all) {
    names += fmt::format("  {:10} {}\n", target.name, target.reads);
    if (target.name == name) chosen = &target;
  }
  if (chosen != nullptr) return;
  fmt::print(stderr, "CARLO_FUZZ_TARGET must be one of\n{}", names);
  std::_Exit(1);
}

}  // namespace

void require(bool holds, const char* what) {
  if (holds) return;
  fmt::print(stderr, "FINDING: it does not hold that {}\n", what);
  std::abort();
}

std::filesystem::path as_file(std::string_view bytes, const std::string& name) {
  std::filesystem::path path = folder / name;
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
  return path;
}

}  // namespace carlo::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  using namespace carlo::fuzz;
  choose();
  folder = from_environment("CARLO_FUZZ_FOLDER");
  require(std::filesystem::is_directory(folder / "seeds"), "CARLO_FUZZ_FOLDER/seeds is there");
  int number = 0;
  for (const std::string& seed : chosen->seeds())
    as_file(seed, fmt::format("seeds/own_{}", ++number));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carlo::fuzz;
  const double begun = processor_seconds();
  try {
    chosen->run({reinterpret_cast<const char*>(data), size});
  } catch (const carlo::Error&) {
    // The error has been printed.
  }
  require(processor_seconds() - begun < 1, "an input takes less than a second");
  return 0;
}
