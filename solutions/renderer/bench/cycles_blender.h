#pragma once

#include "image/image.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace bench {

/// How Blender is started.
struct Blender {
  std::string program;           ///< a path, or a name to be found in PATH
  std::filesystem::path script;  ///< cycles.py
  std::filesystem::path scratch;
};

/// One image by Cycles.
struct CyclesImage {
  carlo::Image image;
  double seconds;  ///< of one processor, for the samples alone
  std::string version;
};

/// Whether the program can be started at all.
bool blender_installed(const Blender& blender);

/// Renders what cycles_scene() describes, with "samples" and "seed", on one thread. `wait` is
/// called a few times a second; what it throws ends Blender. Throws Error when Blender fails, with
/// the last thing that it said.
CyclesImage render_by_cycles(const Blender& blender, nlohmann::json scene,
                             const std::function<void()>& wait);

}  // namespace bench
