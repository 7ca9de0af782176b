#include "course/report/machine.h"

#include <fmt/core.h>

#include <fstream>
#include <thread>

namespace carlo {
namespace {

std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown processor";
}

}  // namespace

std::string machine_text() {
  const unsigned threads = std::thread::hardware_concurrency();
  return fmt::format("{}, {} thread{}", processor_name(), threads, threads == 1 ? "" : "s");
}

std::string instruction_sets_text() {
#if defined(__x86_64__) || defined(__i386__)
  std::string text = __builtin_cpu_supports("sse4.2") != 0 ? "SSE4.2" : "SSE2";
  if (__builtin_cpu_supports("avx2") != 0) text += ", AVX2";
  if (__builtin_cpu_supports("avx512f") != 0) text += ", AVX-512";
  return text;
#elif defined(__aarch64__)
  return "NEON";
#else
  return "not an x86";
#endif
}

std::string compiler_text() {
#ifdef __clang__
  const std::string name =
      fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  const std::string name =
      fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
#ifdef __OPTIMIZE__
  const char* kind = "optimised";
#else
  const char* kind = "not optimised: its times say little";
#endif
  return fmt::format("{}, {}", name, kind);
}

}  // namespace carlo
