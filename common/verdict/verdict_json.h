#pragma once

#include "verdict/verdict.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>

namespace carlo {

/// How large a lab's JSON may be, in bytes: a student's program can make much of what is said of it
/// long.
constexpr std::size_t most_json_bytes = 2'000'000;

/// The only form in which verdicts are written and read: one member for each of LabResult,
/// ExerciseResult, TestRecord, Verdict, Diagnosis, Effect by its name; beside them the sums
/// "points" and "max" of a lab. Exact comparisons have no "p"; only failed ones have a figure
/// (figure_json.h). Long words are cut, and what would make the document too large is left out: the
/// last figures, printed words, verdicts; where verdicts are missing "cut" is true. What diagnoses
/// were looked for is not kept.
nlohmann::json to_json(const LabResult& result);

/// Throws Error when it is anything else.
LabResult lab_result_from_json(const nlohmann::json& document);

/// The same of one exercise, whose figures are left out.
nlohmann::json to_json(const ExerciseResult& result);
ExerciseResult exercise_result_from_json(const nlohmann::json& document);

/// A document as text, for a file: in valid UTF-8, whatever a student's program said.
std::string dumped(const nlohmann::json& document, int indent = -1);

/// The text with U+FFFD in place of bytes that are no UTF-8.
std::string valid_utf8(const std::string& text);

/// A lab's verdicts as a file holds them, and what such a file holds. Throws Error when it is no
/// JSON or no lab's verdicts.
std::string to_text(const LabResult& result);
LabResult lab_result_from_text(const std::string& text);

}  // namespace carlo
