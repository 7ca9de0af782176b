#pragma once

#include "render/driver.h"
#include "renderer/production/part.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// Parts of one render, each block of samples in at most one of them. The result has the same bits
/// in whatever order they are given and however they were merged before; if no block is missing,
/// the bits of the render on one machine.
class Merge {
 public:
  /// Reads the parts' headers. Throws Error, which names the part that is wrong and says why: not a
  /// part, truncated, corrupt, of another render, or holding samples that another part holds.
  explicit Merge(const std::vector<std::filesystem::path>& paths);

  /// Returns the header of all parts together.
  const PartHeader& header() const { return header_; }
  bool complete() const { return header_.blocks.count() == header_.grid.blocks(); }
  /// Returns the fraction of all samples that the parts hold.
  double share() const;
  /// Describes what is missing: "12.5 % of the samples (shards 3/8)".
  std::string missing() const;

  /// Adds the parts' sums, one part after the other. Throws Error if some are corrupt, or if a part
  /// has been replaced by another file.
  RenderResult run(const std::function<void(double)>& progress = {}) const;

 private:
  struct Part {
    std::filesystem::path path;
    BlockSet blocks;
  };

  void take_in(const PartHeader& part);
  void take_in_blocks();
  [[noreturn]] void refuse_overlap(std::size_t a, std::size_t b) const;

  std::vector<Part> parts_;
  PartHeader header_;
};

}  // namespace carlo
