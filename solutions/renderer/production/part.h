#pragma once

#include "renderer/production/block_set.h"

#include <cstdint>
#include <optional>
#include <string>

namespace carlo {

/// The description of a state that holds only part of a render: one share, or some shares merged.
struct Part {
  std::string needs;              ///< describe() of the scene's needs
  bool lamps = false;             ///< whether paths from lamps are traced
  double least_light_chance = 1;  ///< the integrator's
  /// The shard; nothing for parts merged from different N. `index` is 0 if shares of the same N
  /// were merged.
  std::optional<Shard> shard = {};
  std::uint64_t parts = 1;         ///< number of parts merged into it
  BlockSet blocks = {};            ///< blocks that it holds
  std::uint64_t microseconds = 0;  ///< spent; whole, so that sums do not depend on their order
  int threads = 1;                 ///< the largest number used
};

std::string to_text(const Part& part);

/// Throws Error that begins with `place` if the text is not such a description or makes impossible
/// claims.
Part part_of(const std::string& text, const std::string& place);

/// Describes a part: "shard 3/64" or what else it is.
std::string told(const Part& part);

}  // namespace carlo
