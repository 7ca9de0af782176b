#pragma once

#include <filesystem>

namespace carlo {

struct WatchOptions {
  std::filesystem::path root;   ///< of the tree
  std::filesystem::path build;  ///< where ninja builds it
  int lab = 0;                  ///< which lab
  bool look = false;            ///< look at the files instead of waiting to be told
};

/// Waits for saves, builds and judges, shows verdicts and answers keys, until it is told to end. On
/// a terminal it redraws the screen; elsewhere it prints lines and knows no keys. Returns the exit
/// code; throws Error.
int watch(const WatchOptions& options);

}  // namespace carlo
