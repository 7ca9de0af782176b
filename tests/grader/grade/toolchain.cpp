#include "grader/grade/toolchain.h"

#include "cli/error.h"
#include "cli/program.h"

#include <fmt/core.h>
#include <gnu/libc-version.h>
#include <sys/utsname.h>

namespace carlo::grader {

static std::string version_of(const std::string& program) {
  const std::string text = carlo::output_of({"/usr/bin/env", "LC_ALL=C", program, "--version"});
  return text.substr(0, text.find('\n'));
}

std::string toolchain_of(const std::string& compiler) {
  struct utsname system {};
  if (::uname(&system) != 0) throw Error("the system does not tell its kind of processor");
  return fmt::format("{}; {}; glibc {}; {}", version_of(compiler), version_of("ld"),
                     ::gnu_get_libc_version(), static_cast<const char*>(system.machine));
}

}  // namespace carlo::grader
