#pragma once

#include "course/json/json_fields.h"
#include "course/verdict/verdict.h"

#include <cstddef>
#include <string>

namespace carlo {

/// How large a lab's JSON may be, in bytes: a student's program can make much of what is said of it
/// long.
constexpr std::size_t most_json_bytes = 2'000'000;

/// The only form in which verdicts are written and read: one member for each of LabResult,
/// ExerciseResult, TestRecord, Verdict, Diagnosis, Effect by its name; beside them the sums
/// "points" and "max" of a lab. Exact comparisons have no "p"; only failed ones have a figure
/// (figure_json.h). Of a lab, long words are cut when they are written, and what would make the
/// document too large is left out: the last figures, printed words, verdicts; where verdicts are
/// missing "cut" is true. What diagnoses were looked for is not kept.
void fields(JsonFields& json, LabResult& result);
void fields(JsonFields& json, ExerciseResult& result);

/// A lab's verdicts as a file holds them, and what such a file holds. Throws Error when it is no
/// JSON or no lab's verdicts.
std::string to_text(const LabResult& result);
LabResult lab_result_from_text(const std::string& text);

}  // namespace carlo
