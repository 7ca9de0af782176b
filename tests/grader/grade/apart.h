#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace carlo::grader {

/// Runs `body` in a child of its own and gives what it returned. What strangers packed is read
/// there: a hole in a library of ours, or a bomb, ends the child and nothing else. It has 2 GB of
/// memory, two minutes of processor time and five in all; it writes no file, and where the kernel
/// has Landlock and filters of system calls, it opens nothing but `readable` and the system's
/// libraries. Throws the body's Error, or one that says how the child ended.
std::string apart(const std::filesystem::path& readable, const std::function<std::string()>& body);

}  // namespace carlo::grader
