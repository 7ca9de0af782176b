#include "grader/grade/clean_tree.h"

#include "grader/grade/sha256.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "carlo-grade-";

int locked(const fs::path& folder) {
  const int fd = ::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (fd >= 0 && ::flock(fd, LOCK_EX | LOCK_NB) == 0) return fd;
  if (fd >= 0) ::close(fd);
  return -1;
}

/// Removes the folders of dead graders: nobody holds their locks.
void remove_leftovers() {
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(), ec)) {
    struct stat status {};
    const std::string name = entry.path().filename();
    if (!name.starts_with(prefix) || ::lstat(entry.path().c_str(), &status) != 0) continue;
    const bool ours = S_ISDIR(status.st_mode) && status.st_uid == ::geteuid();
    if (!ours || !fs::exists(entry.path() / "lock", ec)) continue;
    const int lock = locked(entry.path());
    if (lock < 0) continue;
    fs::remove_all(entry.path(), ec);
    ::close(lock);
  }
}

fs::path new_folder() {
  std::string name = fs::temp_directory_path() / (std::string(prefix) + "XXXXXX");
  if (::mkdtemp(name.data()) == nullptr) throw Error("{}: {}", name, std::strerror(errno));
  // The sandbox's user may pass through it to the paths of its view, but not list it.
  fs::permissions(name, fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
  return name;
}

bool is_header(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".hpp";
}

/// The sandbox's user must be able to read the copies, whatever the permissions of our tree's
/// files.
void copy_readable(const fs::path& from, const fs::path& to) {
  fs::copy_file(from, to);
  fs::permissions(to, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read |
                          fs::perms::others_read);
}

void copy_headers_of(const fs::path& from, const fs::path& to) {
  if (fs::exists(to)) return;  // copied for an earlier lab
  fs::create_directories(to);
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    if (!entry.is_regular_file() || !is_header(entry.path())) continue;
    const fs::path copy = to / fs::relative(entry.path(), from);
    fs::create_directories(copy.parent_path());
    copy_readable(entry.path(), copy);
  }
}

bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  (void)rest;
  return end == folder.end();
}

}  // namespace

CleanTree::CleanTree(const fs::path& tree, const fs::path& build,
                     const std::vector<CourseLab>& labs) {
  remove_leftovers();
  path_ = new_folder();
  lock_ = locked(path_);
  for (const CourseLab& lab : labs) {
    LabTools& tools = tools_[lab.lab.number];
    tools.recipe = recipe_of(build, lab);
    tools.name_space = "lab" + lab.number();
    copy_headers(tree, tools);
    copy_inputs(lab, tools);
    for (const std::string& file : lab.files)
      tools.stubs[file] = read_file(tree / "labs" / lab.folder / file);
    read_solutions(tree / "solutions" / lab.folder, lab, tools);
    tools.solution_objects = path_ / "solutions" / lab.folder;
    fs::create_directories(tools.solution_objects);
    // Its path can be guessed: no program of a submission may read it, whatever the sandbox's
    // level.
    fs::permissions(tools.solution_objects, fs::perms::owner_all);
  }
  digest_ = digest_of_files();
}

CleanTree::~CleanTree() {
  std::error_code ec;
  fs::remove_all(path_, ec);
  if (lock_ >= 0) ::close(lock_);
}

void CleanTree::copy_headers(const fs::path& tree, LabTools& tools) {
  for (fs::path& folder : tools.recipe.includes) {
    if (!is_below(folder, tree)) {
      if (!is_below(folder, "/usr")) tools.headers.push_back(folder);
      continue;
    }
    const fs::path copy = path_ / "tree" / fs::relative(folder, tree);
    copy_headers_of(folder, copy);
    folder = copy;
    tools.headers.push_back(copy);
  }
}

void CleanTree::read_solutions(const fs::path& folder, const CourseLab& lab, LabTools& tools) {
  const bool needed = std::any_of(lab.lab.exercises.begin(), lab.lab.exercises.end(),
                                  [](const Exercise& exercise) { return !exercise.uses.empty(); });
  const bool there = std::all_of(lab.files.begin(), lab.files.end(), [&](const std::string& file) {
    return fs::exists(folder / file);
  });
  if (!needed || !there) return;
  for (const std::string& file : lab.files)
    tools.solutions[file] = read_file(folder / file);
}

void CleanTree::copy_inputs(const CourseLab& lab, LabTools& tools) {
  const fs::path folder = path_ / "link" / lab.folder;
  fs::create_directories(folder);
  int count = 0;
  for (Recipe::Word& word : tools.recipe.link) {
    if (!word.file || is_below(word.text, "/usr")) continue;
    const fs::path input = word.text;
    const fs::path copy = folder / fmt::format("{}_{}", ++count, input.filename().string());
    copy_readable(input, copy);
    word.text = copy.string();
    tools.inputs.push_back(copy);
  }
}

std::string CleanTree::digest_of_files() const {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path_)) {
    if (entry.is_regular_file() && entry.path().filename() != "lock") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  Sha256 digest;
  for (const fs::path& file : files) {
    digest.add_text(fs::relative(file, path_).string());
    digest.add_text(read_file(file));
  }
  for (const auto& [number, tools] : tools_) {
    for (const std::string& flag : tools.recipe.flags)
      digest.add_text(flag);
    for (const auto* texts : {&tools.stubs, &tools.solutions})
      for (const auto& [name, text] : *texts)
        digest.add_text(text);
  }
  return digest.hex();
}

}  // namespace carlo::grader
