#pragma once

// Helpers for tests of deadlines on a busy machine.

#include "grader/judge/run.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <stdlib.h>

#include <string>
#include <thread>

namespace grader_test {

/// Returns whether more programs than processors want to run, by the system's own count: a judge
/// that calls an idle machine too busy is wrong.
inline bool is_busy() {
  double load = 0;
  return ::getloadavg(&load, 1) == 1 && load > 1.5 * std::thread::hardware_concurrency();
}

/// Calls as the grader does: retries if the machine was too busy for a verdict. Four such failures
/// say nothing about the judge, so the test is skipped. Not inside a CHECK, which takes a skip for
/// a failure.
template <class F>
auto again_if_busy(const F& f) {
  for (int attempt = 1;; ++attempt) {
    try {
      return f();
    } catch (const carlo::Error& error) {
      if (!has(error.what(), "too busy")) throw;
      if (attempt < 4) continue;
      if (!is_busy()) throw;
      SKIP(error.what());
    }
  }
}

/// Returns whether the probe is ended or fails.
inline bool fails(const carlo::grader::Worker& worker, const std::string& probe,
                  const carlo::grader::Limits& limits, const carlo::grader::Params& params = {}) {
  return again_if_busy([&] {
    try {
      run_probe(worker, probe, params, {}, limits);
      return false;
    } catch (const carlo::grader::ProbeFailure&) {
      return true;
    }
  });
}

}  // namespace grader_test
