#include "grader/judge/landlock.h"

#include "support/error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace carlo::grader {

#if defined(__linux__)

namespace {

namespace fs = std::filesystem;

// Documented in the kernel's userspace-api/landlock.rst; the headers of Debian 12 have version 2
// and lack what came later.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;

constexpr std::uint64_t execute = 1 << 0, write_file = 1 << 1, read_file = 1 << 2,
                        read_dir = 1 << 3, make_char = 1 << 6, make_sock = 1 << 9,
                        make_block = 1 << 11, truncate = 1 << 14, ioctl_dev = 1 << 15;

struct RulesetAttributes {
  std::uint64_t files = 0, network = 0, scoped = 0;
};

struct [[gnu::packed]] PathBeneath {
  std::uint64_t allowed;
  std::int32_t folder;
};

/// Returns all file rights of this version, so that everything is denied except what rules allow.
std::uint64_t all_rights(int version) {
  if (version >= 5) return (1ULL << 16) - 1;
  if (version >= 3) return (1ULL << 15) - 1;
  return version == 2 ? (1ULL << 14) - 1 : (1ULL << 13) - 1;
}

}  // namespace

int landlock_version() {
  const long version = ::syscall(create_ruleset, nullptr, 0, 1);
  const char* most = std::getenv("CARLO_LANDLOCK_VERSION");
  const long cap = most == nullptr ? version : std::strtol(most, nullptr, 10);
  return static_cast<int>(std::max(0L, std::min(version, cap)));
}

LandlockRules::LandlockRules() {
  const int version = landlock_version();
  if (version == 0) throw Error("this kernel has no Landlock");
  RulesetAttributes attributes;
  attributes.files = all_rights(version);
  attributes.network = 3;  // binding and connecting over TCP
  attributes.scoped = 3;   // abstract Unix sockets and signals to processes outside
  const std::size_t size = version >= 6 ? 24 : version >= 4 ? 16 : 8;
  const Descriptor low(static_cast<int>(::syscall(create_ruleset, &attributes, size, 0)));
  if (!low.open()) throw Error("Landlock: {}", std::strerror(errno));
  rules_ = low.lifted();
}

void LandlockRules::allow(const fs::path& path, unsigned long long rights) {
  const Descriptor place(::open(path.c_str(), O_PATH | O_CLOEXEC));
  if (!place.open() && errno == ENOENT) return;
  struct stat status {};
  if (!place.open() || ::fstat(place.get(), &status) != 0) {
    throw Error("{}: {}", path.string(), std::strerror(errno));
  }
  rights &= all_rights(landlock_version());
  if (!S_ISDIR(status.st_mode)) rights &= execute | write_file | read_file | truncate | ioctl_dev;
  const PathBeneath rule{rights, place.get()};
  if (::syscall(add_rule, rules_.get(), 1, &rule, 0) != 0) {
    throw Error("Landlock: {}: {}", path.string(), std::strerror(errno));
  }
}

void LandlockRules::allow_reading(const fs::path& path) {
  allow(path, execute | read_file | read_dir);
}

void LandlockRules::allow_writing(const fs::path& folder) {
  allow(folder, ~(execute | make_char | make_block | make_sock | ioctl_dev));
}

void LandlockRules::allow_device(const fs::path& device) {
  allow(device, read_file | write_file);
}

bool restrict_to_landlock_rules(int descriptor) {
  return ::syscall(restrict_self, descriptor, 0) == 0;
}

#else

int landlock_version() {
  return 0;
}

LandlockRules::LandlockRules() {
  throw Error("Landlock is Linux's");
}

void LandlockRules::allow_reading(const std::filesystem::path&) {}
void LandlockRules::allow_writing(const std::filesystem::path&) {}
void LandlockRules::allow_device(const std::filesystem::path&) {}

bool restrict_to_landlock_rules(int) {
  return false;
}

#endif

}  // namespace carlo::grader
