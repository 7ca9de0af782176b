#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

// Other programs, started and waited for.

namespace carlo {

/// argv of a command, for exec: pointers into its words, and a null.
std::vector<char*> pointers(const std::vector<std::string>& words);

/// A path that leads to the file of this program as it was started. Throws Error where there is
/// none.
std::string own_path();

/// What a program that is started gets. Descriptors: -1 stands for ours.
struct ProgramStart {
  int input = -1, output = -1, error = -1;
  int notices = -1;           ///< descriptor 3, for what is told beside the others; -1: not given
  bool own_group = false;     ///< a process group of its own, with no signal blocked
  bool ends_with_us = false;  ///< it is killed when this thread ends; on Linux alone
};

/// Starts a program (by its path, or a name that is looked for in PATH). Throws Error when there is
/// no process to be had. A program that cannot be run ends with exit code 127.
pid_t start_program(const std::vector<std::string>& words, const ProgramStart& how = {});

/// Waits for a child's end; the status is waitpid()'s. Throws Error when it is no child of ours.
int wait_for(pid_t child);

/// What a program writes to its standard output. Throws Error unless it ends with exit code 0.
std::string output_of(const std::vector<std::string>& words);

}  // namespace carlo
