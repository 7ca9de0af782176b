#pragma once

#include "renderer/production/block_set.h"

#include <cstdint>
#include <optional>
#include <string>

namespace carlo {

/// What a state tells of itself that holds a part of a render alone: a share, or some of them
/// merged.
struct Part {
  std::string needs;              ///< describe() of the scene's
  bool lamps = false;             ///< whether paths from lamps are traced
  double least_light_chance = 1;  ///< the integrator's
  /// How the samples were shared out; nothing for parts that were merged from different N. `index`
  /// is 0 where shares of the same N were merged.
  std::optional<Shard> shard = {};
  std::uint64_t parts = 1;         ///< that were merged in it
  BlockSet blocks = {};            ///< that it holds
  std::uint64_t microseconds = 0;  ///< that were spent: whole ones, so that their sum has no order
  int threads = 1;                 ///< at most
};

std::string to_text(const Part& part);

/// Throws Error that begins with `place` if the text is none, or tells what cannot be.
Part part_of(const std::string& text, const std::string& place);

/// "shard 3/64", or what else a part is.
std::string told(const Part& part);

}  // namespace carlo
