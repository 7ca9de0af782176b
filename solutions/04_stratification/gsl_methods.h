#pragma once

#include "point_sets.h"

#include <cstdint>
#include <memory>

// The integrators of the GNU Scientific Library, for the benchmark alone.

namespace lab04 {

/// One of GSL's adaptive integrators with its workspace and its generator (mt19937).
class GslMethod {
 public:
  enum class Kind { miser, vegas };

  /// Throws carlo::Error when memory is short.
  GslMethod(Kind kind, std::uint64_t seed);

  /// The average over the unit square from about n evaluations in all. VEGAS gets n/5 for each of
  /// its five iterations.
  double average(const Integrand& integrand, std::int64_t n);

 private:
  struct State;
  struct Free {
    void operator()(State* state) const;
  };
  Kind kind_;
  std::unique_ptr<State, Free> state_;
};

}  // namespace lab04
