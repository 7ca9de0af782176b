#pragma once

#include "grader/judge/results.h"
#include "grader/protocol/params.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carlo::grader {

/// One question that the judge put to a worker, and how it ended: enough to put it again by hand.
struct Asked {
  std::string tag;       ///< "Lab 1.2"
  std::string sentence;  ///< the test's, without the tag
  std::string probe;
  Params params;
  std::string question;  ///< in words; may be empty
  std::size_t rows = 0;  ///< what was expected
  std::size_t columns = 0;
  Status status = Status::passed;  ///< passed: values came, whatever the checks made of them
  std::string problem = {};        ///< why there are no values
};

/// All questions of one judgement.
struct Questions {
  std::uint64_t seed = 0;  ///< the run's
  std::vector<Asked> asked;
};

/// JSON; whole numbers of 64 bits are kept as text where a reader might round them.
std::string to_json(const Questions& questions);
/// Throws Error when the text is not what to_json() writes.
Questions questions_from_json(const std::string& text);

}  // namespace carlo::grader
