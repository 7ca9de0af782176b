#include "course/report/results.h"

#include "course/json/json_fields.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace carlo {
namespace {

struct Row {
  const Table* table = nullptr;
  const std::vector<Cell>* cells = nullptr;
};

void fields(JsonFields& json, Row& row) {
  for (std::size_t c = 0; c < row.cells->size(); ++c) {
    const char* key = row.table->keys()[c].c_str();
    const Cell& cell = (*row.cells)[c];
    if (!cell.value)
      json.also(key, cell.text);
    else if (std::isfinite(*cell.value))
      json.also(key, *cell.value);
    else
      json.null(key);
  }
}

}  // namespace

void fields(JsonFields& json, Results& results) {
  for (const auto& [key, table] : results.tables) {
    std::vector<Row> rows;
    for (const std::vector<Cell>& cells : table.rows())
      rows.push_back({&table, &cells});
    json(key.c_str(), rows);
  }
}

}  // namespace carlo
