#pragma once

#include "render/driver.h"
#include "renderer/production/part.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// Parts of one render, each block of samples in at most one of them. What comes of them has the
/// same bits in whatever order they are given and however they were merged before; where no block
/// is missing, those of the render that was never shared out.
class Merge {
 public:
  /// Reads the parts' headers. Throws Error, which says which part is wrong and why: no part, cut
  /// short or spoilt, one of another render, or of samples that another one holds.
  explicit Merge(const std::vector<std::filesystem::path>& paths);

  /// Of all parts together.
  const PartHeader& header() const { return header_; }
  bool complete() const { return header_.blocks.count() == header_.grid.blocks(); }
  /// Of all samples, how much is there.
  double share() const;
  /// What is missing: "12.5 % of the samples (shards 3/8)".
  std::string missing() const;

  /// Adds the parts' sums, one part after the other. Throws Error if some are spoilt, or another
  /// file has taken a part's place.
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
