// Grades the corpus of attacks at one level of the sandbox and compares marks, files and processes
// with what they must be.

#include "canary.h"
#include "course/cli/arguments.h"
#include "course/cli/descriptor.h"
#include "course/cli/main_guard.h"
#include "course/cli/program.h"
#include "fixture.h"
#include "grader/grade/record.h"
#include "grader/judge/sandbox.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string attacks, tree, build, work, level = "bubblewrap";
  std::vector<std::string> only, except;
  int jobs = 2;
  double deadline = 5;
  bool prepare = false;
};

void add_options(carlo::CommandLine& app, Options& options) {
  app.option("--attacks", options.attacks, "the corpus").required();
  app.option("--tree", options.tree, "the repository").required();
  app.option("--build", options.build, "its build folder").required();
  app.option("--work", options.work, "a folder that is emptied and used").required();
  app.option("--level", options.level, "of the sandbox").show_default();
  app.option("--only", options.only, "these attacks alone").list(',');
  app.option("--except", options.except, "all but these").list(',');
  app.option("-j,--jobs", options.jobs, "submissions at a time").show_default();
  app.option("--deadline", options.deadline, "seconds a probe may take").show_default();
  app.flag("--prepare", options.prepare,
           "grade nothing: hand in to WORK/class and print the points deserved");
}

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

std::vector<Fixture> chosen(const Options& options) {
  std::vector<Fixture> list;
  for (const Fixture& fixture : load_fixtures(options.attacks)) {
    const bool wanted = options.only.empty() || contains(options.only, fixture.name);
    if (wanted && !contains(options.except, fixture.name) && fixture.is_for(options.level)) {
      list.push_back(fixture);
    }
  }
  if (list.empty()) throw Error("no attack of these is for the level \"{}\"", options.level);
  return list;
}

Places make_places(const Options& options) {
  const fs::path work = fs::absolute(options.work);
  // The folder may hold what root should not remove by mistake.
  if (fs::exists(work) && !fs::is_empty(work) && !fs::exists(work / "attacks.log")) {
    throw Error("{}: not empty, and not from an earlier run", work.string());
  }
  fs::remove_all(work);
  Places places{fs::canonical(options.tree), fs::canonical(options.build), work / "class",
                work / "out", work / "canary"};
  for (const fs::path& folder : {places.submissions, places.out, places.canary, work / "tmp"})
    fs::create_directories(folder);
  write_file(work / "attacks.log", "");
  write_file(places.canary / "canary.txt", "still the same\n");
  // Everybody may write here: only the sandbox keeps an attack from it. Weaker levels do not.
  const Level level = level_of(options.level);
  if (level == Level::landlock || level == Level::bubblewrap) {
    fs::permissions(places.canary, fs::perms::all);
    fs::permissions(places.canary / "canary.txt", fs::perms::all);
  }
  return places;
}

/// Runs carlo_grade to its end; its output goes to attacks.log. Returns its exit code.
int run_grader(const Options& options, const Places& places) {
  const fs::path work = places.out.parent_path();
  std::vector<std::string> words{places.build / "bin/carlo_grade",
                                 "--tree",
                                 places.tree,
                                 "--build",
                                 places.build,
                                 "--labs",
                                 "1",
                                 "--sandbox",
                                 options.level,
                                 "--deadline",
                                 fmt::format("{}", options.deadline),
                                 "-j",
                                 std::to_string(options.jobs),
                                 "-o",
                                 places.out,
                                 places.submissions};
  ::setenv("TMPDIR", (work / "tmp").c_str(), 1);
  const Descriptor log(
      ::open((work / "attacks.log").c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  const int status = wait_for(start_program(words, {.output = log.get(), .error = log.get()}));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Returns whether some submission has no marks because others kept the processors so busy that it
/// could not be judged.
bool was_too_busy(const std::vector<Fixture>& fixtures, const Places& places) {
  return std::any_of(fixtures.begin(), fixtures.end(), [&](const Fixture& fixture) {
    const std::optional<Record> record = load_record(places.out / fixture.name);
    return record && record->labs.size() == 1 && state_of(record->labs.front()) == "grader_error" &&
           record->labs.front().note.find("the machine was too busy") != std::string::npos;
  });
}

/// Grades as an instructor does: repeats the command when the grader asks for that. An attack that
/// prevents its own marks does so each time.
int grade(const std::vector<Fixture>& fixtures, const Options& options, const Places& places) {
  constexpr int most = 3;
  int code = run_grader(options, places);
  for (int i = 1; i < most && code == 1 && was_too_busy(fixtures, places); ++i) {
    fmt::print("the machine was too busy for some: graded again\n");
    code = run_grader(options, places);
  }
  return code;
}

/// Returns what is wrong with the marks of an attack; empty if they are right.
std::string fault_of(const Fixture& fixture, const Record& record, const LabGrade& lab) {
  if (state_of(lab) != fixture.state) {
    return fmt::format("the lab is \"{}\", expected \"{}\" ({})", state_of(lab), fixture.state,
                       lab.note.substr(0, 200));
  }
  for (const ExerciseResult& exercise : lab.result.exercises) {
    const std::string number = exercise.number();
    const auto deserved = fixture.points.find(number);
    const double expected = deserved == fixture.points.end() ? 0 : deserved->second;
    const std::optional<double> points = points_of(exercise);
    const std::string became = to_string(exercise.status);
    if (points != expected) {
      return fmt::format("{}: {} points ({}), expected {}", number,
                         points ? points_text(*points) : "no", became, points_text(expected));
    }
    const auto status = fixture.status.find(number);
    if (status != fixture.status.end() && status->second != became) {
      return fmt::format("{}: {}, expected {}", number, became, status->second);
    }
  }
  const double seconds = lab.compile_seconds + lab.judge_seconds;
  if (!(seconds <= fixture.seconds)) return fmt::format("took more than {} s", fixture.seconds);
  if (record.name != fixture.name) return "its name is " + record.name;
  return "";
}

/// A submission may choose the content of its results, but not their size.
constexpr std::uintmax_t most_bytes = std::uintmax_t{4} << 20;

/// Returns what is wrong with a submission's files of results: their size, a missing file, or a
/// secret in one.
std::string fault_of_files(const Fixture& fixture, const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    bytes += entry.file_size();
  if (bytes > most_bytes) return fmt::format("its results take {} MB", bytes >> 20);
  for (const char* name : {"results.json", "junit.xml", "report.txt", "record.json"}) {
    if (!fs::exists(folder / name)) return fmt::format("{} is missing", name);
    const std::string text = read_file(folder / name);
    for (const std::string& secret : fixture.absent) {
      if (text.find(secret) != std::string::npos) return fmt::format("{} tells {}", name, secret);
    }
  }
  return "";
}

/// Prints a row of the table. Returns false if something is wrong.
bool judge_fixture(const Fixture& fixture, const Options& options, const Places& places) {
  const std::optional<Record> record = load_record(places.out / fixture.name);
  std::string fault = "no record", points = "-";
  double seconds = 0;
  if (record && record->labs.size() == 1) {
    const LabGrade& lab = record->labs.front();
    fault = fault_of(fixture, *record, lab);
    if (fault.empty()) fault = fault_of_files(fixture, places.out / fixture.name);
    if (lab.points()) points = points_text(*lab.points());
    seconds = lab.compile_seconds + lab.judge_seconds;
  }
  fmt::print("{:32} {:10} {:>5} {:6.1f} s  {}\n", fixture.name, options.level, points, seconds,
             fault.empty() ? "right" : "WRONG: " + fault);
  return fault.empty();
}

/// Prints what went wrong besides the marks. Returns true if nothing did.
bool tell(const std::string& title, const std::vector<std::string>& things) {
  constexpr std::size_t shown = 10;
  for (std::size_t i = 0; i < std::min(things.size(), shown); ++i)
    fmt::print("WRONG: {}: {}\n", title, things[i]);
  return things.empty();
}

std::vector<std::string> entries(const fs::path& folder) {
  std::vector<std::string> list;
  for (const auto& entry : fs::directory_iterator(folder))
    list.push_back(entry.path().string());
  return list;
}

/// CTest's word for "skipped".
constexpr int skipped = 77;

bool level_works(const std::string& level) {
  if (level_of(level) == Level::limits && ::geteuid() == 0) {
    fmt::print("skipped: as root carlo_grade refuses the level \"limits\"\n");
    return false;
  }
  try {
    Sandbox::at(level_of(level), {});
    return true;
  } catch (const Error& error) {
    fmt::print("skipped: {}\n", error.what());
    return false;
  }
}

/// For a class that has more members than attackers.
int prepare(const std::vector<Fixture>& fixtures, const Places& places) {
  for (const Fixture& fixture : fixtures) {
    hand_in(fixture, places);
    double points = 0;
    for (const auto& [exercise, deserved] : fixture.points)
      points += deserved;
    fmt::print("{} {}\n", fixture.name, points_text(points));
  }
  return 0;
}

int run(const Options& options) {
  const std::vector<Fixture> fixtures = chosen(options);
  if (options.prepare) return prepare(fixtures, make_places(options));
  if (!level_works(options.level)) return skipped;
  const Places places = make_places(options);
  for (const Fixture& fixture : fixtures)
    hand_in(fixture, places);
  gather_orphans();
  // At the two weaker levels the folders of temporary files are open to all by design.
  const Level level = level_of(options.level);
  const bool shut_in = level == Level::landlock || level == Level::bubblewrap;
  const Canary canary(
      {places.tree / "labs", places.tree / "solutions", places.tree / "tests",
       places.tree / "common", places.build / "bin", places.submissions, places.canary},
      shut_in ? std::vector<fs::path>{"/tmp", "/var/tmp", "/dev/shm"} : std::vector<fs::path>{});
  const int code = grade(fixtures, options, places);
  bool good = tell("left behind", end_those_left());
  good = tell("outside", canary.changes()) && good;
  good = tell("temporary files", entries(places.out.parent_path() / "tmp")) && good;
  if (code != 0) {
    good = false;
    fmt::print("WRONG: carlo_grade ended with {}: see {}\n", code,
               (places.out.parent_path() / "attacks.log").string());
  }
  std::size_t right = 0;
  for (const Fixture& fixture : fixtures)
    right += judge_fixture(fixture, options, places) ? 1 : 0;
  fmt::print("{} of {} attacks have the marks that they deserve at level {}{}\n", right,
             fixtures.size(), options.level, good ? ", and nothing else has changed" : "");
  return good && right == fixtures.size() ? 0 : 1;
}

}  // namespace
}  // namespace carlo::grader

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    carlo::CommandLine app("Grades the corpus of attacks and compares");
    carlo::grader::Options options;
    carlo::grader::add_options(app, options);
    if (const auto code = app.parse(argc, argv)) return *code;
    return carlo::grader::run(options);
  });
}
