#pragma once

#include "course/verdict/verdict.h"

#include <string>

namespace carlo::grader {

/// Returns one line of the overview: status, number (a link if there is more below), title, marks
/// of the separately judged aspects, points; if nothing is done yet, how to start. `lab` is the
/// lab's number, for links.
std::string overview_row(const ExerciseResult& exercise, int lab);

/// Returns everything about a failed exercise: likely causes, the hint's command, failed tests with
/// their figures, passed ones folded. For a passed one, its folded tests. "" if nothing is done yet
/// or nothing was judged.
std::string exercise_html(const ExerciseResult& exercise, int lab);

}  // namespace carlo::grader
