#pragma once

#include "course/report/page.h"
#include "grader/grade/record.h"

#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// Returns what a page for others calls each submission: its name or, without `names`, "student 3"
/// by rank.
std::map<std::string, std::string> shown_names(std::vector<Record> records, bool names);

/// Returns the page about a class: which exercises were right, what went wrong how often, and a
/// matrix of students and exercises. Marks and names are those of class.csv; without `names`,
/// students are numbered by rank. Independent of the order of the records. Needs at least one
/// record, and the same labs in all.
Page class_page(std::vector<Record> records, bool names);

}  // namespace carlo::grader
