#pragma once

#include "course/json/json_fields.h"
#include "course/verdict/verdict.h"

#include <cstddef>
#include <string>

namespace carlo {

/// The largest size of a lab's JSON, in bytes: a student's program can make messages about it long.
constexpr std::size_t most_json_bytes = 2'000'000;

/// The only format in which verdicts are written and read: one member for each of LabResult,
/// ExerciseResult, TestRecord, Verdict, Diagnosis, Effect by its name; and the sums "points" and
/// "max" of a lab. Exact comparisons have no "p"; only failed ones have a figure.
/// Writing a lab cuts long texts and drops what would make the document too large: the last
/// figures, printed texts, verdicts; "cut" is true if verdicts are missing. `looked_for` is not
/// kept.
void fields(JsonFields& json, LabResult& result);
void fields(JsonFields& json, ExerciseResult& result);

/// Convert a lab's verdicts to the text of a file and back. Reading throws Error unless it is JSON
/// of a lab's verdicts.
std::string to_text(const LabResult& result);
LabResult lab_result_from_text(const std::string& text);

/// "kind" is "histogram", "points", "grid" or "listing"; numbers keep six digits. Reading throws
/// Error for a figure above the size limits: it may come from a file that somebody else wrote.
void fields(JsonFields& json, Figure& figure);

}  // namespace carlo
