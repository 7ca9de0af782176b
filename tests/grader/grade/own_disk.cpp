#include "grader/grade/own_disk.h"

#include "support/error.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// As many as the watcher lets a program create, plus some of ours.
constexpr int most_files = 110'000;

bool mount_over(const fs::path& folder, std::size_t bytes) {
  if (::geteuid() != 0 || ::unshare(CLONE_NEWNS) != 0) return false;
  // Mounts from here on are visible to nobody else.
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_SLAVE, nullptr) != 0) return false;
  const std::string options = fmt::format("size={},nr_inodes={},mode=0700", bytes, most_files);
  return ::mount("carlo", folder.c_str(), "tmpfs", MS_NOSUID | MS_NODEV, options.c_str()) == 0;
}

}  // namespace

OwnDisk::OwnDisk(fs::path folder, std::size_t bytes, std::optional<uid_t> owner)
    : folder_(std::move(folder)) {
  fs::create_directories(folder_);
  mounted_ = mount_over(folder_, bytes);
  open_to_pass(folder_, owner);
}

OwnDisk::~OwnDisk() {
  if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
}

void open_to_pass(const fs::path& folder, std::optional<uid_t> user) {
  if (::chmod(folder.c_str(), user ? 0710 : 0700) != 0 ||
      (user && ::chown(folder.c_str(), ::geteuid(), *user) != 0)) {
    throw Error("{}: {}", folder.string(), std::strerror(errno));
  }
}

}  // namespace carlo::grader
