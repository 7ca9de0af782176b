#include "grader/grade/machine.h"

#include "course/cli/scratch_folder.h"
#include "grader/grade/own_disk.h"
#include "grader/judge/landlock.h"
#include "grader/judge/process_list.h"
#include "grader/judge/sandbox.h"
#include "support/error.h"

#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr Level strongest_first[] = {Level::bubblewrap, Level::landlock, Level::user,
                                     Level::limits};

/// The memory that a submission may take (its program, its disk, a judge) and, if it has no disk of
/// its own, the disk space.
constexpr std::size_t memory_of_one = std::size_t{2500} << 20, disk_of_one = std::size_t{512} << 20;

std::string machine_row(const std::string& name, const std::string& text) {
  return fmt::format("{:12} {}\n", name, text);
}

/// Returns the bytes available to programs: the system's figure, within the container's limit.
std::size_t free_memory() {
  std::size_t least = std::numeric_limits<std::size_t>::max();
  std::ifstream info("/proc/meminfo");
  std::string word;
  while (info >> word) {
    std::size_t kilobytes = 0;
    if (word == "MemAvailable:" && info >> kilobytes) least = kilobytes << 10;
  }
  for (const char* file :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream limit(file);
    std::size_t bytes = 0;
    if (limit >> bytes) least = std::min(least, bytes);
  }
  return least;
}

std::size_t free_disk(const fs::path& folder) {
  struct statvfs status {};
  if (::statvfs(folder.c_str(), &status) != 0) return 0;
  return static_cast<std::size_t>(status.f_bavail) * status.f_frsize;
}

bool kernel_tells_of_kills() {
  std::ifstream file("/proc/vmstat");
  for (std::string word; file >> word;) {
    if (word == "oom_kill") return true;
  }
  return false;
}

/// Lists the levels, strongest first; sets `strongest` to the first usable one.
std::string levels_text(std::string& strongest) {
  std::string text;
  for (const Level level : strongest_first) {
    std::string why = Sandbox::trouble_at(level);
    if (level == Level::limits && ::geteuid() == 0) why = "refused: submissions would be root";
    const bool first = why.empty() && strongest.empty();
    if (first) strongest = Sandbox::at(level, {}).description();
    text += machine_row(
        to_string(level),
        why.empty() ? first ? "works; it is the one that is used" : "works" : "no: " + why);
  }
  return text;
}

/// Says what the strongest level may lack.
std::string lacks(bool own_disk) {
  std::string text;
  if (::geteuid() != 0) {
    text += machine_row("own user",
                        "no, for we are not root: processes of all submissions count together");
  } else {
    text += machine_row("own user", "each submission has a user id and folders of its own");
  }
  text += machine_row("own disk",
                      own_disk ? "each submission fills no more than its own, in memory"
                               : "no (it takes root and CAP_SYS_ADMIN): what programs write is "
                                 "looked at ten times a second");
  const int landlock = landlock_version();
  text += machine_row("Landlock", landlock == 0 ? "no"
                                                : fmt::format("version {}{}", landlock,
                                                              landlock < 3 ? "; a filter of system "
                                                                             "calls does the rest"
                                                                           : ""));
  if (own_times().ran <= 0)
    text += machine_row("waiting", "not told: on a busy machine deadlines may be missed; use -j 1");
  if (!kernel_tells_of_kills())
    text += machine_row("memory", "the kernel does not tell when it ends programs for it");
  return text;
}

std::string jobs_text(bool own_disk) {
  const std::size_t memory = free_memory(), disk = free_disk(fs::temp_directory_path());
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  std::size_t most = std::max(std::size_t{1}, memory / memory_of_one);
  if (!own_disk) most = std::max(std::size_t{1}, std::min(most, disk / disk_of_one));
  std::string text =
      machine_row("machine", fmt::format("{} processors, {} MB of memory, {} MB of disk free",
                                         cores, memory >> 20, disk >> 20));
  text +=
      machine_row("jobs", fmt::format("-j {} is best; {} at a time may each take all that they may",
                                      std::min(cores, most), most));
  return text +
         machine_row("", "with more, what the machine cannot bear has no marks and is tried again");
}

}  // namespace

Machine check_machine() {
  std::string strongest;
  std::string text = levels_text(strongest);
  const ScratchFolder scratch;
  bool own_disk = false;
  {
    const OwnDisk disk(scratch.path() / "disk", std::size_t{1} << 20, {});
    own_disk = disk.mounted();
  }
  text += lacks(own_disk) + jobs_text(own_disk);
  text += strongest.empty() ? "no class can be graded here\n" : "sandbox: " + strongest + "\n";
  return {text, !strongest.empty()};
}

}  // namespace carlo::grader
