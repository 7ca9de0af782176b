#pragma once

#include "course/not_implemented.h"
#include "support/error.h"

namespace carlo::grader {

/// Explains refusal()'s codes to people.
constexpr const char* refusal_codes =
    "(refusal: 1 if carlo::Error was thrown, 0 if nothing was, 2 if something else)";

/// For probes of inputs that an exercise must refuse. Returns 1: carlo::Error, as required; 0:
/// nothing was thrown; 2: something else was.
template <class Work>
double refusal(const Work& work) {
  try {
    work();
  } catch (const carlo::Error&) {
    return 1;
  } catch (const carlo::NotImplemented&) {
    throw;
  } catch (...) {
    return 2;
  }
  return 0;
}

}  // namespace carlo::grader
