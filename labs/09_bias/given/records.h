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

/// Irradiance that was computed once.
struct Record {
  Vec3 p, n;
  Rgb E{0};
  double distance = 0;  ///< harmonic mean of the distances of what is seen from p
};

/// Records by their places: grids of cells, each twice as large as those of the one before. A
/// record lies in all cells of one grid that its reach meets, eight at most, so that a point has to
/// look into one cell of each grid.
class Cache {
 public:
  /// A record reaches as far as `most` times its distance.
  Cache(double most, double nearest, double farthest);
  /// Puts the record's distance into [nearest, farthest].
  void add(Record record);
  /// The records that may serve at p: all whose reach holds p, and perhaps some more, in the order
  /// in which they were added.
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
  std::map<int, Grid> grids_;      ///< by the logarithm of their cells' size to base 2
  std::vector<Index> everywhere_;  ///< records that reach farther than any grid's cells
};

}  // namespace lab09
