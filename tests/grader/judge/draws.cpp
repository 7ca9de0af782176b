#include "grader/judge/draws.h"

#include <fmt/core.h>

namespace carlo::grader {

Verdict draws(double words, double expected) {
  const Diagnosis floats{"uniform-float-drawn",
                         "the numbers are floats, with 24 random bits: take rng.uniform()."};
  const Diagnosis surplus{"surplus-numbers-drawn",
                          "more numbers are drawn than there are coordinates: each one costs time, "
                          "and the next estimate gets other numbers."};
  std::string measured = fmt::format("{:g}", words / 2);
  std::vector<Diagnosis> diagnosis;
  if (words < 0) measured = "not to be told: rng was restarted or exchanged, or gave far too many";
  if (words == expected) {
    measured = fmt::format("{:g} of rng.uniform_float()", words);
    diagnosis = {floats};
  } else if (words > 2 * expected) {
    diagnosis = {surplus};
  }
  return holds("the numbers drawn (calls of rng.uniform())", words == 2 * expected, measured,
               fmt::format("{:g}", expected), diagnosis);
}

}  // namespace carlo::grader
