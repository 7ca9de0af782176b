#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace carlo::grader {

/// Runs `body` in a child process and returns its result. Archives from strangers are read there: a
/// hole in a library of ours, or a decompression bomb, ends only the child. It has 2 GB of memory,
/// two minutes of processor time and five in all; it writes no file, and if the kernel has Landlock
/// and system call filters, it opens only `readable` and the system's libraries. Throws the body's
/// Error, or one that says how the child ended.
std::string apart(const std::filesystem::path& readable, const std::function<std::string()>& body);

}  // namespace carlo::grader
