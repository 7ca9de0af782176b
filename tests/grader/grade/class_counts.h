#pragma once

#include "grader/grade/record.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

// What a class did in each exercise, counted for the class's page.

namespace carlo::grader {

/// How one student did in one exercise.
enum class Standing {
  right,
  by_itself,
  partly,
  wrong,
  follows,
  not_done,
  not_compiled,
  not_judged
};
Standing standing_of(const ExerciseResult& exercise);

/// A mistake, and how many students made it.
struct Mistake {
  std::string sentence;
  std::size_t students = 0;
};

/// One exercise over the whole class.
struct ClassColumn {
  const ExerciseResult* exercise = nullptr;  ///< of some record: its tag and title
  std::map<Standing, std::size_t> standings = {};
  double points = 0;                             ///< of all students
  std::map<std::string, Mistake> mistakes = {};  ///< named ones by id, then crashes and time limits

  std::size_t count(Standing standing) const;
  /// Students who have marks in it.
  std::size_t judged() const;
  /// The share of these who have all its points, and their mean points; 0 if there are none.
  double right() const;
  double mean() const;
};

/// Returns a column for each exercise of each lab. Needs at least one record, and the same labs in
/// all; the columns point into the first one.
std::vector<ClassColumn> class_columns(const std::vector<Record>& records);

/// Returns how many submissions of this lab were not judged for this reason.
std::size_t count_unjudged(const std::vector<Record>& records, std::size_t lab, Status why);

}  // namespace carlo::grader
