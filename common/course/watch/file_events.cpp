#include "course/watch/file_events.h"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/inotify.h>
#include <sys/vfs.h>
#endif

#include <algorithm>
#include <array>
#include <cstdint>

namespace carlo {

namespace fs = std::filesystem;

#if defined(__linux__)

bool tells_of_changes(const fs::path& folder) {
  struct statfs status {};
  if (::statfs(folder.c_str(), &status) != 0) return false;
  // File system types of statfs(2); the last three are shared folders of VirtualBox, VMware and
  // Parallels.
  constexpr std::array<std::uint32_t, 15> silent{
      0x6969,      // NFS
      0x517B,      // SMB
      0xFF534D42,  // CIFS
      0xFE534D42,  // SMB2
      0x564C,      // NCP
      0x01021997,  // 9p
      0x65735546,  // FUSE: sshfs, Docker Desktop's shares; also reported by virtiofs
      0x6A656A63,  // virtiofs on some kernels
      0x5346414F,  // AFS
      0x00C36400,  // Ceph
      0x47504653,  // GPFS
      0x794C7630,  // overlay
      0x786F4256, 0xBACBACBC, 0x7C7C6673};
  const auto type = static_cast<std::uint32_t>(status.f_type);
  return std::find(silent.begin(), silent.end(), type) == silent.end();
}

void FileEvents::subscribe() {
  fd_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (fd_ < 0) return;
  for (const fs::path& folder : folders_) {
    // Watches folders, not files: editors write a new file and rename it over the old one.
    constexpr std::uint32_t what = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | IN_DELETE;
    if (::inotify_add_watch(fd_, folder.c_str(), what) >= 0) continue;
    ::close(fd_);
    fd_ = -1;  // too many watches on this machine, for instance
    return;
  }
}

bool FileEvents::has_notification() const {
  bool any = false;
  alignas(inotify_event) std::array<char, 4096> buffer{};
  while (::read(fd_, buffer.data(), buffer.size()) > 0)
    any = true;
  return any;
}

#else

bool tells_of_changes(const fs::path&) {
  return false;
}

void FileEvents::subscribe() {}

bool FileEvents::has_notification() const {
  return false;
}

#endif

FileEvents::FileEvents(std::vector<fs::path> folders, bool look) : folders_(std::move(folders)) {
  seen_ = appearance();
  if (!look && std::all_of(folders_.begin(), folders_.end(), tells_of_changes)) subscribe();
}

FileEvents::~FileEvents() {
  if (fd_ >= 0) ::close(fd_);
}

std::string FileEvents::appearance() const {
  std::vector<std::string> lines;
  for (const fs::path& folder : folders_) {
    std::error_code ec;
    for (const auto& entry : fs::directory_iterator(folder, ec)) {
      struct stat status {};
      if (entry.path().extension() != ".cpp") continue;
      if (::stat(entry.path().c_str(), &status) != 0) continue;
#if defined(__APPLE__)
      const timespec& changed = status.st_mtimespec;
#else
      const timespec& changed = status.st_mtim;
#endif
      lines.push_back(fmt::format("{} {} {}.{:09} {}\n", entry.path().string(), status.st_size,
                                  changed.tv_sec, changed.tv_nsec, status.st_ino));
    }
  }
  std::sort(lines.begin(), lines.end());
  std::string all;
  for (const std::string& line : lines)
    all += line;
  return all;
}

bool FileEvents::happened() {
  if (fd_ >= 0) return has_notification();
  std::string now = appearance();
  const bool changed = now != seen_;
  seen_ = std::move(now);
  return changed;
}

}  // namespace carlo
