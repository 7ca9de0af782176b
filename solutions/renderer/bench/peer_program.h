#pragma once

#include "image/image.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace bench {

/// A program that renders a scene in a file (peer_scene.h), which is its last argument.
struct PeerProgram {
  std::string name;  ///< "Blender", in messages
  std::vector<std::string> command;
  std::filesystem::path scratch;
};

/// One image by a peer.
struct PeerImage {
  carlo::Image image;
  double seconds;  ///< of one processor, for the samples alone
  std::string version;
};

/// Whether the command with these arguments can be started, and ends well.
bool starts(const std::vector<std::string>& command);

/// Renders what peer_scene() describes, with "samples" and "seed". `wait` is called a few times a
/// second; what it throws ends the program. Throws Error when that fails, with the last thing that
/// it said.
PeerImage render_by(const PeerProgram& peer, nlohmann::json scene,
                    const std::function<void()>& wait);

}  // namespace bench
