#pragma once

#include <string>
#include <vector>

namespace carlo {

/// What became of a test or an exercise. Of those that a judge gives, the gravest last, so that the
/// largest is shown; behind them what keeps an exercise from being judged. `grader_error` is the
/// machine's fault or ours: it has no marks, not 0.
enum class Status {
  passed,
  failed,
  crashed,
  timeout,
  not_implemented,
  not_submitted,
  refused,
  does_not_compile,
  grader_error
};
std::string to_string(Status status);
/// Throws Error when no status is called so.
Status status_named(const std::string& name);

/// What a test case judges: whether the values are right; or, of right values, how much they
/// scatter or what they cost.
enum class Aspect { correctness, variance, efficiency };
std::string to_string(Aspect aspect);
/// Throws Error when no aspect is called so.
Aspect aspect_named(const std::string& name);

/// The aspect that a test case's tags name: [variance], [efficiency], else correctness. Throws
/// Error when they name both.
Aspect aspect_of(const std::vector<std::string>& tags);

}  // namespace carlo
