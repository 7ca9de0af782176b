#pragma once

#include <filesystem>

namespace carlo {

struct WatchOptions {
  std::filesystem::path root;   ///< of the tree
  std::filesystem::path build;  ///< where ninja builds it
  int lab = 0;                  ///< number of the lab
  bool look = false;            ///< poll the files instead of using notifications
};

/// Waits for saves, builds and judges, shows verdicts and handles keys until it is told to stop. On
/// a terminal it redraws the screen; elsewhere it prints lines and reads no keys. Returns the exit
/// code; throws Error.
int watch(const WatchOptions& options);

}  // namespace carlo
