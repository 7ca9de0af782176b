#include "grader/grade/judging.h"

#include "course/verdict/printed.h"
#include "course/verdict/verdict_json.h"
#include "grader/grade/compile.h"
#include "grader/grade/own_disk.h"
#include "grader/grade/precompiled_header.h"
#include "grader/grade/sha256.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <chrono>
#include <string>
#include <system_error>
#include <thread>

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

LabGrade judge_once(const Desk& desk, const CourseLab& lab, const fs::path& worker) {
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
  const Outcome outcome = run_limited(command, judge_limits());
  const bool ended = outcome.end == Outcome::End::exited && outcome.code <= 1;
  if (!ended || !fs::exists(verdict)) {
    throw Error("the judge of lab {} came to no verdict ({})", lab.number(), end_in_words(outcome));
  }
  LabGrade grade = judged(lab.lab, lab_result_from_text(read_file(verdict)));
  grade.report = outcome.output;
  grade.judge_seconds = outcome.seconds;
  grade.judge_peak_bytes = outcome.peak_bytes;
  return grade;
}

LabGrade build_and_judge(const Desk& desk, const CourseLab& lab, const LabFiles& files) {
  const fs::path worker = desk.folders.ours / fmt::format("lab{}_worker", lab.number());
  const LabTools& tools = desk.course.clean.tools(lab.lab.number);
  precompile(tools);
  const Compiled compiled = compile(files.files, tools, desk.sandbox, desk.folders, worker);
  LabGrade grade;
  if (compiled.linked) {
    grade = judge_once(desk, lab, worker);
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
                    fmt::format("{} was not handed in",
                                lab.files.size() == 1 ? lab.files.front() : "none of its files"));
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
