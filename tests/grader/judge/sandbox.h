#pragma once

#include "grader/judge/own_user.h"
#include "grader/judge/process.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carlo::grader {

/// How strongly a program is shut in, weakest first.
///   limits      own session, resource limits, no new privileges, no descriptors
///   user        and a user id that nobody has (where we are root), and a system call filter
///   landlock    and the disk: it can open what its view names, nothing else
///   bubblewrap  and namespaces: what its view does not name does not exist; no network, no other
///               process
enum class Level { limits, user, landlock, bubblewrap };

std::string to_string(Level level);

/// The level of that name. Throws Error listing the names.
Level level_of(const std::string& name);

/// What a program sees of the disk besides the system's programs and libraries, at the paths that
/// it has outside.
struct View {
  std::vector<std::filesystem::path> readable = {};  ///< files and folders
  /// Its working folder and all it may write, kept when it ends; empty: one that goes then.
  std::filesystem::path scratch = {};
};

/// Runs programs at one level.
class Sandbox {
 public:
  /// The strongest level that works here, found by running a harmless program with this view.
  static Sandbox strongest(const View& view);
  /// This level and no other. Throws Error when it does not work here.
  static Sandbox at(Level level, const View& view);
  /// Why a level does not work here, in a line; empty when it does.
  static std::string trouble_at(Level level);
  /// One that was found to work before, with the user that it had or none.
  static Sandbox as_found(Level level, std::optional<uid_t> user) { return {level, user}; }
  /// The same, with another user of its own where it has one: what it runs shares no limit, no
  /// process and no file with what others run. Throws Error.
  Sandbox with_new_user() const;

  Level level() const { return level_; }
  std::optional<uid_t> user() const { return user_; }
  /// "bubblewrap, own user": the level, and what it has besides.
  std::string description() const;

  /// Runs a program (argv[0] is its path, part of the view or of the system). A scratch folder that
  /// the view names is given to the sandbox's user. A death by signal is told as such at every
  /// level. What keeps the program from being begun is tried again for some seconds: a busy machine
  /// may lack processes, memory or namespaces for a moment. Throws Error when the sandbox itself
  /// does not work then, or when the machine kept the program from running (too busy, no memory):
  /// what it would have done is not known.
  Outcome run(const std::vector<std::string>& argv, const View& view, const Limits& limits) const;

 private:
  Sandbox(Level level, std::optional<uid_t> user) : level_(level), user_(user) {}
  static Sandbox with_own_user(Level level);
  bool works(const View& view) const;
  Outcome run_once(const std::vector<std::string>& argv, const View& view,
                   const Limits& limits) const;

  Level level_;
  std::optional<uid_t> user_;
  std::optional<OwnUser> claim_;  ///< of that user, where this sandbox or its original made it
};

}  // namespace carlo::grader
