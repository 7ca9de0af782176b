#include "given/records.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace lab09 {
namespace {

/// Code that computes distances in float must find everything nearby that seems to reach, so
/// reaches are slightly enlarged.
constexpr double room = 1 + 1e-5;
/// The range of reaches for which positions are distinguished: below the smallest one cells would
/// be finer than floats, above the largest they would hold everything.
constexpr double least_reach = 0x1p-100, most_reach = 0x1p100;

/// The number of doublings that make a cell as wide as the reach to both sides.
int level_of(double reach) {
  int exponent = 0;
  std::frexp(2 * room * std::max(reach, least_reach), &exponent);
  return exponent;
}

/// The cell's number along one axis. Cells are powers of 2 wide, so this is exact.
double cell_at(double x, int level) {
  return std::floor(std::ldexp(x, -level));
}

/// The cells that [x - reach, x + reach] meets: one, or two neighbours.
struct Span {
  double cells[2];
  int count;

  Span(double x, double reach, int level)
      : cells{cell_at(x - reach, level), cell_at(x + reach, level)},
        count(cells[0] == cells[1] ? 1 : 2) {}
};

double distance(Vec3 a, Vec3 b) {
  return glm::length(glm::dvec3(a) - glm::dvec3(b));
}

}  // namespace

std::size_t Cache::CellHash::operator()(const Cell& cell) const {
  const std::hash<double> hash;
  const auto [x, y, z] = cell;
  std::size_t mixed = hash(x);
  for (const double next : {y, z})
    mixed = mixed * 0x9e3779b97f4a7c15 + hash(next);
  return mixed ^ mixed >> 29;
}

Cache::Cache(double most, double nearest, double farthest)
    : most_(most), nearest_(nearest), farthest_(farthest) {}

void Cache::add(Record record) {
  record.distance = std::clamp(record.distance, nearest_, farthest_);
  const Index index = records_.size();
  records_.push_back(record);
  const double r = room * reach(record);
  if (!(r >= 0)) return;
  if (r > most_reach) {
    everywhere_.push_back(index);
    return;
  }
  const int level = level_of(reach(record));
  const Vec3 p = record.p;
  const Span x(static_cast<double>(p.x), r, level), y(static_cast<double>(p.y), r, level),
      z(static_cast<double>(p.z), r, level);
  Grid& grid = grids_[level];
  for (int i = 0; i < x.count; ++i) {
    for (int j = 0; j < y.count; ++j) {
      for (int k = 0; k < z.count; ++k)
        grid[{x.cells[i], y.cells[j], z.cells[k]}].push_back(index);
    }
  }
}

void Cache::add_serving(std::span<const Index> candidates, Vec3 p,
                        std::vector<Index>& serving) const {
  for (const Index i : candidates) {
    if (distance(records_[i].p, p) <= room * reach(records_[i])) serving.push_back(i);
  }
}

std::vector<Record> Cache::near(Vec3 p) const {
  std::vector<Index> serving;
  add_serving(everywhere_, p, serving);
  for (const auto& [level, grid] : grids_) {
    const auto found = grid.find({cell_at(static_cast<double>(p.x), level),
                                  cell_at(static_cast<double>(p.y), level),
                                  cell_at(static_cast<double>(p.z), level)});
    if (found != grid.end()) add_serving(found->second, p, serving);
  }
  // The order in which values are added up must not depend on the grid that a record lies in.
  std::sort(serving.begin(), serving.end());
  std::vector<Record> records;
  for (const Index i : serving)
    records.push_back(records_[i]);
  return records;
}

}  // namespace lab09
