// The verb test: judges a student's code, or runs the suite's own tests.

#include "course/verbs/course.h"
#include "course/verbs/step_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

/// The requests of the command line.
struct TestWishes {
  std::vector<LabFolder> labs;
  Words exercises;  ///< as typed
  Words options;    ///< for the judge
  std::string page_option = "--failure-page", page;

  /// Whether it is nothing but labs.
  bool are_plain() const { return exercises.empty() && options.empty() && page_option != "--page"; }
};

std::string count_of(const Words& exercises) {
  return std::to_string(exercises.size());
}

/// A student's first question is answered without the judge, whose compilation she would wait for:
/// compiles her file, which nobody has touched yet, and says so. Returns whether it did.
bool is_answered_early(Course& course, const LabFolder& lab) {
  const std::string judge = lab.program("_judge");
  if (fs::exists(course.building.program(judge)) || !course.tree.is_untouched(lab)) return false;
  course.building.build({lab.program("_worker")});
  const std::string number = std::to_string(lab.number());
  std::printf(
      "Lab %s compiles, and all its %d exercises are not implemented yet: 0 points\n"
      "Nothing done yet: start with Lab %s.1, ./carlo hint %s.1\n",
      number.c_str(), course.tree.exercises(lab), number.c_str(), number.c_str());
  return true;
}

/// Judges a lab and saves the verdicts for ./carlo status, unless the files were edited while they
/// were compiled.
bool judge(Course& course, const LabFolder& lab, const Words& options) {
  Building& building = course.building;
  const std::string judge = lab.program("_judge"), worker = lab.program("_worker");
  const std::string before = course.tree.own_text(lab);
  building.build({judge, worker}, {judge, worker});
  Words command = list_of({building.kept(judge), "--lab", course.tree.lab_json(lab), "--worker",
                           building.kept(worker)});
  if (course.tree.own_text(lab) == before)
    command += {"--book", course.tree.root / ".carlo/verdicts.json"};
  const int code = run(command += options);
  if (!interrupted()) {
    build_what_comes_next(course, lab);
    return code == 0;
  }
  say({"\ncarlo: stopped while judging lab ", std::to_string(lab.number()), ": no new verdicts\n"});
  throw Leave{130};
}

/// Returns the judge's options for one page with that name.
Words with_page(const TestWishes& wishes, const std::string& name) {
  Words options =
      list_of({wishes.page_option,
               wishes.page.empty() ? joined({"out/test", name, ".html"}) : wishes.page});
  return options += wishes.options;
}

bool test_exercises(Course& course, const TestWishes& wishes) {
  if (wishes.labs.size() > 1)
    fail({"give whole labs (1 2) or exercises of one lab (1.2 1.3), not both"});
  std::vector<ExerciseNumber> exercises;
  for (const std::string& typed : wishes.exercises) {
    exercises.push_back(course.tree.exercise(typed));
    const ExerciseNumber& last = exercises.back();
    if (!wishes.labs.empty() && wishes.labs[0].name != last.lab.name)
      fail({"exercise ", last.text, " is not in lab ", std::to_string(wishes.labs[0].number())});
  }
  const bool several = exercises.size() > 1;
  if (several && !wishes.page.empty())
    fail({"--page FILE is for one exercise, got ", count_of(wishes.exercises)});
  if (several && is_one_of("--json", wishes.options))
    fail({"--json FILE is for one exercise, got ", count_of(wishes.exercises)});
  bool all = true;
  for (const ExerciseNumber& exercise : exercises) {
    Words options = with_page(wishes, several ? exercise.text : exercise.lab.digits());
    all = judge(course, exercise.lab, options += {"--exercise", exercise.text}) && all;
  }
  return all;
}

bool test_labs(Course& course, const TestWishes& wishes) {
  const std::vector<LabFolder> labs = wishes.labs.empty() ? course.tree.labs() : wishes.labs;
  if (!wishes.page.empty() && labs.size() != 1)
    fail({"--page FILE is for one lab, got ", std::to_string(labs.size())});
  if (labs.size() == 1 && wishes.are_plain() && is_answered_early(course, labs[0])) {
    build_what_comes_next(course, labs[0]);
    return false;
  }
  bool all = true;
  for (const LabFolder& lab : labs)
    all = judge(course, lab, with_page(wishes, lab.digits())) && all;
  return all;
}

/// The number of processors that `nproc` reports, if it is installed.
std::string processors() {
  if (!is_installed("nproc")) return std::to_string(::sysconf(_SC_NPROCESSORS_ONLN));
  const std::string said = output_of({"nproc"});
  return said.substr(0, said.find('\n'));
}

/// True if ctest's options choose among all tests.
bool chooses(const Words& options) {
  return std::any_of(options.begin(), options.end(), [](const std::string& word) {
    return word.starts_with("-R") || word.starts_with("-L") || word.starts_with("-C") ||
           word.starts_with("-I") || word.starts_with("--tests-") || word.starts_with("--label-") ||
           word == "--rerun-failed";
  });
}

/// Runs ctest in the current folder, with a line of progress wherever it is silent: a test may take
/// a minute.
[[noreturn]] void run_tests(const Words& ctest) {
  StepProgress progress("testing");
  const int code = run_listening(
      ctest, {},
      [&](const std::string& line) {
        progress.clear();
        std::puts(line.c_str());
        std::fflush(stdout);
        const std::size_t blanks = line.find_first_not_of(' ');
        if (line.find(" Test ") == line.find(' ', blanks))
          if (const auto step = step_in(line)) progress.report(*step);
      },
      [&] { progress.show(); });
  progress.clear();
  throw Leave{code};
}

/// Runs the tests that show that everything works; all of the suite with --all, or where ctest's
/// options choose among them; or those of the one lab that was named.
[[noreturn]] void test_suite(Course& course, TestWishes wishes, Words options) {
  if (!wishes.exercises.empty())
    fail({"--solutions is for a lab or for everything, got exercise ", wishes.exercises[0]});
  if (!options.empty() && is_number(options[0], options[0].size())) {
    wishes.labs.push_back(course.tree.lab(options[0]));
    options.erase(options.begin());
  }
  if (wishes.labs.size() > 1)
    fail({"--solutions is for one lab or for everything, got ", std::to_string(wishes.labs.size()),
          " labs"});
  course.tree.needs_solutions("the suite's own tests: ./carlo test N judges your work");
  const bool one = !wishes.labs.empty();
  const auto rest = std::remove(options.begin(), options.end(), "--all");
  const bool all = rest != options.end() || chooses(options);
  options.erase(rest, options.end());
  course.building.build({one ? wishes.labs[0].program("_tests") : all ? "all" : "first_tests"});
  Words command = list_of({"ctest", "--output-on-failure", "-j", processors()});
  if (one)
    command += {"-R", joined({"^", wishes.labs[0].program(), "[.]"})};
  else if (!all)
    command += {"-L", "^first$"};
  fs::current_path(course.building.folder());
  run_tests(command += options);
}

[[noreturn]] void hard_cases(Course& course, const Words& rest) {
  if (!rest.empty()) fail({"--hard takes no other argument, got '", rest[0], "'"});
  course.tree.needs_solutions("the hard cases");
  course.building.build({"hard_cases"});
  throw HandOver{{course.building.program("hard_cases")}};
}

/// Takes words[i] and its values.
void take(Course& course, TestWishes& wishes, const Words& words, std::size_t& i) {
  const std::string& word = words[i];
  if (word == "--verbose") {
    wishes.options.push_back(word);
  } else if (word == "--page") {
    wishes.page_option = word;
    if (i + 1 < words.size() && fs::path(words[i + 1]).extension() == ".html")
      wishes.page = words[++i];
  } else if (word == "--exercise") {
    wishes.exercises.push_back(value_behind(words, i, "test"));
  } else if (is_one_of(word, {"--seed", "--json", "--deadline", "--sandbox", "--probes"})) {
    wishes.options += {word, value_behind(words, i, "test")};
  } else if (word[0] == '-') {
    unknown("test", word);
  } else if (const std::size_t point = word.find('.');
             point != std::string::npos && is_number(word.substr(0, point), point) &&
             is_number(word.substr(point + 1), word.size())) {
    wishes.exercises.push_back(word);
  } else {
    wishes.labs.push_back(course.tree.lab(word));
  }
}

}  // namespace

static int test(Course& course, const Words& words) {
  TestWishes wishes;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (asks_for_help(words[i])) {
      course.tree.print_help("test");
      return 0;
    }
    if (words[i] == "--solutions") test_suite(course, wishes, behind(words, i + 1));
    if (words[i] == "--hard") hard_cases(course, behind(words, i + 1));
    take(course, wishes, words, i);
  }
  const bool passed =
      wishes.exercises.empty() ? test_labs(course, wishes) : test_exercises(course, wishes);
  return passed ? 0 : 1;
}

static const Verb test_verb("test", test);

}  // namespace carlo::verbs
