#include "course/cli/arguments.h"

#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace {

/// A program with an option of each kind.
struct Program {
  std::uint64_t seed = 7;
  double paths = 1e8;
  std::optional<int> threads;
  std::optional<std::string> page;
  std::string sampler = "sobol";
  std::vector<std::string> labs;
  std::filesystem::path folder;
  bool quiet = false;
  bool seed_given = false;

  std::optional<int> parse(std::vector<const char*> words) {
    carlo::CommandLine app("A program", "./carlo program");
    const carlo::Argument seed_option = app.option("--seed", seed, "the seed").show_default();
    app.option("--paths", paths, "how many").range(1.0, 1e15);
    app.option("--threads", threads, "threads").range(1, 1024);
    app.option("--page", page, "the page").words(0, 1);
    app.option("--sampler", sampler, "how").one_of({"sobol", "stratified"});
    app.option("--labs", labs, "which").list(',', false);
    app.option("folder", folder, "where");
    app.flag("--quiet", quiet, "say nothing");
    words.insert(words.begin(), "program");
    const auto code = app.parse(static_cast<int>(words.size()), words.data());
    seed_given = seed_option.given();
    return code;
  }
};

std::string complaint(const std::vector<const char*>& words) {
  try {
    Program program;
    (void)program.parse(words);
  } catch (const carlo::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("options reach their variables, and what is not given keeps its default", "[arguments]") {
  Program none;
  CHECK_FALSE(none.parse({}).has_value());
  CHECK(none.seed == 7);
  CHECK_FALSE(none.seed_given);
  CHECK_FALSE(none.threads.has_value());
  CHECK_FALSE(none.page.has_value());

  Program all;
  CHECK_FALSE(all.parse({"out", "--seed=18446744073709551615", "--paths", "1e9", "--threads", "4",
                         "--sampler", "stratified", "--labs", "1,2", "--quiet", "--page"})
                  .has_value());
  CHECK(all.seed == 18446744073709551615U);
  CHECK(all.seed_given);
  CHECK(all.paths == 1e9);
  CHECK(all.threads == 4);
  CHECK(all.page == "");
  CHECK(all.sampler == "stratified");
  CHECK(all.labs == std::vector<std::string>{"1", "2"});
  CHECK(all.folder == "out");
  CHECK(all.quiet);
}

TEST_CASE("a value may stand in the word of its option, and a list in several", "[arguments]") {
  std::vector<std::string> defines, only;
  std::vector<std::uint64_t> shape;
  std::string output;
  std::vector<std::string> files;
  carlo::CommandLine app("A program", "./carlo program");
  app.option("-D,--define", defines);
  app.option("--only", only).list(',');
  app.option("--shape", shape).words(2, 2);
  app.option("-o,--output", output);
  app.option("files", files);
  const std::vector<const char*> words{"program",   "-Dn=4", "--define", "a=1",    "b=2",
                                       "-oout",     "first", "--only",   "x,y",    "z",
                                       "--shape=2", "3",     "--",       "--last", "-1"};
  CHECK_FALSE(app.parse(static_cast<int>(words.size()), words.data()).has_value());
  CHECK(defines == std::vector<std::string>{"n=4", "a=1", "b=2"});
  CHECK(only == std::vector<std::string>{"x", "y", "z"});
  CHECK(shape == std::vector<std::uint64_t>{2, 3});
  CHECK(output == "out");
  CHECK(files == std::vector<std::string>{"first", "--last", "-1"});
}

TEST_CASE("one verb of several is chosen, with options of its own", "[arguments]") {
  const auto parse = [](std::vector<const char*> words) {
    std::string exercise;
    bool all = false;
    carlo::CommandLine app("A program", "./carlo");
    carlo::CommandLine hint = app.verb("hint", "the next hint");
    carlo::CommandLine status = app.verb("status", "how far");
    hint.option("exercise", exercise, "which one").required();
    const carlo::Argument some = status.flag("--some", all, "some");
    status.flag("--all", all, "all").excludes(some);
    words.insert(words.begin(), "program");
    try {
      (void)app.parse(static_cast<int>(words.size()), words.data());
    } catch (const carlo::Error& error) {
      return std::string(error.what());
    }
    return exercise + (hint.chosen() ? " hint" : "") + (status.chosen() ? " status" : "") +
           (all ? " all" : "");
  };
  CHECK(parse({"hint", "1.2"}) == "1.2 hint");
  CHECK(parse({"status", "--all"}) == " status all");
  CHECK(parse({}) == "which verb? There are hint, status (see ./carlo --help)");
  CHECK(parse({"run"}) == "there is no verb run; there are hint, status (see ./carlo --help)");
  CHECK(parse({"hint"}) == "exercise is missing: which one (see ./carlo hint --help)");
  CHECK(parse({"hint", "1", "2"}) == "unexpected argument: 2 (see ./carlo hint --help)");
  CHECK(parse({"status", "--all", "--some"}) ==
        "--all and --some cannot be used together (see ./carlo status --help)");
}

TEST_CASE("a bad command line is one line with the option, the value and what was expected",
          "[arguments]") {
  const std::string help = " (see ./carlo program --help)";
  CHECK(complaint({"--paths", "0.5"}) ==
        "--paths: expected a number from 1 to 1e+15, got 0.5" + help);
  CHECK(complaint({"--paths=nan"}) == "--paths: expected a number from 1 to 1e+15, got nan" + help);
  CHECK(complaint({"--threads", "0"}) ==
        "--threads: expected a whole number from 1 to 1024, got 0" + help);
  CHECK(complaint({"--threads", "2x"}).ends_with("1024, got 2x" + help));
  CHECK(complaint({"--threads="}).ends_with("1024, got nothing" + help));
  CHECK(complaint({"--sampler", "best"}) ==
        "--sampler: expected one of sobol, stratified, got best" + help);
  for (const char* seed : {"--seed=-1", "--seed=x", "--seed=1.5", "--seed=18446744073709551616"}) {
    INFO(seed);
    CHECK(complaint({seed}).starts_with(
        "--seed: expected a whole number from 0 to 18446744073709551615, got "));
  }
  CHECK(complaint({"--seed"}) == "--seed: expected a value, got none" + help);
  CHECK(complaint({"--seed", "--quiet"}) == "--seed: expected a value, got none" + help);
  CHECK(complaint({"--seed", "1", "--seed", "2"}) == "--seed: given twice" + help);
  CHECK(complaint({"--quiet=1"}) == "--quiet: takes no value, got 1" + help);
  CHECK(complaint({"--frobnicate=2"}) == "there is no option --frobnicate" + help);
  CHECK(complaint({"-x"}) == "there is no option -x" + help);
  CHECK(complaint({"a", "b"}) == "unexpected argument: b" + help);
}
