#include "cli/arguments.h"

#include "cli/error.h"

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

TEST_CASE("a bad command line is one line with the option, the value and what was expected",
          "[arguments]") {
  const std::string help = " (see ./carlo program --help)";
  CHECK(complaint({"--paths", "0.5"}) == "--paths: Value 0.5 not in range 1 to 1e+15" + help);
  CHECK(complaint({"--paths=nan"}) == "--paths: Value nan not in range 1 to 1e+15" + help);
  CHECK(complaint({"--threads", "0"}) == "--threads: Value 0 not in range 1 to 1024" + help);
  CHECK(complaint({"--threads", "2x"}) == "--threads: Value 2x not in range 1 to 1024" + help);
  CHECK(complaint({"--sampler", "best"}) == "--sampler: best not in {sobol,stratified}" + help);
  for (const char* seed : {"--seed=-1", "--seed=x", "--seed=1.5", "--seed=18446744073709551616"}) {
    INFO(seed);
    CHECK(complaint({seed}).starts_with("Could not convert: --seed"));
  }
  CHECK(complaint({"--frobnicate"}).find("--frobnicate") != std::string::npos);
  CHECK(complaint({"a", "b"}).find('b') != std::string::npos);
}
