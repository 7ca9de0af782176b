#pragma once

#include "agreement.h"
#include "context.h"
#include "course/viewer/viewer.h"
#include "image/exr.h"
#include "peer_program.h"
#include "peer_scene.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

// Compares another renderer with ours: seconds at equal error on scenes that are the same in both.

namespace bench {

struct Compared {
  std::string name;
  carlo::Scene scene;
  carlo::ExrFile reference;
  double noise = 0;  ///< the reference's part of relMSE
};

/// The scenes of the references that a peer can render, and why the others are left out.
struct Choice {
  std::vector<Compared> scenes;
  std::vector<std::string> left_out;
};
/// Throws Error if there is none, unless scenes are named (Options::peer_scenes).
Choice choose(const Options& options, Peer peer);

/// One of another renderer's ways to render.
struct Contender {
  Peer peer = Peer::cycles;
  PeerProgram program;
  nlohmann::json choices;  ///< options for its program besides the scene
};

/// Several runs of one scene with different seeds.
struct Runs {
  std::vector<carlo::Image> theirs;
  std::vector<double> seconds, rel_mse;
  std::vector<double> our_samples, our_seconds, ratio;  ///< at their error
  carlo::Image ours;
  std::string version;
};

/// Their runs and ours alternate, so that disturbances of the machine affect both. `from` and `to`
/// are fractions of the context's part.
Runs measure(Context& context, const Contender& contender, const Compared& c, std::uint32_t samples,
             int count, double from, double to);

/// A table row: the scene, their time, relMSE, our samples, our time, the ratio, and the agreement
/// of the images (`beside_columns`).
std::vector<carlo::Cell> beside_row(const std::string& scene, const Runs& runs,
                                    const Agreement& agreement);

carlo::Viewer beside_viewer(const std::string& peer, const Compared& c, const Runs& runs);

}  // namespace bench
