#include "grader/grade/settings.h"

#include "course/cli/program.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <gnu/libc-version.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

std::string random_secret() {
  std::array<unsigned char, 32> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Error("no random numbers for a secret: give one with --secret-file");
  }
  std::string text;
  for (const unsigned char byte : bytes)
    text += fmt::format("{:02x}", byte);
  return text;
}

/// Stores the secret next to the marks that follow from it, readable only by their owner.
std::string kept_secret(const fs::path& file) {
  if (!fs::exists(file)) {
    const mode_t before = ::umask(077);
    // If several graders start at once, the first one's secret stays.
    const fs::path own = file.string() + "." + random_secret().substr(0, 16);
    write_file(own, random_secret());
    ::umask(before);
    std::error_code ec;
    fs::create_hard_link(own, file, ec);
    fs::remove(own, ec);
  }
  return read_file(file);
}

std::string version_of(const std::string& program) {
  const std::string text = carlo::output_of({"/usr/bin/env", "LC_ALL=C", program, "--version"});
  return text.substr(0, text.find('\n'));
}

/// Describes in a line what a machine compiles and runs students' code with: compiler, linker, C
/// library and kind of processor. Two machines with the same line give the same marks. Throws Error
/// if there is no such compiler.
std::string toolchain_of(const std::string& compiler) {
  struct utsname system {};
  if (::uname(&system) != 0) throw Error("the system does not tell its kind of processor");
  return fmt::format("{}; {}; glibc {}; {}", version_of(compiler), version_of("ld"),
                     ::gnu_get_libc_version(), static_cast<const char*>(system.machine));
}

}  // namespace

std::string secret_of(const Settings& settings) {
  std::string secret;
  if (!settings.secret_file.empty()) {
    secret = read_file(settings.secret_file);
  } else if (const char* given = std::getenv("CARLO_SECRET")) {
    secret = given;
  } else {
    secret = kept_secret(settings.out / "secret");
  }
  if (secret.empty())
    throw Error("the secret is empty: seeds that follow from it are known to all");
  return secret;
}

Sandbox sandbox_of(const Settings& settings, const CleanTree& clean) {
  // At the level without confinement submissions have the rights of whoever grades.
  const View view{{clean.path() / "tree", clean.path() / "link"}, {}};
  Sandbox sandbox = settings.sandbox == "auto" ? Sandbox::strongest(view)
                                               : Sandbox::at(level_of(settings.sandbox), view);
  if (sandbox.level() == Level::limits && ::geteuid() == 0) {
    throw Error(
        "at the sandbox level \"limits\" submissions would run as root: grade at a stronger level, "
        "or as another user");
  }
  return sandbox;
}

Course course_of(const Settings& settings, const std::vector<CourseLab>& labs,
                 const CleanTree& clean, const Sandbox& sandbox) {
  Course course{settings.tree,
                settings.build,
                labs,
                clean,
                sandbox,
                secret_of(settings),
                settings.deadline,
                toolchain_of(clean.tools(labs.front().lab.number).recipe.compiler),
                ""};
  course.digest = course_digest(course);
  return course;
}

}  // namespace carlo::grader
