#pragma once

#include "course/report/table.h"

#include <map>
#include <string>

namespace carlo {

class JsonFields;

/// The numbers of a run: its tables by their keys.
struct Results {
  std::map<std::string, Table> tables;
};

/// Writes each table as a list with one object per row: numbers as numbers (null if not finite),
/// text as strings.
void fields(JsonFields& json, Results& results);

}  // namespace carlo
