#pragma once

#include "course/report/page.h"
#include "grader/grade/record.h"

#include <vector>

namespace carlo::grader {

/// Returns the page about a class: which exercises were right, what went wrong how often, and a
/// matrix of students and exercises. Marks and names are those of class.csv; without `names`,
/// students are numbered by rank. Independent of the order of the records. Needs at least one
/// record, and the same labs in all.
Page class_page(std::vector<Record> records, bool names);

}  // namespace carlo::grader
