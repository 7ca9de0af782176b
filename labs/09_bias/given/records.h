#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <map>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace lab09 {

using carlo::Rgb;
using carlo::Vec3;

/// A stored irradiance.
struct Record {
  Vec3 p, n;
  Rgb E{0};
  double distance = 0;  ///< harmonic mean of the distances of everything seen from p
};

/// Records by position: grids of cells, each with cells twice as large as the one before. A record
/// lies in all cells of one grid that its reach meets, at most eight, so that a point needs to look
/// into only one cell of each grid.
class Cache {
 public:
  /// A record reaches as far as `most` times its distance.
  Cache(double most, double nearest, double farthest);
  /// Adds a record, with its distance clamped to [nearest, farthest].
  void add(Record record);
  /// The records that may serve at p: all whose reach includes p, and perhaps some more, in the
  /// order in which they were added.
  std::vector<Record> near(Vec3 p) const;
  /// All of them, in the order in which they were added.
  const std::vector<Record>& records() const { return records_; }

 private:
  using Index = std::size_t;  ///< of records_
  using Cell = std::tuple<double, double, double>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  using Grid = std::unordered_map<Cell, std::vector<Index>, CellHash>;

  double reach(const Record& record) const { return most_ * record.distance; }
  void add_serving(std::span<const Index> candidates, Vec3 p, std::vector<Index>& serving) const;

  double most_, nearest_, farthest_;
  std::vector<Record> records_;
  std::map<int, Grid> grids_;      ///< by the logarithm to base 2 of their cells' size
  std::vector<Index> everywhere_;  ///< records that reach farther than any grid's cells
};

}  // namespace lab09
