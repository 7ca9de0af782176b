// grade_follow_on_seeds TREE BUILD LAB SEEDS CLASS: what follow_on_test.sh asserts, at many seeds
// for the price of one compilation. CLASS holds submissions NAME__N_M with a mistake in exercise
// N.M alone. Whatever else is not right at the first seed must have all points at each of the seeds
// with the suite's version of everything wrong that it uses.

#include "course/cli/main_guard.h"
#include "course/cli/scratch_folder.h"
#include "course/verdict/verdict_json.h"
#include "grader/grade/compile.h"
#include "grader/grade/precompiled_header.h"
#include "grader/grade/replaceable.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

class Seeds {
 public:
  Seeds(const fs::path& tree, const fs::path& build, const CourseLab& lab, const CleanTree& clean,
        int seeds)
      : tree_(tree), build_(build), lab_(lab), tools_(clean.tools(lab.lab.number)), seeds_(seeds) {
    precompile(tools_);
  }

  void check(const fs::path& submission) {
    const ScratchFolder scratch;
    const Folders folders{scratch.path() / "ours", scratch.path() / "theirs"};
    fs::create_directories(folders.ours);
    fs::create_directories(folders.theirs);
    std::map<std::string, std::string> files;
    for (const std::string& file : lab_.files)
      files[file] = read_file(submission / file);
    const fs::path first = folders.ours / "first", second = folders.ours / "second";
    const std::string name = submission.filename().string();
    if (!compile(files, tools_, sandbox_, folders, first).linked)
      throw Error("{} does not compile", name);
    ReplaceableCode code(files, tools_, sandbox_, folders);
    const LabResult found = judge(first, folders.ours, 1, "");
    std::set<std::string> wrong;
    for (const ExerciseResult& result : found.exercises)
      if (result.status != Status::passed) wrong.insert(result.tag);
    const std::string mistaken = mistaken_in(name);
    if (wrong.count(mistaken) == 0) fail(name, mistaken, 1, "is not caught");
    for (const std::string& tag : wrong) {
      const std::vector<std::string> functions = wrong_below(tag, wrong);
      if (tag == mistaken) continue;
      if (functions.empty()) {
        fail(name, tag, 1, "is wrong, and uses nothing that is");
        continue;
      }
      code.link(functions, second);
      check_user(name, tag, second, folders.ours);
    }
  }

  int end() const {
    fmt::print("{} pairs of a mistake and a user that it spoils, at {} seeds: {} failures\n",
               pairs_, seeds_, failures_);
    return failures_ == 0 && pairs_ > 0 ? 0 : 1;
  }

 private:
  static std::string mistaken_in(const std::string& name) {
    std::string number = name.substr(name.rfind("__") + 2);
    std::replace(number.begin(), number.end(), '_', '.');
    return "Lab " + number;
  }

  void fail(const std::string& name, const std::string& tag, int seed, const std::string& what) {
    ++failures_;
    fmt::print("FAILED: {}: {} {} (seed {})\n", name, tag, what, seed);
    std::fflush(stdout);
  }

  void check_user(const std::string& name, const std::string& tag, const fs::path& worker,
                  const fs::path& folder) {
    ++pairs_;
    const double full = lab_.lab.find(tag)->points;
    for (int seed = 1; seed <= seeds_; ++seed) {
      const LabResult again = judge(worker, folder, seed, tag.substr(4));
      const double points = again.exercises.at(0).points;
      if (points != full) fail(name, tag, seed, fmt::format("has {} of {}", points, full));
    }
  }

  /// Returns the functions of wrong exercises that this one calls, itself or through others.
  std::vector<std::string> wrong_below(const std::string& tag,
                                       const std::set<std::string>& wrong) const {
    std::vector<std::string> open = lab_.lab.find(tag)->uses, functions;
    std::set<std::string> seen;
    while (!open.empty()) {
      const Exercise& used = *lab_.lab.find(open.back());
      open.pop_back();
      if (!seen.insert(used.tag).second) continue;
      open.insert(open.end(), used.uses.begin(), used.uses.end());
      if (wrong.count(used.tag) != 0)
        functions.insert(functions.end(), used.functions.begin(), used.functions.end());
    }
    return functions;
  }

  LabResult judge(const fs::path& worker, const fs::path& folder, int seed,
                  const std::string& only) const {
    const fs::path verdict = folder / "verdict.json";
    fs::remove(verdict);
    Command command{
        {(build_ / fmt::format("bin/lab{}_judge", lab_.number())).string(), "--lab",
         (tree_ / "labs" / lab_.folder / "lab.json").string(), "--worker", worker.string(),
         "--json", verdict.string(), "--sandbox", "limits", "--seed", std::to_string(seed)},
        {"PATH=/usr/bin:/bin", "LANG=C.UTF-8"}};
    if (!only.empty()) command.argv.insert(command.argv.end(), {"--exercise", only});
    Limits limits;
    limits.deadline = std::chrono::minutes(15);
    limits.memory_bytes = limits.file_bytes = limits.processes = unlimited;
    const Outcome outcome = run_limited(command, limits);
    if (!fs::exists(verdict)) throw Error("no verdict: {}", outcome.output);
    return lab_result_from_text(read_file(verdict));
  }

  fs::path tree_, build_;
  const CourseLab& lab_;
  const LabTools& tools_;
  Sandbox sandbox_ = Sandbox::as_found(Level::limits, {});
  int seeds_, pairs_ = 0, failures_ = 0;
};

}  // namespace
}  // namespace carlo::grader

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    using namespace carlo::grader;
    if (argc != 6) throw carlo::Error("expected TREE BUILD LAB SEEDS CLASS");
    const std::filesystem::path tree = argv[1], build = argv[2];
    const std::vector<CourseLab> labs = course_labs(tree / "labs", {std::stoi(argv[3])});
    const CleanTree clean(tree, build, labs);
    Seeds seeds(tree, build, labs.front(), clean, std::stoi(argv[4]));
    std::set<std::filesystem::path> submissions;
    for (const auto& entry : std::filesystem::directory_iterator(argv[5]))
      submissions.insert(entry.path());
    for (const std::filesystem::path& submission : submissions)
      seeds.check(submission);
    return seeds.end();
  });
}
