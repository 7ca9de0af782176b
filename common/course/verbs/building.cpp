#include "course/verbs/building.h"

#include "course/cli/descriptor.h"
#include "course/verbs/step_progress.h"
#include "course/verbs/words.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

/// Shortens a path relative to the current folder.
std::string from_here(const fs::path& path) {
  std::error_code ec;
  const std::string here = joined({fs::current_path(ec), "/"}), text = path.string();
  return text.starts_with(here) ? text.substr(here.size()) : text;
}

/// Reports the step in a line of ninja, "@DONE/TOTAL what"; returns false if it has none.
bool report_step(const std::string& line, StepProgress& progress) {
  if (!line.starts_with('@')) return false;
  const auto step = step_in(std::string_view(line).substr(1));
  if (step) progress.report(*step);
  return step.has_value();
}

/// True if a line of the build log is a command run by ninja or a message of ninja itself.
bool is_command(const std::string& line) {
  if (line.starts_with("ninja: ") || line.starts_with("FAILED: ")) return true;
  const std::string program = fs::path(line.substr(0, line.find(' '))).filename();
  return line[0] == '/' && is_one_of(program, {"ccache", "c++", "g++", "clang++"});
}

}  // namespace

Building::Building(const Tree& tree, const std::string& preset)
    : tree_(&tree), preset_(preset), folder_(tree.root / "build" / preset) {}

const OwnFolder& Building::own() {
  if (!own_) own_.emplace(folder_);
  return *own_;
}

Words Building::in_turn() const {
  return list_of({tree_->root / "common/course/in_turn.sh", folder_});
}

void Building::must_be_writable() const {
  if (::access(folder_.c_str(), W_OK) != 0) fail({"cannot write into ", folder_.string()});
}

void Building::configure() {
  if (fs::exists(folder_ / "build.ninja")) return;
  std::error_code ec;
  fs::create_directories(folder_, ec);
  must_be_writable();
  say({"carlo: configuring ...\n"});
  configure_anew();
}

void Building::configure_anew(const Words& options) {
  Words command = in_turn();
  (command += {"cmake", "-S", tree_->root, "--preset", preset_}) += options;
  std::string said;
  const int code = run_gathering(command, {.notices = STDERR_FILENO}, said);
  write_file(folder_ / "configure.log", said);
  if (code == 0) return;
  say({said});
  fail({"CMake failed"});
}

void Building::every_instruction_set() {
  configure();
  const std::string before = read_file(folder_ / "CMakeCache.txt");
  if (before.find("\nCARLO_EVERY_INSTRUCTION_SET:BOOL=ON") == std::string::npos)
    configure_anew(list_of({"-DCARLO_EVERY_INSTRUCTION_SET=ON"}));
}

std::size_t Building::steps(const Words& targets) const {
  // Uses another name for build.ninja: under its own name, ninja would only plan to check for new
  // files, which it always does first, and stop there.
  std::error_code ec;
  fs::create_symlink("build.ninja", folder_ / ".planned.ninja", ec);
  Words command =
      list_of({"env", "NINJA_STATUS=[%f] ", "ninja", "-C", folder_, "-f", ".planned.ninja", "-n"});
  std::size_t count = 0;
  const int code = run_listening(command += targets, {}, [&](const std::string& line) {
    if (line.rfind('[', 0) == 0) ++count;
  });
  // 1 if it cannot plan: the build reports why.
  return code == 0 ? count : 1;
}

void Building::build_unless_there(const std::string& target) {
  const bool there = fs::exists(folder_ / "build.ninja") && fs::exists(program(target));
  if (!there || steps({target}) != 0) build({target});
}

void Building::build(const Words& targets, const Words& keep) {
  constexpr std::size_t a_while = 20;
  configure();
  must_be_writable();
  if (::isatty(STDERR_FILENO) == 0 && steps(targets) > a_while)
    say({"carlo: building (a minute or more the first time) ...\n"});
  Words command = in_turn();
  if (!keep.empty()) ((command += {"--keep", own().path()}) += keep) += {"--"};
  (command += {"env", "NINJA_STATUS=@%f/%t ", "ninja", "-C", folder_}) += targets;
  std::string said;
  StepProgress progress("building");
  const int code = run_listening(
      command, {.notices = STDERR_FILENO},
      [&](const std::string& line) {
        if (!report_step(line, progress)) (said += line) += '\n';
      },
      [&] { progress.show(); });
  progress.clear();
  if (code != 0) failed(code, said);
  // Our code has no warnings (they are errors); a student's are shown.
  if (said.find("warning:") != std::string::npos) explain(said);
}

void Building::build_behind(const Words& targets) {
  if (::isatty(STDERR_FILENO) == 0) return;
  const Descriptor nowhere(::open("/dev/null", O_RDWR | O_CLOEXEC));
  Words command = in_turn();
  (command += {"--behind", "ninja", "-k", "0", "-C", folder_}) += targets;
  start_program(
      command,
      {.input = nowhere.get(), .output = nowhere.get(), .error = nowhere.get(), .own_group = true});
}

void Building::failed(int code, const std::string& said) {
  if (code == 130 || interrupted() ||
      ("\n" + said).find("\nninja: build stopped: interrupted by user") != std::string::npos) {
    say({"carlo: stopped while building\n"});
    throw Leave{130};
  }
  const fs::path log = folder_ / "build.log";
  write_file(log, said);
  explain(said);
  fail({"the code does not compile (the compiler's full output: ", from_here(log), ")"});
}

void Building::explain(const std::string& said) {
  const fs::path log = own().path() / "build.log", guide = program("carlo_course");
  write_file(log, said);
  if (!fs::exists(guide) || steps({"carlo_course"}) != 0) {
    say({"carlo: building the explainer of compiler messages (once) ...\n"});
    Words command = in_turn();
    run_silently(command += {"ninja", "-C", folder_, "carlo_course"});
  }
  std::string explained;
  const int code =
      run_gathering(list_of({guide, "explain", "--root", tree_->root, log}), {}, explained);
  if (code != 0) {
    explained.clear();
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);)
      if (line.empty() || !is_command(line)) (explained += line) += '\n';
  }
  say({explained});
}

}  // namespace carlo::verbs
