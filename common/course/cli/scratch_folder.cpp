#include "course/cli/scratch_folder.h"

#include "course/cli/descriptor.h"
#include "support/error.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

Descriptor open_folder(int at, const std::string& name) {
  return Descriptor(
      ::openat(at, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
}

/// Returns the names in a folder except . and .., at most some thousands at a time.
std::vector<std::string> names_in(int folder) {
  constexpr std::size_t most = 10'000;
  std::vector<std::string> names;
  const int again = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const std::unique_ptr<DIR, int (*)(DIR*)> stream(::fdopendir(again), ::closedir);
  if (!stream) return names;
  while (const dirent* entry = ::readdir(stream.get())) {
    const std::string name = static_cast<const char*>(entry->d_name);
    if (name != "." && name != "..") names.push_back(name);
    if (names.size() == most) break;
  }
  return names;
}

/// Returns true if the entry is gone. Anything but a folder is removed at once; a folder gets
/// permissions that allow us to empty it.
bool remove_or_open(int folder, const std::string& name) {
  if (::unlinkat(folder, name.c_str(), 0) == 0) return true;
  struct stat status {};
  const bool known = ::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
  if (known && S_ISDIR(status.st_mode)) ::fchmodat(folder, name.c_str(), 0700, 0);
  return false;
}

/// Removes the files of a folder and moves its folders to `top` under names made from `count`.
/// Returns whether there were any.
bool empty_into(int top, int folder, std::size_t& count) {
  bool progress = false;
  for (const std::string& name : names_in(folder)) {
    const std::string moved = fmt::format(".moved{}", count);
    if (remove_or_open(folder, name) || ::renameat(folder, name.c_str(), top, moved.c_str()) == 0) {
      progress = true;
    }
    ++count;
  }
  return progress;
}

}  // namespace

void remove_below(int top) {
  std::size_t moved = 0;
  for (bool progress = true; progress;) {
    progress = false;
    for (const std::string& name : names_in(top)) {
      if (remove_or_open(top, name)) {
        progress = true;
        continue;
      }
      const Descriptor folder = open_folder(top, name);
      if (folder.open() && empty_into(top, folder.get(), moved)) progress = true;
      if (::unlinkat(top, name.c_str(), AT_REMOVEDIR) == 0) progress = true;
    }
  }
}

ScratchFolder::ScratchFolder() : ScratchFolder(fs::temp_directory_path()) {}

ScratchFolder::ScratchFolder(const fs::path& folder) {
  std::string name = folder / "carlo-scratch-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw Error("{}: {}", name, std::strerror(errno));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  const Descriptor folder = open_folder(AT_FDCWD, path_);
  if (folder.open()) remove_below(folder.get());
  ::rmdir(path_.c_str());
}

}  // namespace carlo
