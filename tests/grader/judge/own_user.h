#pragma once

#include "course/cli/descriptor.h"

#include <sys/types.h>

#include <memory>

namespace carlo::grader {

/// A user id that nobody has, nor any other object of this class in any process of this machine:
/// limits that the kernel counts per user apply to its programs alone, and its files are closed to
/// all others. Released when the last copy is destroyed, or when the process that made it is
/// killed.
class OwnUser {
 public:
  /// Throws Error if all are taken.
  OwnUser();

  uid_t id() const { return id_; }

 private:
  uid_t id_ = 0;
  std::shared_ptr<const Descriptor> claim_;
};

}  // namespace carlo::grader
