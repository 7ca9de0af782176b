#include "course/report/table.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace carlo {

nlohmann::json Table::json() const {
  auto result = nlohmann::json::array();
  for (const auto& row : rows_) {
    auto object = nlohmann::json::object();
    for (std::size_t c = 0; c < row.size(); ++c) {
      const auto& cell = row[c];
      if (!cell.value) {
        object[keys_[c]] = cell.text;
      } else if (std::isfinite(*cell.value)) {
        object[keys_[c]] = *cell.value;
      } else {
        object[keys_[c]] = nullptr;
      }
    }
    result.push_back(std::move(object));
  }
  return result;
}

}  // namespace carlo
