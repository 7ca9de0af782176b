#include "given/records.h"

#include <algorithm>

namespace lab09 {

Cache::Cache(double most, double nearest, double farthest)
    : most_(most), nearest_(nearest), farthest_(farthest) {}

void Cache::add(const Record& record) {
  records_.push_back(record);
}

std::vector<Record> Cache::near(Vec3 p) const {
  std::vector<Record> found;
  for (const Record& record : records_) {
    const double reach = most_ * std::clamp(record.distance, nearest_, farthest_);
    if (static_cast<double>(glm::length(record.p - p)) <= reach) found.push_back(record);
  }
  return found;
}

}  // namespace lab09
