#pragma once

#include "course/report/page.h"
#include "grader/grade/record.h"

#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// How pages for others show a class.
struct ClassWords {
  bool names = true;        ///< students have their names; else numbers
  std::string secret = {};  ///< what the numbers follow from, so that nobody can guess them
  std::string command = "./carlo grade";
};

/// Returns what a page for others calls each submission: its name or "student 3". The numbers
/// follow from the secret and the names: they tell neither rank nor place in the alphabet.
std::map<std::string, std::string> shown_names(const std::vector<Record>& records,
                                               const ClassWords& words);

/// Returns the page about a class: which exercises were right, what went wrong how often, and a
/// matrix of students and exercises. Marks and names are those of class.csv. Independent of the
/// order of the records. Needs at least one record, and the same labs in all.
Page class_page(std::vector<Record> records, const ClassWords& words);

}  // namespace carlo::grader
