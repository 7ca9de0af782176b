#include "grader/grade/precompiled_header.h"

#include "course/cli/descriptor.h"
#include "grader/grade/compilation.h"
#include "grader/judge/process.h"

#include <fcntl.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <sstream>
#include <system_error>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr const char* include = "#include \"";

/// Returns whether a text includes a header, preceded only by other includes.
bool begins_with(const std::string& text, const std::string& header) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(include + header + "\"")) return true;
    if (!line.empty() && !line.starts_with("//") && !line.starts_with("#include ")) return false;
  }
  return false;
}

/// Returns the header in the lab's folder with which all its stubs begin; empty if there is none.
fs::path common_header(const LabTools& tools) {
  if (tools.stubs.empty() || tools.headers.empty()) return {};
  const std::string begin = include;
  std::istringstream lines(tools.stubs.begin()->second);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(begin)) continue;
    const std::string name = line.substr(begin.size(), line.rfind('"') - begin.size());
    const bool common = std::all_of(tools.stubs.begin(), tools.stubs.end(), [&](const auto& stub) {
      return begins_with(stub.second, name);
    });
    if (common && fs::exists(tools.headers.front() / name)) return tools.headers.front() / name;
  }
  return {};
}

/// Returns the file that g++ reads instead of a header.
fs::path read_ahead(const fs::path& header) {
  return header.string() + ".gch";
}

}  // namespace

void precompile(const LabTools& tools) {
  constexpr std::size_t files_for_which_it_pays = 4;
  const fs::path header = common_header(tools);
  if (header.empty() || tools.stubs.size() < files_for_which_it_pays) return;
  // Each submission has its own process: the first one makes it.
  const Descriptor mine(
      ::open((header.string() + ".begun").c_str(), O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!mine.open()) return;
  const fs::path half = header.string() + ".half";
  std::vector<std::string> argv = compile_command(tools);
  argv.insert(argv.end(), {"-x", "c++-header", "-o", half.string(), header.string()});
  // Only our own code, so no sandbox.
  Limits limits;
  limits.deadline = std::chrono::minutes(3);
  limits.memory_bytes = limits.file_bytes = limits.processes = unlimited;
  std::error_code ec;
  if (run_limited({std::move(argv), {"PATH=/usr/bin:/bin", "LANG=C.UTF-8"}}, limits).succeeded()) {
    fs::permissions(half, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read,
                    ec);
    if (!ec) fs::rename(half, read_ahead(header), ec);
  }
  fs::remove(half, ec);
}

std::string header_ahead(const LabTools& tools, const std::string& text) {
  const fs::path header = common_header(tools);
  std::error_code ec;
  if (header.empty() || !fs::exists(read_ahead(header), ec)) return {};
  const std::string name = header.filename();
  return begins_with(text, name) ? name : "";
}

}  // namespace carlo::grader
