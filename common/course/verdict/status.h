#pragma once

#include <string>
#include <vector>

namespace carlo {

/// The outcome of a test or an exercise. First those that a judge gives, in increasing gravity, so
/// that the largest is shown; then the reasons why an exercise was not judged. `grader_error` is
/// the machine's fault or ours: it means no marks, not 0.
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
/// Throws Error if there is no status of that name.
Status status_named(const std::string& name);

/// What a test case judges: whether the values are right or, if they are, how much they scatter or
/// what they cost.
enum class Aspect { correctness, variance, efficiency };
std::string to_string(Aspect aspect);
/// Throws Error if there is no aspect of that name.
Aspect aspect_named(const std::string& name);

/// Returns the aspect that a test case's tags name: [variance], [efficiency], else correctness.
/// Throws Error if they name both.
Aspect aspect_of(const std::vector<std::string>& tags);

}  // namespace carlo
