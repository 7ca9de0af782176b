#include "grader/judge/confinement.h"

#include "cli/error.h"

#include <pwd.h>
#include <unistd.h>

namespace carlo::grader {

uid_t unused_user() {
  // Inside the 65536 ids that a container has, above those that Debian gives out.
  constexpr uid_t first = 61200, count = 4000;
  const auto start = static_cast<uid_t>(::getpid());
  for (uid_t i = 0; i < count; ++i) {
    const uid_t user = first + (start + i) % count;
    if (::getpwuid(user) == nullptr) return user;
  }
  throw Error("no user id between {} and {} is unused", first, first + count - 1);
}

}  // namespace carlo::grader
