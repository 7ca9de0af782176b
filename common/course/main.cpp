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
    std::string labs = "labs";
    std::string state = ".carlo/state.json";
    CLI::App* hint = app.add_subcommand("hint", "the next hint for an exercise");
    hint->add_option("exercise", number, "which exercise, such as 1.2")->required();
    hint->add_option("--labs", labs, "the folder of the labs")->capture_default_str();
    hint->add_option("--state", state, "where to note which hints were seen")
        ->capture_default_str();
    if (const auto code = carlo::parse_arguments(app, argc, argv)) return *code;

    const std::vector<carlo::Lab> list = carlo::load_labs(labs);
    carlo::HintState seen(state);
    fmt::print("{}", carlo::next_hint(carlo::find_exercise(list, number), seen));
    return 0;
  });
}
