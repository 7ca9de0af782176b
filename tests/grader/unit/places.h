#pragma once

#include <filesystem>

/// The worker that misbehaves (fixtures/), and the folder that its probes try to write to. Known to
/// one file alone, as carlo::source_folder() is.
std::filesystem::path fixture_worker();
std::filesystem::path fixture_folder();
