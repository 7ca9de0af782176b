// The judge of one lab: a Catch2 program of checks that starts workers and contains no student
// code.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/cli/wrap.h"
#include "course/guide/verdicts.h"
#include "course/verdict/verdict_json.h"
#include "course/verdict/verdict_text.h"
#include "grader/judge/consistency.h"
#include "grader/judge/feedback_page.h"
#include "grader/judge/results.h"
#include "grader/judge/run.h"
#include "random/hash.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/number.h"

#include <catch2/catch_session.hpp>
#include <catch2/catch_test_case_info.hpp>
#include <catch2/interfaces/catch_interfaces_registry_hub.hpp>
#include <catch2/interfaces/catch_interfaces_testcase.hpp>
#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string lab, worker, exercise, json, book, handout;
  std::vector<std::string> stub;  ///< its files
  PageFiles page;
  std::string secret_file, submission = local_submission, sandbox = "auto", user = "own";
  std::uint64_t seed = 0;
  double deadline = 10;
  bool verbose = false;
  bool seed_given = false;
  std::string probes;  ///< output path for its questions
};

/// Returns the option --seed.
Argument add_options(CommandLine& app, Options& options) {
  app.option("--lab", options.lab, "the lab's lab.json").required();
  app.option("--worker", options.worker, "the worker program to judge");
  app.option("--exercise", options.exercise, "judge only this exercise, such as 1.2");
  app.option("--json", options.json, "write the verdicts to this file");
  app.option("--book", options.book, "note the verdicts in this record, for ./carlo status");
  app.option("--page", options.page.always, "write a page with pictures to this file");
  app.option("--failure-page", options.page.on_failure,
             "the same, but only when something has failed");
  const Argument seed = app.option("--seed", options.seed, "use the numbers of this seed");
  app.option("--secret-file", options.secret_file,
             "seeds follow from this file's text and the submission (default: a public one)");
  app.option("--submission", options.submission, "the submission's name").show_default();
  app.option("--deadline", options.deadline, "seconds that one probe may take")
      .range(0.1, 3600.0)
      .show_default();
  app.option("--sandbox", options.sandbox, "auto, bubblewrap, landlock, user or limits")
      .show_default();
  app.option("--sandbox-user", options.user,
             "own: where there may be one; none; or the id of one that is free (not with auto)")
      .show_default();
  app.flag("--verbose", options.verbose, "show every test and comparison, those that passed too");
  app.option("--stub", options.stub, "check that stub, handout and tests agree with lab.json");
  app.option("--handout", options.handout, "the handout for --stub");
  app.option("--probes", options.probes, "write the questions put to the worker to this file");
  return seed;
}

Worker make_worker(const Options& options) {
  if (options.worker.empty()) throw Error("--worker is missing: which program is judged?");
  if (options.sandbox == "auto") return Worker(options.worker);
  const Level level = level_of(options.sandbox);
  if (options.user == "own") return {options.worker, level};
  if (options.user == "none") return {options.worker, Sandbox::as_found(level, {})};
  const std::optional<uid_t> user = number_of<uid_t>(options.user);
  if (!user || *user == 0) {
    throw Error("--sandbox-user {}: expected own, none or a user's id", options.user);
  }
  return {options.worker, Sandbox::as_found(level, *user)};
}

std::uint64_t run_seed(const Options& options) {
  if (options.seed_given) return options.seed;
  // From a file, because everybody may read a command line.
  const std::string secret =
      options.secret_file.empty() ? public_secret : read_file(options.secret_file);
  return hash(word_of(secret), word_of(options.submission));
}

/// Runs the test cases of one exercise (a tag such as "Lab 1.2") or, for "", of all.
void run_tests(const std::string& tag) {
  Catch::Session session;
  Catch::ConfigData config;
  config.reporterSpecifications.push_back({"silent", {}, {}, {}});
  if (!tag.empty()) config.testsOrTags.push_back("\"" + tag + ": *\"");
  session.useConfigData(config);
  session.run();  // the records say more than its exit code
}

OwnCode code_beside(const Options& options, const Lab& lab) {
  return {fs::absolute(options.lab).parent_path().parent_path(), lab};
}

/// For ./carlo status, unless the files were edited since.
void note(const Options& options, const Lab& lab, const OwnCode& code, const LabResult& result) {
  if (options.book.empty() || code_beside(options, lab).digest() != code.digest()) return;
  try {
    VerdictBook book(options.book);
    book.take(result, lab, code);
    book.save();
  } catch (const Error& error) {
    fmt::print(stderr, "cannot save the verdict: {}\n", error.what());
  }
}

int judge_lab(const Options& options) {
  const Lab lab = load_lab(options.lab);
  const std::string tag = options.exercise.empty() ? "" : "Lab " + options.exercise;
  if (!tag.empty() && lab.find(tag) == nullptr) {
    throw Error("lab {} has no exercise {}", lab.number, options.exercise);
  }
  const OwnCode code = code_beside(options, lab);
  Limits limits;
  limits.deadline = std::chrono::milliseconds(static_cast<long>(options.deadline * 1000));
  current_run() = std::make_unique<Run>(make_worker(options), run_seed(options), limits);
  for (const Exercise& exercise : lab.exercises) {
    if (exercise.functions.size() > 1) current_run()->has_parts(exercise.tag);
  }
  run_tests(tag);
  // No verdict is better than one that may be the machine's fault.
  if (!current_run()->trouble().empty()) throw Error("{}", current_run()->trouble());
  if (!options.probes.empty()) {
    write_file(options.probes, to_json(Questions{current_run()->seed(), current_run()->asked()}));
  }

  LabResult result = collect(lab, current_run()->records(), tag);
  result.seed = current_run()->seed();
  result.usual_seed = result.seed == local_seed();
  result.sandbox = current_run()->sandbox().description();
  fmt::print("{}", wrapped(report_text(result, options.verbose)));
  const std::string verdicts = to_text(result);
  if (!options.json.empty()) write_file(options.json, verdicts);
  // As others read them: of bounded size, in valid UTF-8.
  const LabResult read = lab_result_from_text(verdicts);
  write_feedback_page(read, options.page);
  note(options, lab, code, read);
  return result.earned() == result.possible() ? 0 : 1;
}

int check_consistency(const Options& options) {
  std::vector<TestName> tests;
  for (const Catch::TestCaseInfo* info :
       Catch::getRegistryHub().getTestCaseRegistry().getAllInfos()) {
    TestName test{info->name, {}};
    for (const Catch::Tag& tag : info->tags)
      test.tags.emplace_back(tag.original);
    tests.push_back(test);
  }
  std::string stub;
  for (const std::string& file : options.stub)
    stub += read_file(file);
  const std::vector<std::string> lines =
      disagreements(load_lab(options.lab), stub, read_file(options.handout), tests);
  for (const std::string& line : lines)
    fmt::print(stderr, "{}\n", line);
  if (lines.empty()) fmt::print("lab.json, stub, handout, hints and tests agree\n");
  return lines.empty() ? 0 : 1;
}

}  // namespace
}  // namespace carlo::grader

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    carlo::CommandLine app("The judge of one lab", "./carlo test");
    carlo::grader::Options options;
    const carlo::Argument seed = carlo::grader::add_options(app, options);
    if (const auto code = app.parse(argc, argv)) return *code;
    options.seed_given = seed.given();
    return options.stub.empty() ? carlo::grader::judge_lab(options)
                                : carlo::grader::check_consistency(options);
  });
}
