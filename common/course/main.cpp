// carlo_course: what a student asks of the course itself. Verb so far: hint.

#include "cli/arguments.h"
#include "cli/main_guard.h"
#include "course/hints.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <string>

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    CLI::App app("The course: hints, one step at a time", "./carlo");
    app.require_subcommand(1);
    std::string number;
    int step = 0;
    bool all = false;
    std::string labs = "labs";
    std::string state = ".carlo/state.json";
    CLI::App* hint = app.add_subcommand("hint", "the next hint for an exercise");
    hint->add_option("exercise", number, "which exercise, such as 1.2")->required();
    CLI::Option* one = hint->add_option("step", step, "show this earlier hint again");
    hint->add_flag("--all", all, "show all hints that were seen")->excludes(one);
    hint->add_option("--labs", labs, "the folder of the labs")->capture_default_str();
    hint->add_option("--state", state, "where to note which hints were seen")
        ->capture_default_str();
    if (const auto code = carlo::parse_arguments(app, argc, argv)) return *code;

    const std::vector<carlo::Lab> list = carlo::load_labs(labs);
    carlo::HintState seen(state);
    const carlo::Exercise& exercise = carlo::find_exercise(list, number);
    fmt::print("{}", all                ? carlo::seen_hints(exercise, seen)
                     : one->count() > 0 ? carlo::seen_hint(exercise, step, seen)
                                        : carlo::next_hint(exercise, seen));
    return 0;
  });
}
