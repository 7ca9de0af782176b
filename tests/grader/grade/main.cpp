// Grades submissions: one student's or a class's.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/slurm/array_job.h"
#include "course/slurm/folder_lock.h"
#include "grader/grade/class.h"
#include "grader/grade/class_page.h"
#include "grader/grade/machine.h"
#include "grader/grade/on_cluster.h"
#include "grader/grade/settings.h"
#include "grader/grade/similarity.h"
#include "grader/grade/summary.h"
#include "support/error.h"
#include "support/progress.h"
#include "support/quotes.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <algorithm>
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
  bool one = false, no_names = false, similarity = false, check_machine = false;
  bool slurm = false, no_wait = false;
  int tasks = 0;
  std::string time, partition, task;
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
  app.flag("--no-names", options.no_names, "students are numbered in class.html");
  app.flag("--similarity", options.similarity,
           "also writes similarity.html and .csv: which submissions share more than others do; "
           "installs Dolos (npm, 55 MB) the first time");
  app.flag("--check-machine", options.check_machine,
           "grade nothing: which sandbox works here, what it lacks, how many jobs are good");
  app.option("--secret-file", options.secret_file,
             "what seeds follow from (default: $CARLO_SECRET, else OUT/secret, made once)");
  app.option("--sandbox", options.sandbox, "auto, bubblewrap, landlock, user or limits")
      .show_default();
  app.option("--deadline", options.deadline, "seconds that one probe may take")
      .range(0.1, 3600.0)
      .show_default();
  app.flag("--slurm", options.slurm,
           "on a cluster, as a job array: submits what is still to be graded, and waits; the same "
           "command goes on after any failure (-j: of one task, 1)");
  app.option("--tasks", options.tasks, "with --slurm: so many (default: ten submissions each)")
      .range(1, 100000);
  app.option("--time", options.time, "with --slurm: what a task may take, such as 30 or 2:00:00");
  app.option("--partition", options.partition, "with --slurm: which one");
  app.flag("--no-wait", options.no_wait, "with --slurm: submits, and says what to type later");
  app.option("--task", options.task, "on a node: this plan's").hidden();
  app.option("--tree", options.tree, "the repository");
  app.option("--build", options.build, "its build folder, with judges and workers");
}

/// Marks in a class's folder would be the next run's submission; in a student's they are ignored.
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

/// Grades on this machine.
std::vector<Record> grade_here(const Course& course, const std::vector<Source>& sources,
                               const Options& options) {
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
  return grade_class(course, sources, options.out, workers, tell);
}

/// Returns the command that the class's page was made by, as far as marks depend on it: the page is
/// the same wherever and however often it was made. Paths may hold names.
std::string command_of(const Options& options) {
  std::string command = "./carlo grade";
  if (options.no_names) command += " SUBMISSIONS";
  for (const std::string& path : options.paths)
    command += options.no_names ? "" : " " + shell_word(path);
  for (std::size_t i = 0; i < options.labs.size(); ++i)
    command += fmt::format("{}{}", i == 0 ? " --labs " : ",", options.labs[i]);
  return command + (options.no_names ? " --no-names" : "");
}

/// Writes what is about the whole class. Marks are kept if comparing fails.
int finish(const Course& course, const std::vector<Record>& records, const Submissions& submissions,
           const Options& options) {
  const ClassWords words{!options.no_names, course.secret, command_of(options)};
  write_class(course.labs, records, options.out, words);
  int code = 0;
  if (options.similarity) {
    try {
      compare_class(course, submissions.sources, shown_names(records, words), words.names,
                    options.out, std::max(options.workers, 1));
    } catch (const std::exception& error) {
      fmt::print(stderr, "carlo: error: {}; all marks are kept\n", error.what());
      code = 1;
    }
  }
  check_class(records, submissions);
  return code;
}

int run_here(const Options& options, const Settings& settings, const std::vector<CourseLab>& labs,
             const Submissions& submissions) {
  const auto lock = slurm::FolderLock::take(settings.out, slurm::FolderLock::Use::alone);
  if (!lock) throw Error("{}: another grader is at work there", options.out);
  const CleanTree clean(settings.tree, settings.build, labs);
  const Course course = course_of(settings, labs, clean, sandbox_of(settings, clean));
  return finish(course, grade_here(course, submissions.sources, options), submissions, options);
}

int run_on_cluster(const Options& options, const Settings& settings,
                   const std::vector<CourseLab>& labs, const Submissions& submissions) {
  if (options.secret_file.empty() && std::getenv("CARLO_SECRET") != nullptr) {
    throw Error(
        "--slurm takes a --secret-file: a cluster keeps the variables of its jobs, CARLO_SECRET too");
  }
  const CleanTree clean(settings.tree, settings.build, labs);
  const Course course = course_of(settings, labs, clean, sandbox_for_nodes(settings, clean));
  fmt::print("{} submissions, sandbox of the nodes: {}\n", submissions.sources.size(),
             to_string(course.sandbox.level()));
  std::fflush(stdout);
  const ClusterOptions asked{options.tasks, options.time, options.partition,
                             std::max(options.workers, 1), !options.no_wait};
  const auto graded = grade_on_cluster(course, settings, submissions.sources, asked);
  return graded ? finish(course, graded->records, submissions, options) : 0;
}

/// Rejects options that contradict each other or lack what they need.
void check(const Options& options) {
  for (const auto& [name, missing] :
       {std::pair("PATH", options.paths.empty()), std::pair("--tree", options.tree.empty()),
        std::pair("--build", options.build.empty())}) {
    if (missing) throw Error("{} is required: see --help", name);
  }
  for (const auto& [name, given] :
       {std::pair("--tasks", options.tasks != 0), std::pair("--time", !options.time.empty()),
        std::pair("--partition", !options.partition.empty()),
        std::pair("--no-wait", options.no_wait)}) {
    if (given && !options.slurm) throw Error("{} is for --slurm", name);
  }
}

int run(const Options& options) {
  if (options.check_machine) return tell_machine();
  if (!options.task.empty()) return run_cluster_task(options.task);
  check(options);
  if (options.slurm) slurm::need_slurm();
  Settings settings{fs::canonical(options.tree), fs::canonical(options.build), {}, options.labs};
  const std::vector<CourseLab> labs = course_labs(settings.tree / "labs", options.labs);
  const Submissions submissions =
      find_submissions({options.paths.begin(), options.paths.end()}, labs, options.one);
  refuse_among(submissions.sources, options);
  if (options.similarity) {
    if (submissions.sources.size() < 2) throw Error("--similarity takes more than one submission");
    need_similarity(settings.tree);
  }
  fs::create_directories(options.out);
  settings.out = fs::canonical(options.out);
  if (!options.secret_file.empty()) settings.secret_file = fs::absolute(options.secret_file);
  settings.sandbox = options.sandbox;
  settings.deadline = options.deadline;
  return options.slurm ? run_on_cluster(options, settings, labs, submissions)
                       : run_here(options, settings, labs, submissions);
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
