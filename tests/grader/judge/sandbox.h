#pragma once

#include "grader/judge/own_user.h"
#include "grader/judge/process.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carlo::grader {

/// How strongly a program is confined, weakest first.
///   limits      own session, resource limits, no new privileges, no descriptors
///   user        and a user id that nobody has (if we are root), and a system call filter
///   landlock    and the disk: it can open what its view names, nothing else
///   bubblewrap  and namespaces: what its view does not name does not exist; no network, no other
///               process
enum class Level { limits, user, landlock, bubblewrap };

std::string to_string(Level level);

/// Returns the level of that name. Throws Error listing the names.
Level level_of(const std::string& name);

/// The parts of the disk that a program sees besides the system's programs and libraries, at their
/// paths outside.
struct View {
  std::vector<std::filesystem::path> readable = {};  ///< files and folders
  /// Its working folder and the only place that it may write to, kept when it ends; empty: a
  /// temporary one.
  std::filesystem::path scratch = {};
};

/// Runs programs at one level.
class Sandbox {
 public:
  /// Returns the strongest level that works here, found by running a harmless program with this
  /// view.
  static Sandbox strongest(const View& view);
  /// Returns exactly this level. Throws Error if it does not work here.
  static Sandbox at(Level level, const View& view);
  /// Says why a level does not work here, in a line; empty if it does.
  static std::string trouble_at(Level level);
  /// Returns a sandbox that was found to work before, with the same user or none.
  static Sandbox as_found(Level level, std::optional<uid_t> user) { return {level, user}; }
  /// Returns the same, with a new user of its own if it has one: its programs share no limit, no
  /// process and no file with others'. Throws Error.
  Sandbox with_new_user() const;

  Level level() const { return level_; }
  std::optional<uid_t> user() const { return user_; }
  /// Returns "bubblewrap, own user": the level, and its additions.
  std::string description() const;

  /// Runs a program (argv[0] is its path, part of the view or of the system). The sandbox's user
  /// becomes owner of a scratch folder in the view. A death by signal is reported as such at every
  /// level. A failure to start the program is retried for some seconds: a busy machine may briefly
  /// lack processes, memory or namespaces. Throws Error if the sandbox itself still fails, or if
  /// the machine kept the program from running (too busy, no memory): what it would have done is
  /// unknown.
  Outcome run(const std::vector<std::string>& argv, const View& view, const Limits& limits) const;

 private:
  Sandbox(Level level, std::optional<uid_t> user) : level_(level), user_(user) {}
  static Sandbox with_own_user(Level level);
  bool works(const View& view) const;
  Outcome run_once(const std::vector<std::string>& argv, const View& view,
                   const Limits& limits) const;

  Level level_;
  std::optional<uid_t> user_;
  std::optional<OwnUser> claim_;  ///< to that user, if this sandbox or its original made it
};

}  // namespace carlo::grader
