#pragma once

#include "course/verdict/verdict.h"

#include <string>

namespace carlo::grader {

/// One line of the overview: status, number (a link where there is more below), title, marks of the
/// aspects that are judged apart, points; where nothing is done yet, how to start. `lab` is the
/// lab's number, for links.
std::string overview_row(const ExerciseResult& exercise, int lab);

/// All that is known of an exercise that has failed: what it looks like, the hint's command, failed
/// tests with their figures, passed ones folded away. Of a passed one, its tests folded away. ""
/// where nothing is done yet or nothing was judged.
std::string exercise_html(const ExerciseResult& exercise, int lab);

}  // namespace carlo::grader
