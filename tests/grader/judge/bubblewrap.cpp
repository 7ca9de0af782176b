#include "grader/judge/bubblewrap.h"

#include "support/error.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace carlo::grader {

namespace fs = std::filesystem;

const std::vector<fs::path>& system_paths() {
  static const std::vector<fs::path> paths{
      "/usr", "/bin", "/lib", "/lib64", "/etc/ld.so.cache", "/etc/alternatives"};
  return paths;
}

std::vector<std::string> bubblewrap(const std::vector<std::string>& argv, const View& view,
                                    const fs::path& scratch) {
  std::vector<std::string> line{bubblewrap_program,  "--unshare-all",
                                "--die-with-parent", "--new-session",
                                "--cap-drop",        "ALL",
                                "--seccomp",         "4",
                                "--json-status-fd",  "5"};
  const auto add = [&](const std::string& option, const fs::path& path) {
    line.insert(line.end(), {option, path.string(), path.string()});
  };
  for (const fs::path& path : system_paths())
    add("--ro-bind-try", path);
  line.insert(line.end(), {"--proc", "/proc", "--dev", "/dev"});
  for (const fs::path& path : view.readable)
    add("--ro-bind", path);
  add("--bind", scratch);
  // Root's user needs no capability to write kernel settings below /proc/sys, and with them could
  // start programs outside; bubblewrap 0.8 leaves them writable. Folders that bubblewrap makes are
  // in memory that no limit counts: they must not be writable.
  for (const char* path : {"/proc", "/dev", "/"})
    line.insert(line.end(), {"--remount-ro", path});
  line.insert(line.end(), {"--chdir", scratch.string(), "--"});
  line.insert(line.end(), argv.begin(), argv.end());
  return line;
}

#if defined(__linux__)
Descriptor filter_file(const SyscallFilter& filter) {
  const Descriptor low(::memfd_create("filter", MFD_CLOEXEC));
  const std::size_t bytes = filter.program().size() * sizeof(sock_filter);
  if (!low.open() ||
      ::write(low.get(), filter.program().data(), bytes) != static_cast<ssize_t>(bytes) ||
      ::lseek(low.get(), 0, SEEK_SET) != 0) {
    throw Error("the system call filter: {}", std::strerror(errno));
  }
  return low.lifted();
}
#else
Descriptor filter_file(const SyscallFilter&) {
  throw Error("bubblewrap is Linux's");
}
#endif

}  // namespace carlo::grader
