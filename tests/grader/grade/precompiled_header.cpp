#include "grader/grade/precompiled_header.h"

#include "cli/atomic_file.h"
#include "cli/descriptor.h"
#include "grader/grade/compilation.h"
#include "grader/judge/process.h"

#include <fcntl.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

bool includes(const std::string& text, const std::string& header) {
  return text.find("#include \"" + header + "\"") != std::string::npos;
}

/// Ours alone is compiled here, outside of the sandbox.
bool run(std::vector<std::string> argv) {
  Limits limits;
  limits.deadline = std::chrono::minutes(3);
  limits.memory_bytes = limits.file_bytes = limits.processes = unlimited;
  return run_limited({std::move(argv), {"PATH=/usr/bin:/bin", "LANG=C.UTF-8"}}, limits).succeeded();
}

bool stub_compiles(const LabTools& tools, const fs::path& header) {
  const fs::path source = header.string() + ".stub.cpp", object = header.string() + ".stub.o";
  write_file(source, tools.stubs.begin()->second);
  std::vector<std::string> argv = compile_command(tools);
  for (const std::string& word :
       {std::string("-include"), header.filename().string(), std::string("-o"), object.string(),
        std::string("-c"), source.string()})
    argv.push_back(word);
  const bool good = run(argv);
  std::error_code ec;
  fs::remove(source, ec);
  fs::remove(object, ec);
  return good;
}

}  // namespace

fs::path common_header(const LabTools& tools) {
  if (tools.stubs.empty() || tools.headers.empty()) return {};
  const std::string begin = "#include \"";
  std::istringstream lines(tools.stubs.begin()->second);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(begin)) continue;
    const std::string name = line.substr(begin.size(), line.rfind('"') - begin.size());
    const bool common = std::all_of(tools.stubs.begin(), tools.stubs.end(),
                                    [&](const auto& stub) { return includes(stub.second, name); });
    if (common && fs::exists(tools.headers.front() / name)) return tools.headers.front() / name;
  }
  return {};
}

fs::path precompiled(const fs::path& header) {
  std::error_code ec;
  const fs::path made = header.string() + ".gch";
  return !header.empty() && fs::exists(made, ec) ? made : fs::path();
}

void precompile(const LabTools& tools) {
  const fs::path header = common_header(tools);
  constexpr std::size_t files_for_which_it_pays = 4;
  if (header.empty() || tools.stubs.size() < files_for_which_it_pays) return;
  // Each submission has a process of its own: the first one makes it.
  const Descriptor mine(
      ::open((header.string() + ".begun").c_str(), O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!mine.open()) return;
  const fs::path made = header.string() + ".gch", half = header.string() + ".half";
  std::vector<std::string> argv = compile_command(tools);
  for (const std::string& word : {std::string("-x"), std::string("c++-header"), std::string("-o"),
                                  half.string(), header.string()})
    argv.push_back(word);
  std::error_code ec;
  if (run(argv)) {
    fs::permissions(half, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read,
                    ec);
    fs::rename(half, made, ec);
    if (!ec && stub_compiles(tools, header)) return;
  }
  fs::remove(half, ec);
  fs::remove(made, ec);
}

}  // namespace carlo::grader
