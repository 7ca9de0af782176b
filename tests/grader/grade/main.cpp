// Grades submissions: one student's or a class's.

#include "cli/arguments.h"
#include "cli/atomic_file.h"
#include "cli/descriptor.h"
#include "cli/error.h"
#include "cli/main_guard.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "grader/grade/class.h"
#include "grader/grade/machine.h"
#include "grader/grade/outputs.h"
#include "verdict/printed.h"
#include "verdict/verdict.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <clocale>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> paths;
  std::string out = "out/grades", secret_file, sandbox = "auto", tree, build;
  std::vector<int> labs;
  int workers = 0;
  double deadline = 10;
  bool one = false, check_machine = false;
};

void add_options(CommandLine& app, Options& options) {
  app.option("PATH", options.paths,
             "submissions: a folder or archive of one student, or of a class with one folder or "
             "archive a student");
  app.option("-o,--out", options.out, "where marks and reports go").show_default();
  app.option("-j,--jobs", options.workers, "submissions at a time (default: one a core)")
      .range(1, 1024);
  app.option("--labs", options.labs, "only these labs, such as 1,2").list(',', false);
  app.flag("--one", options.one, "each PATH is one submission, whatever it looks like");
  app.flag("--check-machine", options.check_machine,
           "grade nothing: which sandbox works here, what it lacks, how many jobs are good");
  app.option("--secret-file", options.secret_file,
             "what seeds follow from (default: $CARLO_SECRET, else OUT/secret, made once)");
  app.option("--sandbox", options.sandbox, "auto, bubblewrap, landlock, user or limits")
      .show_default();
  app.option("--deadline", options.deadline, "seconds that one probe may take")
      .range(0.1, 3600.0)
      .show_default();
  app.option("--tree", options.tree, "the repository");
  app.option("--build", options.build, "its build folder, with judges and workers");
}

std::string random_secret() {
  std::array<unsigned char, 32> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Error("no random numbers for a secret: give one with --secret-file");
  }
  std::string text;
  for (const unsigned char byte : bytes)
    text += fmt::format("{:02x}", byte);
  return text;
}

/// The secret stays with the marks that follow from it, readable for their owner alone.
std::string kept_secret(const fs::path& file) {
  if (!fs::exists(file)) {
    const mode_t before = ::umask(077);
    write_file(file, random_secret());
    ::umask(before);
  }
  return read_file(file);
}

std::string secret_of(const Options& options) {
  std::string secret;
  if (!options.secret_file.empty()) {
    secret = read_file(options.secret_file);
  } else if (const char* given = std::getenv("CARLO_SECRET")) {
    secret = given;
  } else {
    secret = kept_secret(fs::path(options.out) / "secret");
  }
  if (secret.empty())
    throw Error("the secret is empty: seeds that follow from it are known to all");
  return secret;
}

/// Two graders in one folder would write over each other's marks.
Descriptor sole_user(const fs::path& out) {
  Descriptor folder(::open(out.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.open() || ::flock(folder.get(), LOCK_EX | LOCK_NB) != 0) {
    throw Error("{}: another grader is at work there", out.string());
  }
  return folder;
}

/// The sandbox must show a worker of this build, and the clean tree. At the level that shuts
/// nothing off, submissions have the rights of whoever grades: never root's.
Sandbox make_sandbox(const Options& options, const CleanTree& clean) {
  const View view{{clean.path() / "tree", clean.path() / "link"}, {}};
  Sandbox sandbox = options.sandbox == "auto" ? Sandbox::strongest(view)
                                              : Sandbox::at(level_of(options.sandbox), view);
  if (sandbox.level() == Level::limits && ::geteuid() == 0) {
    throw Error(
        "at the sandbox level \"limits\" submissions would run as root: grade at a stronger level, "
        "or as another user");
  }
  return sandbox;
}

std::string line_of(const Finished& finished) {
  const Record& record = finished.record;
  const std::string points = record.complete() ? points_text(*record.points()) : "no marks,";
  const std::string status = record.status() == "graded" ? "" : "  " + record.status();
  const std::string time = finished.again ? "as before" : format_seconds(finished.seconds);
  return fmt::format("{}: {} of {} points ({}){}\n", record.name, points, record.max(), time,
                     status);
}

/// The largest and the mean cost of a lab over all submissions that were judged.
std::string costs(const std::vector<Record>& records, const CourseLab& lab) {
  double worst = 0, sum = 0;
  std::size_t peak = 0;
  int count = 0;
  for (const Record& record : records) {
    for (const LabGrade& grade : record.labs) {
      if (grade.result.lab != lab.lab.number || grade.unjudged) continue;
      const double seconds = grade.compile_seconds + grade.judge_seconds;
      worst = std::max(worst, seconds);
      sum += seconds;
      peak = std::max({peak, grade.compile_peak_bytes, grade.judge_peak_bytes});
      ++count;
    }
  }
  if (count == 0) return "";
  return fmt::format("  lab {:02}: {} judged, {} each, {} at most, {} MB at most\n", lab.lab.number,
                     count, format_seconds(sum / count), format_seconds(worst), peak >> 20);
}

/// Who is who is not for the grader to guess. Returns how many.
std::size_t tell_renamed(const std::vector<Source>& sources) {
  std::size_t count = 0;
  for (const Source& source : sources) {
    if (!source.renamed) continue;
    fmt::print(stderr, "carlo: {} is graded as {}: another submission has its name\n",
               harmless(source.handed_in()), source.name);
    ++count;
  }
  return count;
}

/// A file beside the submissions may be one. Returns how many.
std::size_t tell_left_out(const std::vector<std::string>& files) {
  constexpr std::size_t shown = 20;
  for (std::size_t i = 0; i < std::min(files.size(), shown); ++i) {
    fmt::print(stderr, "carlo: {} is no folder, .zip, .tar, .tar.gz or .tgz: not graded\n",
               harmless(files[i]));
  }
  if (files.size() > shown) fmt::print(stderr, "carlo: and {} others\n", files.size() - shown);
  return files.size();
}

int finish(const Course& course, const std::vector<Record>& records, const Submissions& submissions,
           const fs::path& out) {
  write_file(out / "class.csv", class_csv(records));
  write_file(out / "timing.csv", timing_csv(records));
  const auto failures = std::count_if(records.begin(), records.end(),
                                      [](const Record& record) { return !record.complete(); });
  fmt::print("{} submissions, {} without all marks; compiling and judging took\n", records.size(),
             failures);
  for (const CourseLab& lab : course.labs)
    fmt::print("{}", costs(records, lab));
  fmt::print("marks: {}\n", (out / "class.csv").string());
  const std::size_t renamed = tell_renamed(submissions.sources);
  const std::size_t left_out = tell_left_out(submissions.left_out);
  if (failures == 0 && renamed > 0) {
    throw Error(
        "{} submissions have names that others have: class.csv says in its last column "
        "where each was found",
        renamed);
  }
  if (failures == 0 && left_out > 0) {
    throw Error(
        "not all that stands beside the submissions is one ({} files): take it away, or make folders",
        left_out);
  }
  if (failures == 0) return 0;
  throw Error(
      "{} submissions could not be graded: run the same command again, or see their "
      "report.txt",
      failures);
}

/// Marks in a class's folder would be the next run's submission. In a student's they are nothing.
void refuse_among(const std::vector<Source>& sources, const Options& options) {
  const std::string out = fs::weakly_canonical(options.out).string() + "/";
  for (const std::string& path : options.paths) {
    const fs::path whole = fs::canonical(path);
    const bool one = std::any_of(sources.begin(), sources.end(), [&](const Source& source) {
      return source.path == whole && source.inside.empty();
    });
    if (one || !out.starts_with(whole.string() + "/")) continue;
    throw Error("{}: marks in {} would be a submission next time: choose another folder with -o",
                options.out, path);
  }
}

int tell_machine() {
  const Machine machine = check_machine();
  fmt::print("{}", machine.text);
  return machine.good ? 0 : 1;
}

int run(const Options& options) {
  if (options.check_machine) return tell_machine();
  for (const auto& [name, value] :
       {std::pair("PATH", options.paths.empty()), std::pair("--tree", options.tree.empty()),
        std::pair("--build", options.build.empty())}) {
    if (value) throw Error("{} is required: see --help", name);
  }
  const fs::path tree = fs::canonical(options.tree), build = fs::canonical(options.build);
  const fs::path out = options.out;
  const std::vector<CourseLab> labs = course_labs(tree / "labs", options.labs);
  const Submissions submissions =
      find_submissions({options.paths.begin(), options.paths.end()}, labs, options.one);
  const std::vector<Source>& sources = submissions.sources;
  refuse_among(sources, options);
  fs::create_directories(out);
  const Descriptor lock = sole_user(out);
  const CleanTree clean(tree, build, labs);
  Course course{
      tree, build, labs, clean, make_sandbox(options, clean), secret_of(options), options.deadline,
      ""};
  course.digest = course_digest(course);
  fmt::print("{} submissions, sandbox: {}\n", sources.size(), course.sandbox.description());
  std::fflush(stdout);

  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  const int workers = options.workers > 0 ? options.workers : std::max(cores, 1);
  Progress progress("grading", true);
  std::size_t done = 0;
  const auto tell = [&](const Finished& finished) {
    progress.clear();
    fmt::print("{}", line_of(finished));
    std::fflush(stdout);
    progress.update(static_cast<double>(++done) / static_cast<double>(sources.size()));
  };
  const std::vector<Record> records = grade_class(course, sources, out, workers, tell);
  progress.clear();
  return finish(course, records, submissions, out);
}

}  // namespace
}  // namespace carlo::grader

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    std::setlocale(LC_CTYPE, "C.UTF-8");  // names in archives
    ::umask(022);
    carlo::CommandLine app("Grades submissions: one student's or a class's", "./carlo grade");
    carlo::grader::Options options;
    carlo::grader::add_options(app, options);
    if (const auto code = app.parse(argc, argv)) return *code;
    return carlo::grader::run(options);
  });
}
