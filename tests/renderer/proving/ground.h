#pragma once

#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// Hundreds of scenes with known exact radiance. They are derived from the meaning of scenes
/// (common/scene), without regard to how the renderer works.
namespace proving {

struct Proof {
  std::string name;             ///< family, description, parameters
  carlo::Scene scene;           ///< square film, independent samples
  std::array<double, 3> exact;  ///< the mean of the film; also of every pixel, except in
                                ///< "spots/film"
  std::uint32_t spp = 256;
  /// The possible relative effect of rounding the scene's coordinates to float; if the exact value
  /// is 0, the fraction of samples that may be 1.
  double rounding = 1e-5;
  /// Floats cannot represent this scene, or rounding decides which of two surfaces is hit: its
  /// results are shown, not asserted.
  bool limit = false;
  /// Lab 8 chooses lights half evenly and half by power: where few of many matter, it would take
  /// too long.
  bool for_lab = true;
};

/// Floors, cards, slabs and convex solids under a uniform sky.
std::vector<Proof> sky_proofs();
/// Solids that emit what they absorb of a uniform sky: nothing is distinguishable.
std::vector<Proof> open_furnace_proofs();
/// Closed rooms in which every surface emits.
std::vector<Proof> furnace_proofs();
/// Closed rooms with objects inside.
std::vector<Proof> furnished_furnace_proofs();
/// Convex lights alone in the dark, which also reflect.
std::vector<Proof> emitter_proofs();
/// Closed rooms that keep out a sky or a lit neighbour.
std::vector<Proof> leak_proofs();
/// A spot of a floor under one light.
std::vector<Proof> spot_proofs();
/// A spot of a floor: lights near and far, many lights, covered lights.
std::vector<Proof> light_proofs();
/// Mirrors, glass and Phong's lobe.
std::vector<Proof> polished_proofs();
/// Receiver x side x light x scale, rotated and moved.
std::vector<Proof> combination_proofs();

/// A strong and a weak light for every two kinds.
std::vector<Proof> light_pair_proofs();
/// Up to 1e5 lights, few of which matter.
std::vector<Proof> light_crowd_proofs();
/// Lights under images of a sky; strong lights outside Phong's lobe, weak ones inside.
std::vector<Proof> light_choice_proofs();

/// All of the above.
std::vector<Proof> proving_ground();

/// The hash of a name; the same with every standard library.
std::uint64_t hash_of(const std::string& name);

/// Panels, boxes and balls of sizes from .01 to 3 around a camera, some of which emit, with or
/// without a floor and a sky, in one of several scales. The right image is unknown, but all kernels
/// must agree on it.
carlo::Scene random_scene(std::uint64_t seed);

}  // namespace proving
