#pragma once

// The functions for writing checks:
//   TEST_CASE("Lab 1.2: the integral over [a, b] is unbiased", "[lab01][ex2]") {
//     const Rows rows = probe("Lab 1.2 estimates", {.n = 16, .numbers = {{"a", -1}}}, {.rows =
//     99}); judge(mean_is("the mean", rows.values, {...}));
//   }

#include "grader/judge/compare.h"
#include "grader/judge/numbers.h"
#include "grader/judge/run.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

namespace carlo::grader {

/// Runs a probe for the current test case; if it fails, the test case ends.
Answer probe(const std::string& name, const Params& params, const Shape& shape);

/// Records the verdict for the current test case.
void judge(const Verdict& verdict);

/// Leaves the current test case unjudged, and not passed, because another one has already found
/// wrong the code whose cost it would judge. `why`: "not judged: ...".
void leave_unjudged(const std::string& why);

/// Returns one column of a table.
std::vector<double> column(const Rows& rows, std::size_t index);

}  // namespace carlo::grader
