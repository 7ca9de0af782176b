#pragma once

#include "grader/protocol/frame.h"
#include "grader/protocol/params.h"

#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// A probe calls an exercise and returns raw values; it draws no conclusion. It runs in the worker,
/// together with the student's code.
using Probe = Rows (*)(const Params&);

/// A probe and the names of its values, for people who look at them (rows_text.h).
struct NamedProbe {
  Probe run = nullptr;
  std::vector<std::string> names;
  std::string remark;  ///< which rows hold something other than the names say, if any
};

/// All probes of this worker by name.
std::map<std::string, NamedProbe>& probes();

/// Puts a probe into probes() before main() starts. `words`: its name, the names of its values, and
/// a remark in parentheses, if there is one.
struct Registration {
  Registration(Probe probe, std::initializer_list<const char*> words);
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

/// PROBE("Lab 1.1 estimates", "estimate") { ... params.seed ... return rows; }
///
/// The probe's name; then the names of its values, which all of a lab's probes give; then,
/// optionally, a remark: "(last row: how many there were)".
#define PROBE(...) CARLO_PROBE(CARLO_JOIN(carlo_probe_, __COUNTER__), __VA_ARGS__)
#define CARLO_PROBE(function, ...)                                                        \
  static ::carlo::grader::Rows function(const ::carlo::grader::Params& params);           \
  static const ::carlo::grader::Registration CARLO_JOIN(function, _entry)(function,       \
                                                                          {__VA_ARGS__}); \
  static ::carlo::grader::Rows function([[maybe_unused]] const ::carlo::grader::Params& params)
