#pragma once

#include "numeric/vec.h"

#include <vector>

namespace lab09 {

using carlo::Rgb;
using carlo::Vec3;

/// Irradiance that was computed once.
struct Record {
  Vec3 p, n;
  Rgb E{0};
  double distance = 0;  ///< harmonic mean of the distances of what is seen from p
};

/// Records by their places (a grid or an octree).
class Cache {
 public:
  /// Records reach as far as `most` times their distance, which is put into [nearest, farthest].
  Cache(double most, double nearest, double farthest);
  void add(const Record& record);
  /// The records that may serve at p: all whose reach holds p, and some more.
  std::vector<Record> near(Vec3 p) const;
  const std::vector<Record>& records() const { return records_; }

 private:
  double most_, nearest_, farthest_;
  std::vector<Record> records_;
};

}  // namespace lab09
