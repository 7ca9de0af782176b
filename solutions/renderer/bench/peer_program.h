#pragma once

#include "image/image.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace bench {

/// A program that renders the scene in a file (peer_scene.h), its last argument.
struct PeerProgram {
  std::string name;  ///< "Blender", in messages
  std::vector<std::string> command;
  std::filesystem::path scratch;
};

/// An image rendered by a peer.
struct PeerImage {
  carlo::Image image;
  double seconds;  ///< of one processor, for the samples alone
  std::string version;
};

/// True if the command with these arguments can be started and succeeds.
bool starts(const std::vector<std::string>& command);

/// Gives the program a task and returns its answer, the object in its line "carlo: {...}". `wait`
/// is called a few times a second; if it throws, the program is ended. Throws Error when the
/// program fails, with its last message.
nlohmann::json answer_of(const PeerProgram& peer, const nlohmann::json& task,
                         const std::function<void()>& wait);

/// Renders what peer_scene() describes, with "samples" and "seed", as answer_of() does.
PeerImage render_by(const PeerProgram& peer, nlohmann::json scene,
                    const std::function<void()>& wait);

}  // namespace bench
