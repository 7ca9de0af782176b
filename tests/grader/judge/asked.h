#pragma once

#include "grader/judge/results.h"
#include "grader/protocol/params.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carlo::grader {

/// One question from the judge to a worker, and its outcome: enough to repeat it by hand.
struct Asked {
  std::string tag;       ///< "Lab 1.2"
  std::string sentence;  ///< the test's sentence, without the tag
  std::string probe;
  Params params;
  std::string question;  ///< in words; may be empty
  std::size_t rows = 0;  ///< expected rows
  std::size_t columns = 0;
  Status status = Status::passed;  ///< passed: values came, whatever the checks concluded
  std::string problem = {};        ///< why there are no values
};

/// All questions of one judgement.
struct Questions {
  std::uint64_t seed = 0;  ///< the run's
  std::vector<Asked> asked;
};

/// Writes JSON; 64-bit integers become text where a reader might round them.
std::string to_json(const Questions& questions);
/// Throws Error unless the text was written by to_json().
Questions questions_from_json(const std::string& text);

}  // namespace carlo::grader
