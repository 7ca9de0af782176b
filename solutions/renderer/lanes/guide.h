#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace renderer {

/// A vertex of a camera path, noted for a GuideLearner.
struct Visit {
  std::uint32_t path;      ///< its number among those traced at once
  std::uint32_t side;      ///< Guide::sides
  std::array<float, 3> p;  ///< where
  std::array<float, 2> u;  ///< the point of the unit square by which its direction was drawn
  float gathered;          ///< the luminance that the path had found up to here
  float throughput;        ///< luminance of the path's throughput from here
};
using Visits = std::vector<Visit>;

/// Where camera paths find light: for each place of a scene a density of the sample points by which
/// directions are drawn there. A path warps its points by it and divides its throughput by the
/// density (Guo et al., Primary sample space path guiding, 2018), so the mean of no pixel changes,
/// whatever was learnt and whatever the material. MIS weights remain those of the unguided
/// densities: they must add up to 1, not be the best.
///
/// A place is a cell of a grid around what the paths see, with the direction that the surface
/// faces. Its table divides the unit square into `rows` strips of equal probability, and each into
/// `columns` such rectangles: the point (x, y) moves into rectangle (rows x, columns y), which
/// keeps the evenness of Sobol' points.
class Guide {
 public:
  static constexpr std::uint32_t grid = 8;    ///< cells along each axis
  static constexpr std::uint32_t sides = 12;  ///< 4 k + 2 [n_k < 0] + [n_z < 0] for normal n, whose
                                              ///< largest coordinate is n_k (k = 0, 1, 2)
  static constexpr std::uint32_t rows = 8, columns = 16;
  /// The words of a table, one for each rectangle, strip by strip: the left end, the width, the
  /// lower end and the height, in bytes from the upper one on, in units of 1/256.
  static constexpr std::uint32_t table_size = rows * columns;
  /// The share of the points that stay evenly distributed: no density is lower, but for the
  /// rounding of a table's ends.
  static constexpr double even_share = 0.2;

  /// Nothing learnt: points stay where they are.
  Guide();

  /// The number of the place at p on a side.
  std::uint32_t place(const std::array<float, 3>& p, std::uint32_t side) const;

  std::array<float, 3> lower{}, cells_per_unit{};
  std::vector<std::uint32_t> table_of;  ///< for each place, the first word of its table
  std::vector<std::uint32_t> tables;    ///< the first is for places of which nothing is known
};

/// Learns a Guide from unguided paths. The best density is proportional to the root of the mean
/// square of what a path finds from there on (Rath et al., Variance-aware path guiding, 2020).
class GuideLearner {
 public:
  GuideLearner();
  ~GuideLearner();

  /// Adds the visits of paths, given the radiance that each path found in all (rgb rgb ...). The
  /// first call decides what the grid covers.
  void add(const Visits& visits, std::span<const float> radiances);

  Guide learn() const;

 private:
  struct Histograms;
  Guide grid_;
  double per_unit_ = 1;  ///< of the sums of squares
  std::unique_ptr<Histograms> finest_;
};

}  // namespace renderer
