#include "course/report/lab_app.h"

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/cli/wrap.h"
#include "course/guide/own_files.h"
#include "course/guide/verdicts.h"
#include "course/json/json_fields.h"
#include "course/report/machine.h"
#include "course/report/page.h"
#include "course/report/predictions.h"
#include "course/report/signals.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/quotes.h"
#include "support/terminal.h"
#include "support/wall_clock.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace carlo {
namespace {

struct Arguments {
  LabOptions options;
  std::string page, json, step;
  bool no_page = false, no_predict = false, predict = false;
};

/// The experiments of a lab that run.
struct Selection {
  std::vector<Experiment> experiments;
  std::vector<std::string> what_you_should_see;
  int before = 0;             ///< number of the lab's experiments before them
  std::vector<double> times;  ///< of the experiments, relative to one another
};

/// Selects the whole lab or a single step.
Selection selected(const LabApp& lab, const std::string& name) {
  if (lab.steps.empty()) {
    return {lab.experiments, lab.what_you_should_see, 0,
            std::vector<double>(lab.experiments.size(), 1)};
  }
  Selection selection;
  for (const Step& step : lab.steps) {
    if (name.empty() || name == step.name) {
      selection.experiments.insert(selection.experiments.end(), step.experiments.begin(),
                                   step.experiments.end());
      selection.what_you_should_see.push_back(step.seen);
      selection.times.resize(selection.experiments.size(), step.time);
    } else if (selection.experiments.empty()) {
      selection.before += static_cast<int>(step.experiments.size());
    }
  }
  return selection;
}

void add_step_option(CommandLine& app, const LabApp& lab, std::string& step) {
  if (lab.steps.empty()) return;
  std::vector<std::string> names;
  for (const Step& one : lab.steps)
    names.push_back(one.name);
  app.option("--step", step, "one step alone, " + lab.step_names).one_of(names);
}

void ask(Predictions& predictions, bool again) {
  predictions.ask(
      [](const std::string& text) {
        fmt::print("{}", wrapped(text));
        (void)std::fflush(stdout);
      },
      []() -> std::optional<std::string> {
        std::string line;
        if (!std::getline(std::cin, line)) return std::nullopt;
        return line;
      },
      again);
}

/// Returns whether a student runs the lab: ./carlo then says which tree it is.
bool of_student() {
  const char* tree = std::getenv("CARLO_COURSE");
  return tree != nullptr && *tree != '\0';
}

/// Predictions are kept in the student's tree.
std::optional<Predictions> predictions_of(const LabApp& lab, const Arguments& arguments) {
  const bool student = of_student();
  const bool somebody = ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1;
  if (arguments.predict && (!student || !somebody || !arguments.step.empty())) {
    throw Error("--predict works only at a terminal, and without --solutions and --step");
  }
  if (!student || arguments.no_predict) return std::nullopt;
  std::optional<Predictions> predictions(std::in_place, std::getenv("CARLO_COURSE"), lab.number);
  if (somebody && arguments.step.empty()) ask(*predictions, arguments.predict);
  return predictions;
}

void show_predictions(const Predictions& predictions, Notebook& notebook) {
  const Table table = predictions.table(notebook.results());
  if (table.rows().empty()) return;
  notebook.begin("What you predicted");
  notebook.table("predictions", table,
                 "Predictions, and what this run gave (--predict asks again)");
}

/// Returns advice for students who stop an experiment, perhaps in an endless loop.
std::string advice_when_stopped(const LabApp& lab) {
  if (!of_student()) return "";
  return fmt::format(
      "If it did not end by itself: ./carlo test {} names the exercise with the endless loop.\n",
      lab.number);
}

/// The exercises that the last verdict found wrong in a student's code as it is now.
std::vector<std::string> found_wrong(int lab_number) {
  std::vector<std::string> wrong;
  if (!of_student()) return wrong;
  const std::filesystem::path root = std::getenv("CARLO_COURSE");
  const std::filesystem::path verdicts = root / ".carlo/verdicts.json";
  if (!std::filesystem::exists(verdicts)) return wrong;
  const std::vector<Lab> labs = load_labs(root / "labs");
  const Lab& lab = find_lab(labs, lab_number);
  const VerdictBook book(verdicts);
  const OwnCode code(root / "labs", lab);
  for (const Exercise& exercise : lab.exercises) {
    if (stage_of(exercise, code, book.find(exercise)) == Stage::failed)
      wrong.push_back(exercise.number());
  }
  return wrong;
}

/// Returns the command as one could type it again.
std::string command_line(int number, int argc, char** argv) {
  std::string command = fmt::format("./carlo lab {}", number);
  if (std::filesystem::path(argv[0]).filename().string().ends_with("_solution")) {
    command += " --solutions";
  }
  for (int i = 1; i < argc; ++i)
    command += ' ' + shell_word(argv[i]);
  return command;
}

void run_experiments(const Selection& lab, const std::optional<Predictions>& predictions,
                     Notebook& notebook) {
  const double all = std::accumulate(lab.times.begin(), lab.times.end(), 0.0);
  double done = 0;
  for (std::size_t i = 0; i < lab.experiments.size(); ++i) {
    const double from = done / all;
    done += lab.times[i];
    notebook.set_experiment(lab.before + static_cast<int>(i), from, done / all);
    lab.experiments[i](notebook);
  }
  notebook.finish();
  if (predictions) show_predictions(*predictions, notebook);
  notebook.begin("What you should see");
  if (!notebook.left_out().empty()) {
    notebook.say("This section is shown once all exercises are done.");
    return;
  }
  for (const std::string& paragraph : lab.what_you_should_see)
    notebook.say(paragraph);
}

/// Lists the exercises still to be done; each experiment that misses one has already said what to
/// do.
std::string left_out_text(const std::set<std::string>& tags) {
  return fmt::format("Left out, as not implemented yet: {}", fmt::join(tags, ", "));
}

/// What --json writes.
struct Record {
  const LabApp& lab;
  const Notebook& notebook;
  double seconds;
};

void fields(JsonFields& json, Record& record) {
  const LabOptions& options = record.notebook.options();
  const std::set<std::string>& left_out = record.notebook.left_out();
  Results results = record.notebook.results();
  json.also("lab", record.lab.number);
  json.also("n", static_cast<unsigned long>(options.n));
  json.also("seed", std::to_string(options.seed));
  json.also("quick", options.quick);
  json.also("machine", machine_text());
  json.also("compiler", compiler_text());
  json.also("seconds", record.seconds);
  json.also("left_out", std::vector<std::string>(left_out.begin(), left_out.end()));
  json("tables", results);
}

void run(const LabApp& lab, const Arguments& arguments, const std::string& command) {
  std::optional<StopNote> note(std::in_place, advice_when_stopped(lab));
  // Better to learn before the experiments than after them that a file cannot be written.
  if (!arguments.json.empty()) (void)AtomicFile(arguments.json);
  const std::optional<Predictions> predictions = predictions_of(lab, arguments);
  Page page(lab.title, lab.subtitle);
  Notebook notebook(fmt::format("lab {:02}", lab.number), arguments.options, page);
  if (of_student()) notebook.report_stalls();
  report_crashes();
  if (const auto wrong = found_wrong(lab.number); !wrong.empty()) {
    notebook.warn(fmt::format(
        "Wrong by ./carlo test {}: {}. What uses it does not show what right code gives.",
        lab.number, fmt::join(wrong, ", ")));
  }
  const WallClock clock;
  run_experiments(selected(lab, arguments.step), predictions, notebook);
  const double seconds = clock.seconds();

  note.reset();  // files are written from here on

  page.fact("Command", command);
  page.fact("Seed", std::to_string(arguments.options.seed));
  page.fact("Machine", machine_text());
  page.fact("Compiler", compiler_text());
  if (!notebook.left_out().empty()) {
    fmt::print("{}\n", wrapped(coloured(Colour::yellow, left_out_text(notebook.left_out()))));
  }
  if (!arguments.json.empty()) {
    write_file(arguments.json, json_text(Record{lab, notebook, seconds}, 2) + "\n");
  }
  fmt::print("{:.1f} s in all.\n", seconds);
  if (!arguments.no_page) {
    page.write(arguments.page);
    fmt::print("The page with the plots: {}\n",
               std::filesystem::absolute(arguments.page).lexically_normal().string());
  }
}

}  // namespace

int run_lab(const LabApp& lab, int argc, char** argv) {
  return run_main([&] {
    Arguments arguments;
    arguments.options.n = lab.n;
    arguments.page = fmt::format("out/lab{:02}.html", lab.number);
    CommandLine app(lab.title + ". Runs the lab's experiments on the exercises done so far.",
                    fmt::format("./carlo lab {}", lab.number));
    auto n = app.option("--n", arguments.options.n, "largest number of points, >= 1024");
    n.range(std::int64_t{1024}, std::int64_t{1} << 30).show_default();
    app.option("--seed", arguments.options.seed, "seed of all random numbers").show_default();
    app.flag("--quick", arguments.options.quick, "fewer points and repetitions");
    app.option("--json", arguments.json, "write all tables to this file");
    auto page = app.option("--page", arguments.page, "where the page goes");
    page.show_default();
    app.flag("--no-page", arguments.no_page, "write no page");
    const Argument no_predict =
        app.flag("--no-predict", arguments.no_predict, "ask for no predictions, and show none");
    app.flag("--predict", arguments.predict, "ask for all predictions again").excludes(no_predict);
    add_step_option(app, lab, arguments.step);
    if (lab.add_options) lab.add_options(app);
    if (const auto code = app.parse(argc, argv)) return *code;
    if (arguments.options.quick && !n.given()) arguments.options.n = lab.quick_n;
    if (lab.instead) {
      if (const auto code = lab.instead(arguments.options)) return *code;
    }
    if (!page.given() && !arguments.step.empty()) {
      arguments.page = fmt::format("out/lab{:02}_{}.html", lab.number, arguments.step);
    }
    run(lab, arguments, command_line(lab.number, argc, argv));
    return 0;
  });
}

}  // namespace carlo
