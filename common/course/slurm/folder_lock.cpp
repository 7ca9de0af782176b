#include "course/slurm/folder_lock.h"

#include "support/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace carlo::slurm {

namespace fs = std::filesystem;

static std::string myself() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  return fmt::format("process {} on {}", ::getpid(), host.data());
}

std::optional<FolderLock> FolderLock::take(const fs::path& folder, Use use) {
  const fs::path path = folder / ".lock";
  // Opened for writing: file servers grant no exclusive lock on a file that is open for reading
  // only.
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!file.open()) throw Error("cannot write {}: {}", path.string(), std::strerror(errno));
  if (::flock(file.get(), (use == Use::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK || errno == EAGAIN || errno == EACCES) return {};
    throw Error("{}: its file system has no locks ({}); Lustre has them with the option flock",
                folder.string(), std::strerror(errno));
  }
  if (use == Use::alone) {
    // Only for people to read, so a failed write does not matter.
    const std::string who = myself() + "\n";
    if (::ftruncate(file.get(), 0) == 0) [[maybe_unused]]
      const ssize_t written = ::write(file.get(), who.data(), who.size());
  }
  return FolderLock(std::move(file));
}

std::string FolderLock::holder(const fs::path& folder) {
  std::ifstream file(folder / ".lock");
  std::string who;
  std::getline(file, who);
  return who.empty() ? "another process" : who;
}

}  // namespace carlo::slurm
