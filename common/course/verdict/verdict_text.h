#pragma once

#include "course/verdict/verdict.h"

#include <string>

namespace carlo {

/// How a text says where an exercise's hint is: by what to type, or by the key that watch has for
/// it.
enum class Help { typed, by_key };

/// The report for the student, in colour where stdout shows it. `verbose`: every test and every
/// comparison, those that passed too.
std::string report_text(const LabResult& result, bool verbose = false);

/// For the student: what keeps one exercise from all its points; empty when it passed. In colour as
/// above.
std::string shortfall(const ExerciseResult& result, Help help = Help::typed);

/// What went wrong, in one line; empty when it passed.
std::string message(const ExerciseResult& result);

}  // namespace carlo
