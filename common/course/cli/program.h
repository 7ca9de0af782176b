#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

// Starts other programs and waits for them.

namespace carlo {

/// Builds argv for exec: pointers to the words of a command, then null.
std::vector<char*> pointers(const std::vector<std::string>& words);

/// Returns a path to this program's file as it was started. Throws Error if there is none.
std::string own_path();

/// The environment of a started program. Descriptors: -1 means ours.
struct ProgramStart {
  int input = -1, output = -1, error = -1;
  int notices = -1;           ///< descriptor 3, a further output; -1: not given
  bool own_group = false;     ///< a process group of its own, with no signal blocked
  bool ends_with_us = false;  ///< it is killed when this thread ends; on Linux alone
};

/// Starts a program, given by its path or by a name that is looked up in PATH. Throws Error if no
/// process can be created. A program that cannot be run ends with exit code 127.
pid_t start_program(const std::vector<std::string>& words, const ProgramStart& how = {});

/// Waits for a child to end; returns waitpid()'s status. Throws Error if it is not our child.
int wait_for(pid_t child);

/// Returns what a program writes to its standard output. Throws Error unless it exits with code 0.
std::string output_of(const std::vector<std::string>& words);

}  // namespace carlo
