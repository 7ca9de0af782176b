#pragma once

#include "render/driver.h"
#include "renderer/production/part.h"
#include "renderer/production/settings.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

class StateFile;

/// Parts of one render, each block of samples in at most one of them. The result has the same bits
/// in whatever order they are given and however they were merged before; if no block is missing,
/// those of the render that was never shared out.
class Merge {
 public:
  /// Reads the headers of the parts. Throws Error that names the wrong part and the reason: not a
  /// part, cut short or spoilt, of another render, or with samples that another part holds.
  explicit Merge(const std::vector<std::filesystem::path>& paths);

  // For all parts together.
  const RenderSettings& settings() const { return settings_; }
  const BlockGrid& grid() const { return grid_; }
  const Part& part() const { return part_; }
  const std::string& scene() const { return scene_; }
  bool complete() const { return part_.blocks.count() == grid_.blocks(); }
  /// The fraction of all samples that is present.
  double share() const;
  /// Describes what is missing: "12.5 % of the samples (shards 3/8)".
  std::string missing() const;

  /// Adds the parts' sums, one part after the other. Throws Error if some are spoilt, or if another
  /// file has replaced a part.
  RenderResult run(const std::function<void(double)>& progress = {}) const;

 private:
  struct Place {
    std::filesystem::path path;
    BlockSet blocks;
  };

  void take_in(const StateFile& file);
  void take_in_blocks();
  [[noreturn]] void refuse_overlap(const Place& one, const Place& other) const;

  std::vector<Place> places_;
  RenderSettings settings_;
  BlockGrid grid_;
  std::string scene_;
  Part part_;
  Counts counts_;
  ExactSum lamp_ties_;
};

}  // namespace carlo
