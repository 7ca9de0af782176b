#include "grader/grade/judging.h"

#include "course/cli/wrap.h"
#include "course/verdict/printed.h"
#include "course/verdict/verdict_json.h"
#include "course/verdict/verdict_text.h"
#include "grader/grade/compile.h"
#include "grader/grade/own_disk.h"
#include "grader/grade/precompiled_header.h"
#include "grader/grade/replaceable.h"
#include "grader/grade/sha256.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// The judge is ours: its limits only end what hangs.
Limits judge_limits() {
  Limits limits;
  limits.deadline = std::chrono::minutes(15);
  limits.memory_bytes = limits.file_bytes = limits.processes = unlimited;
  limits.open_files = 1024;
  limits.output_bytes = limits.output_kept = std::size_t{16} << 20;
  return limits;
}

std::string end_in_words(const Outcome& outcome) {
  if (outcome.end == Outcome::End::signalled)
    return "killed by a signal: " + signal_name(outcome.code);
  if (outcome.end == Outcome::End::deadline || outcome.end == Outcome::End::starved)
    return "not done in time";
  return fmt::format("exit code {}: {}", outcome.code,
                     outcome.output.substr(0, outcome.output.find('\n')));
}

/// Files and settings of one submission.
struct Desk {
  const Course& course;
  const Sandbox& sandbox;  ///< the course's, with a user for this submission alone
  std::string identity;    ///< of the submission: its name and contents, so that seeds differ
  Folders folders;
};

/// What a judge found, and what it cost.
struct Judgement {
  LabResult result;
  Outcome outcome;
};

/// Judges all exercises of a lab, or the one of this number.
Judgement judge_once(const Desk& desk, const CourseLab& lab, const fs::path& worker,
                     const std::string& only = "") {
  const fs::path verdict = desk.folders.ours / "verdict.json";
  std::error_code ec;
  fs::remove(verdict, ec);
  Command command{
      {(desk.course.build / fmt::format("bin/lab{}_judge", lab.number())).string(), "--lab",
       (desk.course.tree / "labs" / lab.folder / "lab.json").string(), "--worker", worker.string(),
       "--json", verdict.string(), "--sandbox", to_string(desk.sandbox.level()), "--sandbox-user",
       desk.sandbox.user() ? std::to_string(*desk.sandbox.user()) : "none", "--secret-file",
       (desk.folders.ours / "secret").string(), "--submission", desk.identity, "--deadline",
       fmt::format("{}", desk.course.deadline)},
      {"PATH=/usr/bin:/bin", "LANG=C.UTF-8", "TMPDIR=" + (desk.folders.theirs / "tmp").string()}};
  if (!only.empty()) command.argv.insert(command.argv.end(), {"--exercise", only});
  const Outcome outcome = run_limited(command, judge_limits());
  const bool ended = outcome.end == Outcome::End::exited && outcome.code <= 1;
  if (!ended || !fs::exists(verdict)) {
    throw Error("the judge of lab {} came to no verdict ({})", lab.number(), end_in_words(outcome));
  }
  return {lab_result_from_text(read_file(verdict)), outcome};
}

/// Returns the exercises that one builds on, directly or through others, and that are not right.
std::vector<const Exercise*> wrong_ground(const Lab& lab, const Exercise& exercise,
                                          const LabResult& result) {
  std::set<std::string> ground(exercise.uses.begin(), exercise.uses.end());
  // Exercises come after those that they use.
  for (auto earlier = lab.exercises.rbegin(); earlier != lab.exercises.rend(); ++earlier)
    if (ground.count(earlier->tag) != 0) ground.insert(earlier->uses.begin(), earlier->uses.end());
  std::vector<const Exercise*> wrong;
  for (std::size_t i = 0; i < lab.exercises.size(); ++i) {
    const bool used = ground.count(lab.exercises[i].tag) != 0;
    if (used && result.exercises[i].status != Status::passed) wrong.push_back(&lab.exercises[i]);
  }
  return wrong;
}

/// Returns whether nothing but an exercise's own functions is missing: no other can mend it.
bool is_undone(const ExerciseResult& result) {
  return result.status == Status::not_implemented &&
         std::all_of(result.tests.begin(), result.tests.end(),
                     [](const TestRecord& test) { return test.needs.empty(); });
}

/// Judges what is not right once more where it builds on others that are not right either, with the
/// suite's versions of these. Of this second judgement, in which a student's code runs beside the
/// suite's, only points, causes and the names of failed tests are kept: nothing that it measured or
/// printed.
void judge_follow_ons(const Desk& desk, const CourseLab& lab,
                      const std::map<std::string, std::string>& files, LabGrade& grade) {
  const LabTools& tools = desk.course.clean.tools(lab.lab.number);
  if (tools.solutions.empty()) return;
  const LabResult first = grade.result;
  const fs::path worker = desk.folders.ours / "second_worker";
  std::optional<ReplaceableCode> code;
  for (std::size_t i = 0; i < first.exercises.size(); ++i) {
    const Exercise& exercise = lab.lab.exercises[i];
    ExerciseResult& result = grade.result.exercises[i];
    const std::vector<const Exercise*> wrong = wrong_ground(lab.lab, exercise, first);
    if (result.status == Status::passed || wrong.empty() || is_undone(result)) continue;
    if (!code) code.emplace(files, tools, desk.sandbox, desk.folders);
    if (!code->compiled()) return;
    std::vector<std::string> functions;
    ByItself second;
    for (const Exercise* other : wrong) {
      functions.insert(functions.end(), other->functions.begin(), other->functions.end());
      second.replaced.push_back(other->tag);
    }
    code->link(functions, worker);
    const Judgement judgement = judge_once(desk, lab, worker, result.number());
    if (judgement.result.exercises.size() != 1)
      throw Error("the judge's verdict is of another lab");
    const ExerciseResult& again = judgement.result.exercises.front();
    check_result(exercise, again);
    second.status = again.status;
    second.points = again.points;
    second.diagnoses = again.diagnoses;
    for (const TestRecord& test : again.tests)
      if (test.status != Status::passed && !test.skipped) second.failures.push_back(test.sentence);
    result.points = std::max(result.points, second.points);
    result.by_itself = second;
    grade.judge_seconds += judgement.outcome.seconds;
  }
  if (code) grade.report = wrapped(report_text(grade.result));
}

LabGrade judge_all(const Desk& desk, const CourseLab& lab,
                   const std::map<std::string, std::string>& files, const fs::path& worker) {
  const Judgement judgement = judge_once(desk, lab, worker);
  LabGrade grade = judged(lab.lab, judgement.result);
  grade.report = judgement.outcome.output;
  grade.judge_seconds = judgement.outcome.seconds;
  grade.judge_peak_bytes = judgement.outcome.peak_bytes;
  judge_follow_ons(desk, lab, files, grade);
  return grade;
}

LabGrade build_and_judge(const Desk& desk, const CourseLab& lab, const LabFiles& files) {
  const fs::path worker = desk.folders.ours / fmt::format("lab{}_worker", lab.number());
  const LabTools& tools = desk.course.clean.tools(lab.lab.number);
  precompile(tools);
  const Compiled compiled = compile(files.files, tools, desk.sandbox, desk.folders, worker);
  LabGrade grade;
  if (compiled.linked) {
    std::map<std::string, std::string> linked = files.files;
    for (const std::string& file : compiled.misfits)
      linked.erase(file);
    grade = judge_all(desk, lab, linked, worker);
  } else {
    grade = unjudged(lab.lab, Status::does_not_compile, "the code does not compile");
  }
  for (const std::string& file : lab.files) {
    if (compiled.linked && files.files.count(file) == 0) grade.note += file + ": not handed in\n";
  }
  for (const std::string& file : compiled.refused) {
    if (compiled.linked) grade.note += file + ": does not compile, and counts as not done\n";
  }
  for (const std::string& file : compiled.misfits) {
    if (compiled.linked)
      grade.note += file + ": cannot be linked with the files before it, and counts as not done\n";
  }
  if (compiled.linked) grade.note += compiled.own_names;
  grade.compiler = clipped(compiled.messages, std::size_t{256} << 10);
  grade.compile_seconds = compiled.seconds;
  grade.compile_peak_bytes = compiled.peak_bytes;
  std::error_code ec;
  fs::remove(worker, ec);
  return grade;
}

LabGrade grade_lab(const Desk& desk, const CourseLab& lab, const LabFiles& files) {
  if (!files.problems.empty()) {
    std::string note;
    for (const std::string& problem : files.problems)
      note += problem + "\n";
    return unjudged(lab.lab, Status::refused, note);
  }
  if (files.files.empty()) {
    return unjudged(lab.lab, Status::not_submitted,
                    lab.files.size() == 1 ? lab.files.front() + " was not handed in"
                                          : "none of its files was handed in");
  }
  constexpr int attempts = 2;
  for (int attempt = 1;; ++attempt) {
    try {
      return build_and_judge(desk, lab, files);
    } catch (const std::exception& error) {
      if (attempt == attempts) return unjudged(lab.lab, Status::grader_error, error.what());
      std::this_thread::sleep_for(std::chrono::seconds(2));  // for the shortage to pass
    }
  }
}

}  // namespace

Record grade(const Course& course, const std::string& name, const Intake& intake,
             const fs::path& folder) {
  const Sandbox sandbox = course.sandbox.with_new_user();
  open_to_pass(folder, sandbox.user());
  // Slightly more than a program may fill, so that exceeding the limit is noticed.
  const OwnDisk disk(folder / "disk", Limits{}.scratch_bytes * 5 / 4, sandbox.user());
  const Desk desk{course, sandbox, name + ":" + intake.digest, {folder, disk.path()}};
  fs::create_directory(disk.path() / "tmp");
  open_to_pass(disk.path() / "tmp", sandbox.user());
  // The report shows the seed. It must not reveal other seeds, so the judge gets only a digest of
  // the secret for this submission.
  Sha256 own_secret;
  own_secret.add_text(course.secret);
  own_secret.add_text(desk.identity);
  write_file(folder / "secret", own_secret.hex());
  fs::permissions(folder / "secret", fs::perms::owner_read);
  Record record{name, record_key(course, name, intake), intake.ignored, {}};
  for (const CourseLab& lab : course.labs)
    record.labs.push_back(grade_lab(desk, lab, intake.labs.at(lab.lab.number)));
  return record;
}

std::string record_key(const Course& course, const std::string& name, const Intake& intake) {
  Sha256 key;
  key.add_text(course.digest);
  key.add_text(name);
  key.add_text(intake.digest);
  return key.hex();
}

std::string course_digest(const Course& course) {
  Sha256 digest;
  digest.add_text(course.clean.digest());
  digest.add_text(sha256(course.secret));
  digest.add_text(fmt::format("{}", course.deadline));
  digest.add_text(read_file("/proc/self/exe"));
  digest.add_text(course.toolchain);
  for (const CourseLab& lab : course.labs) {
    digest.add_text(read_file(course.tree / "labs" / lab.folder / "lab.json"));
    digest.add_text(read_file(course.build / fmt::format("bin/lab{}_judge", lab.number())));
  }
  return digest.hex();
}

Record failed_record(const Course& course, const std::string& name, const std::string& why) {
  Record record{name, "", {}, {}};
  for (const CourseLab& lab : course.labs)
    record.labs.push_back(unjudged(lab.lab, Status::grader_error, why));
  return record;
}

}  // namespace carlo::grader
