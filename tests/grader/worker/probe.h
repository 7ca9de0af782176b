#pragma once

#include "grader/protocol/frame.h"
#include "grader/protocol/params.h"

#include <initializer_list>
#include <map>
#include <string>

namespace carlo::grader {

/// A probe calls an exercise and returns raw values; it draws no conclusion. It runs in the worker,
/// beside the student's code.
using Probe = Rows (*)(const Params&);

/// All probes of this worker by name.
std::map<std::string, Probe>& probes();

/// Puts a probe into probes() before main() starts.
struct Registration {
  Registration(const char* name, Probe probe);
};

/// Builds a table row by row.
class RowWriter {
 public:
  void add(std::initializer_list<double> row);
  Rows take() { return std::move(rows_); }

 private:
  Rows rows_;
};

}  // namespace carlo::grader

#define CARLO_JOIN_(a, b) a##b
#define CARLO_JOIN(a, b) CARLO_JOIN_(a, b)

/// PROBE("Lab 1.1 estimates") { ... params.seed ... return rows; }
#define PROBE(name) CARLO_PROBE(name, CARLO_JOIN(carlo_probe_, __LINE__))
#define CARLO_PROBE(name, function)                                                        \
  static ::carlo::grader::Rows function(const ::carlo::grader::Params& params);            \
  static const ::carlo::grader::Registration CARLO_JOIN(function, _entry)(name, function); \
  static ::carlo::grader::Rows function([[maybe_unused]] const ::carlo::grader::Params& params)
