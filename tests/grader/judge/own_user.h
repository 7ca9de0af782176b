#pragma once

#include "course/cli/descriptor.h"

#include <sys/types.h>

#include <memory>

namespace carlo::grader {

/// A user id that nobody has and that no other object of this kind has, in any process of this
/// machine: limits that the kernel counts by users hold for its programs alone, and files that are
/// its own are closed to all others'. It is given back when the last copy goes, and when the
/// process that made it is killed.
class OwnUser {
 public:
  /// Throws Error when all are taken.
  OwnUser();

  uid_t id() const { return id_; }

 private:
  uid_t id_ = 0;
  std::shared_ptr<const Descriptor> claim_;
};

}  // namespace carlo::grader
