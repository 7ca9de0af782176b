#pragma once

#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// Scenes of which the exact radiance is known, by the hundred. They are written from what a scene
/// means (common/scene), with no look at how the renderer works.
namespace proving {

struct Proof {
  std::string name;             ///< family, what it is, parameters
  carlo::Scene scene;           ///< square film, independent samples
  std::array<double, 3> exact;  ///< the mean of the film; of every pixel but in "spots/film"
  std::uint32_t spp = 256;
  /// What rounding the scene's coordinates to float may change: relative; where the exact value is
  /// 0, the share of samples that may be 1.
  double rounding = 1e-5;
  /// Floats cannot hold this scene, or rounding decides which of two surfaces is hit: to be looked
  /// at, not to be asserted.
  bool limit = false;
  /// Lab 08 asks all lights alike: where few of many matter, it would take too long.
  bool for_lab = true;
};

/// Floors, cards, slabs and convex solids under a uniform sky.
std::vector<Proof> sky_proofs();
/// Solids that shine as much as they absorb of a uniform sky: nothing can be told apart.
std::vector<Proof> open_furnace_proofs();
/// Closed rooms in which every surface shines.
std::vector<Proof> furnace_proofs();
/// Closed rooms with things inside.
std::vector<Proof> furnished_furnace_proofs();
/// Convex lights alone in the dark, which reflect too.
std::vector<Proof> emitter_proofs();
/// Closed rooms that keep a sky or a lit neighbour out.
std::vector<Proof> leak_proofs();
/// A spot of a floor under one lamp.
std::vector<Proof> spot_proofs();
/// A spot of a floor: lamps near and far, many of them, covered ones.
std::vector<Proof> lamp_proofs();
/// Mirrors, glass and Phong's lobe.
std::vector<Proof> polished_proofs();
/// Receiver x side x light x scale, turned and moved.
std::vector<Proof> combination_proofs();

/// A strong and a weak light of every two kinds.
std::vector<Proof> light_pair_proofs();
/// Up to 1e5 lamps of which few matter.
std::vector<Proof> light_crowd_proofs();
/// Lamps under images of a sky; strong lamps outside of Phong's lobe, weak ones in it.
std::vector<Proof> light_choice_proofs();

/// All of the above.
std::vector<Proof> proving_ground();

/// Of a name; the same with every standard library.
std::uint64_t hash_of(const std::string& name);

}  // namespace proving
