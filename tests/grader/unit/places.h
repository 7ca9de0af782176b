#pragma once

#include <filesystem>

/// The worker that misbehaves (fixtures/), and the folder that its probes try to write to. Only one
/// file knows the paths, as with carlo::source_folder().
std::filesystem::path fixture_worker();
std::filesystem::path fixture_folder();
