// carlo_verbs ROOT PRESET VERB WORD...: what ./carlo does once there is a compiler. It is the first
// that is built of a tree, and everybody waits for it, so it stands on cli/ alone.

#include "cli/error.h"
#include "cli/program.h"
#include "course/verbs/course.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <map>

using namespace carlo;
using namespace carlo::verbs;

namespace {

using Verb = int (*)(Course&, const Words&);

const std::map<std::string, Verb> all_verbs{
    {"lab", lab},     {"test", test},     {"status", status}, {"hint", hint},
    {"watch", watch}, {"replay", replay}, {"render", render}, {"merge", merge},
    {"grade", grade}, {"bench", bench},   {"slides", slides}, {"fuzz", fuzz},
};

int run_verb(const Words& words) {
  if (words.size() < 3) throw Error("carlo_verbs is started by ./carlo");
  const auto verb = all_verbs.find(words[2]);
  if (verb == all_verbs.end()) throw Error("there is no verb '" + words[2] + "'");
  const Words typed(words.begin() + 2, words.end());
  // For those who wait for our build.
  const std::string turn = fmt::format("./carlo {} (process {})", joined(typed, " "), ::getpid());
  ::setenv("CARLO_TURN_OF", turn.c_str(), 1);
  const Tree tree{words[0]};
  Course course{tree, words[1], Building(tree, words[1])};
  return verb->second(course, Words(typed.begin() + 1, typed.end()));
}

[[noreturn]] void become(const HandOver& next) {
  std::fflush(nullptr);
  const std::vector<char*> argv = pointers(next.command);
  if (next.folder.empty() || ::chdir(next.folder.c_str()) == 0) ::execvp(argv[0], argv.data());
  throw Error(next.command[0] + " cannot be run");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    outlive_signals();
    try {
      return run_verb(Words(argv + 1, argv + argc));
    } catch (const HandOver& next) {
      become(next);
    } catch (const Leave& leave) {
      return leave.code;
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "carlo: {}\n", error.what());
    return 1;
  }
}
