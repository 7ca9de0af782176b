#pragma once

#include <CLI/CLI.hpp>

#include <optional>

namespace carlo {

/// Parses a command line. Returns an exit code when the program is done already (after --help);
/// throws Error, one line that ends in how to get help, for a bad one.
std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv);

}  // namespace carlo
