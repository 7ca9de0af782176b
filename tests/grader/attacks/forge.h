#pragma once

// Helpers for submissions that send answers of their own in place of the probes': a lab's
// forged.cpp is compiled into a worker together with the solution, and forges answers that the
// judge should see through.

#include "grader/protocol/frame.h"
#include "grader/protocol/params.h"

#include <unistd.h>

#include <fstream>
#include <string>

namespace carlo::grader {

/// The judge's question to this worker, from the command line.
struct Question {
  std::string probe;
  Params params;
};

inline Question question() {
  Question question;
  std::ifstream file("/proc/self/cmdline");
  for (std::string word, before; std::getline(file, word, '\0'); before = word) {
    if (before == "--probe") question.probe = word;
    if (before == "--params") question.params = params_from_text(word);
  }
  return question;
}

/// Sends the table and ends the worker before the probe can answer.
[[noreturn]] inline void forge(const Rows& rows) {
  const std::string bytes = encode({.rows = rows, .text = {}});
  const bool sent = ::write(3, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  ::_exit(sent ? 0 : 1);
}

}  // namespace carlo::grader
