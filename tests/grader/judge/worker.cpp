#include "grader/judge/worker.h"

#include "support/error.h"

#include <unistd.h>

#include <system_error>
#include <utility>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

fs::path checked(const fs::path& program) {
  std::error_code ec;
  fs::path path = fs::canonical(program, ec);
  if (ec || ::access(path.c_str(), X_OK) != 0 || !fs::is_regular_file(path)) {
    throw Error("{}: not a program that can be run", program.string());
  }
  return path;
}

}  // namespace

Worker::Worker(const fs::path& program)
    : program_(checked(program)), sandbox_(Sandbox::strongest({{program_}, {}})) {}

Worker::Worker(const fs::path& program, Level level)
    : program_(checked(program)), sandbox_(Sandbox::at(level, {{program_}, {}})) {}

Worker::Worker(const fs::path& program, Sandbox sandbox)
    : program_(checked(program)), sandbox_(std::move(sandbox)) {}

Outcome Worker::run(const std::vector<std::string>& arguments, const Limits& limits) const {
  std::vector<std::string> argv{program_.string()};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return sandbox_.run(argv, {{program_}, {}}, limits);
}

}  // namespace carlo::grader
