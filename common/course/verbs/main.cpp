// carlo_verbs ROOT PRESET VERB WORD...: runs the verbs of ./carlo that need a compiler. It is the
// first program built in a tree, and everybody waits for it, so it depends on cli/ alone.

#include "course/cli/program.h"
#include "course/verbs/course.h"
#include "support/error.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

using namespace carlo;
using namespace carlo::verbs;

namespace {

int run_verb(const Words& words) {
  if (words.size() < 3) fail({"carlo_verbs is started by ./carlo"});
  const Words typed = behind(words, 2);
  // Shown to others who wait for our build.
  const std::string turn =
      joined({"./carlo ", joined(typed, " "), " (process ", std::to_string(::getpid()), ")"});
  ::setenv("CARLO_TURN_OF", turn.c_str(), 1);
  const Tree tree{words[0]};
  Course course{tree, words[1], Building(tree, words[1])};
  return Verb::find(typed[0])(course, behind(typed, 1));
}

[[noreturn]] void become(const HandOver& next) {
  std::fflush(nullptr);
  const std::vector<char*> argv = pointers(next.command);
  ::execvp(argv[0], argv.data());
  fail({next.command[0], " cannot be run"});
}

}  // namespace

static const Verb* last_verb = nullptr;

Verb::Verb(const char* name, Function run) : name_(name), run_(run), before_(last_verb) {
  last_verb = this;
}

Verb::Function Verb::find(const std::string& name) {
  for (const Verb* verb = last_verb; verb != nullptr; verb = verb->before_)
    if (name == verb->name_) return verb->run_;
  fail({"there is no verb '", name, "'"});
}

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
    say({"carlo: ", error.what(), "\n"});
    return 1;
  }
}
