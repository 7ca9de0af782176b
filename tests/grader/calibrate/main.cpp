// Calibrates the grader: judges right and wrong answers with many seeds, and reports how often it
// errs.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "grader/calibrate/page.h"
#include "grader/calibrate/runner.h"
#include "grader/calibrate/store.h"
#include "support/atomic_file.h"
#include "support/progress.h"

#include <fmt/core.h>

#include <string>
#include <vector>

namespace carlo::grader {
namespace {

struct Options {
  Places places;
  std::vector<int> labs;
  int seeds = 25, mistake_seeds = 5, at_once = 2;
  std::uint64_t first_seed = 1001;
  std::string store = "out/calibration";
  bool report_only = false;
};

void add_options(CommandLine& app, Options& options) {
  app.option("--tree-labs", options.places.labs, "the folder labs/").required();
  app.option("--programs", options.places.programs, "the folder of built programs").required();
  app.option("--labs", options.labs, "only these labs").list(',');
  app.option("--seeds", options.seeds, "gradings of each lab's solution")
      .range(0, 1'000'000)
      .show_default();
  app.option("--mistakes-seeds", options.mistake_seeds, "gradings of each mistake")
      .range(0, 1'000'000)
      .show_default();
  app.option("--first-seed", options.first_seed,
             "the first of them; 1 to 20 are those that the fast tests run")
      .show_default();
  app.option("-j", options.at_once, "judges at once").range(1, 256).show_default();
  app.option("--store", options.store, "every result is kept in this folder").show_default();
  app.flag("--report-only", options.report_only, "judge nothing: tables of what is there");
}

std::vector<Job> missing(const std::vector<Job>& all, const Store& store) {
  std::vector<Job> list;
  for (const Job& job : all) {
    if (!store.has(job.key)) list.push_back(job);
  }
  return list;
}

/// Returns everything in the store about these subjects as built now.
std::vector<Judged> judged(const std::vector<Subject>& subjects, const Store& store) {
  std::vector<Judged> list;
  for (const Job& job : jobs(subjects, 1, 1, 0)) {
    Judged one{job.subject, {}};
    for (const auto& [key, record] : store.records()) {
      const bool same =
          key.lab == job.key.lab && key.what == job.key.what && key.programs == job.key.programs;
      if (same) one.records.push_back(&record);
    }
    list.push_back(one);
  }
  return list;
}

int main(int argc, char** argv) {
  CommandLine app("Calibrates the grader: judges the solutions and the mistakes with many seeds",
                  "./carlo grade --calibrate");
  Options options;
  add_options(app, options);
  if (const auto code = app.parse(argc, argv)) return *code;
  const std::vector<Subject> all = subjects(options.places, options.labs);
  Store store(options.store);
  if (store.unreadable() > 0) {
    fmt::print(stderr, "{}: {} lines could not be read: those gradings are made again\n",
               options.store, store.unreadable());
  }
  const std::vector<Job> todo =
      missing(jobs(all, options.seeds, options.mistake_seeds, options.first_seed), store);
  if (!options.report_only) {
    Progress bar("calibrating", true);
    double done = 0;
    run_jobs(todo, options.at_once, [&](const Record& record) {
      store.append(record);
      bar.update(++done / static_cast<double>(todo.size()));
    });
  }
  const Findings found = findings(judged(all, store));
  fmt::print("{}", report_text(found));
  write_file(options.store + ".json", report_json(found));
  report_page(found).write(options.store + ".html");
  fmt::print("Page: {0}.html, for programs: {0}.json\n", options.store);
  return sound(found) ? 0 : 1;
}

}  // namespace
}  // namespace carlo::grader

int main(int argc, char** argv) {
  return carlo::run_main([&] { return carlo::grader::main(argc, argv); });
}
