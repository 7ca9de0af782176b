#include "course/slurm/array_job.h"
#include "course/slurm/folder_lock.h"
#include "support/atomic_file.h"
#include "support/quotes.h"
#include "temporary_folder.h"

#include <catch2/catch_test_macros.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace carlo::slurm {
namespace {

using common_test::TemporaryFolder;

TEST_CASE("a job's script: a shell takes each word as it is") {
  const std::string script = script_of({.name = "name",
                                        .folder = "/tmp",
                                        .command = {"/bin/it's", "a b", "$HOME"},
                                        .processors = 2,
                                        .megabytes = 2500});
  CHECK(script ==
        "#!/bin/sh\n#SBATCH --ntasks=1 --cpus-per-task=2\n#SBATCH --mem-per-cpu=2500M\n"
        "exec '/bin/it'\\''s' 'a b' '$HOME'\n");
}

TEST_CASE("a word as it is typed is what a shell reads") {
  const TemporaryFolder folder;
  for (const char* word : {"", "plain", "--labs=1,2", "a b", "it's", "'", "$HOME", "~", "a\nb", "*",
                           "#", "\\", "\"", "!x", "caf\xc3\xa9", "-n"}) {
    const std::filesystem::path read = folder.path() / "read";
    const std::string command = "printf %s " + shell_word(word) + " > " + shell_word(read.string());
    REQUIRE(std::system(command.c_str()) == 0);  // NOLINT(cert-env33-c): a shell is what is tested
    std::ifstream file(read);
    CHECK(std::string(std::istreambuf_iterator<char>(file), {}) == word);
  }
  CHECK(shell_word("--labs=1,2") == "--labs=1,2");
}

TEST_CASE("jobs of a name: tasks by their state, arrays once") {
  CHECK(!parse_jobs("").any());
  const Jobs jobs = parse_jobs(
      "12 PENDING Nodes required for job are DOWN, DRAINED\n12 RUNNING None\n"
      "12 COMPLETING None\n15 PENDING Dependency\n");
  CHECK(jobs.waiting == 2);
  CHECK(jobs.running == 2);
  CHECK(jobs.ids == std::vector<std::string>{"12", "15"});
  CHECK(jobs.reason == "Dependency");
}

TEST_CASE("an array's numbers: runs in short") {
  CHECK(array_numbers({}).empty());
  CHECK(array_numbers({7}) == "7");
  CHECK(array_numbers({1, 2, 3, 5, 8, 9}) == "1-3,5,8-9");
}

TEST_CASE("a job's name follows from its folder, through links and dots") {
  const std::string name = job_name("grade", "/tmp/a");
  CHECK(name.starts_with("grade_"));
  CHECK(name == job_name("grade", "/tmp/b/../a"));
  CHECK(name != job_name("grade", "/tmp/b"));
}

/// True if another process could take the lock now.
bool another_takes(const std::filesystem::path& folder, FolderLock::Use use) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(FolderLock::take(folder, use) ? 0 : 1);
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_CASE("a folder's lock: one alone, or several together") {
  using Use = FolderLock::Use;
  const TemporaryFolder folder;
  {
    const auto lock = FolderLock::take(folder.path(), Use::alone);
    REQUIRE(lock);
    CHECK(!another_takes(folder.path(), Use::alone));
    CHECK(!another_takes(folder.path(), Use::together));
    CHECK(FolderLock::holder(folder.path()).starts_with("process "));
  }
  const auto lock = FolderLock::take(folder.path(), Use::together);
  REQUIRE(lock);
  CHECK(!another_takes(folder.path(), Use::alone));
  CHECK(another_takes(folder.path(), Use::together));
}

}  // namespace
}  // namespace carlo::slurm
