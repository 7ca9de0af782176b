#include "grader/judge/own_user.h"

#include "grader/judge/process_list.h"
#include "support/error.h"

#include <pwd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <optional>

namespace carlo::grader {

#if defined(__linux__)

namespace {

// Within the 65536 ids of a container, above those that Debian assigns.
constexpr uid_t first = 61200, count = 4000;

/// Claims a user id by a socket whose name only one process can have, that is not a file, and that
/// the kernel removes with its last owner. Returns none if another process has the name.
std::optional<Descriptor> claim(uid_t user) {
  const Descriptor low(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // An abstract name: it begins with a zero byte.
  const std::string name = fmt::format("carlo-sandbox-user-{}", user);
  name.copy(address.sun_path + 1, sizeof address.sun_path - 1);
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (!low.open() || ::bind(low.get(), reinterpret_cast<sockaddr*>(&address), length) != 0) {
    return {};
  }
  return low.lifted();
}

}  // namespace

OwnUser::OwnUser() {
  const auto start = static_cast<uid_t>(::getpid());
  for (uid_t i = 0; i < count; ++i) {
    const uid_t user = first + (start + i) % count;
    if (::getpwuid(user) != nullptr) continue;
    std::optional<Descriptor> held = claim(user);
    // Some service may run under an id that has no name.
    if (!held || has_process_of(user)) continue;
    id_ = user;
    claim_ = std::make_shared<const Descriptor>(std::move(*held));
    return;
  }
  throw Error("no user id between {} and {} is unused", first, first + count - 1);
}

#else

// Only Linux has names that are not files and that end with their process.
OwnUser::OwnUser() {
  throw Error("only on Linux programs get a user of their own");
}

#endif

}  // namespace carlo::grader
