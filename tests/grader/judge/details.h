#pragma once

#include "grader/judge/results.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>

namespace carlo::grader {

/// How large a lab's verdicts may be in JSON with all that the details hold, in bytes.
constexpr std::size_t most_json_bytes = 2'000'000;

/// Adds to a lab's verdicts, which hold one object per exercise in the lab's order, what a page
/// shows of them. To the lab: "title", and whether all its exercises were judged ("whole"). To each
/// exercise: "title"; "unsound", the tags of those it builds on that are not right; and
///   "tests": [{"sentence", "status", "problem", "printed", "skipped", "needs",
///              "verdicts": [{"what", "measured", "expected", "certainty", "p", "passed",
///                            "diagnoses": [{"id", "sentence"}], "figure"}]}]
/// Exact comparisons have no "p"; only failed ones have a figure (figure_json.h). What would make
/// the document too large is left out: the last figures, printed words, verdicts. What "tests"
/// holds already is kept.
void add_details(nlohmann::json& document, const LabResult& result);

}  // namespace carlo::grader
