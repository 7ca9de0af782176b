#pragma once

#include "course/report/notebook.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

class CommandLine;

using Experiment = void (*)(Notebook& notebook);

/// A part of a lab that can be run alone.
struct Step {
  std::string name;
  std::vector<Experiment> experiments;
  std::string seen;  ///< what the student should see
  /// How long each of its experiments takes, relative to those of other steps: for the estimate of
  /// the time that is left.
  double time = 1;
};

/// A lab's executable: its experiments and the text around them.
struct LabApp {
  int number = 0;
  std::string title;               ///< "Lab 01: integration"
  std::string subtitle;            ///< one sentence under the page's title
  std::int64_t n = 1 << 18;        ///< largest number of points by default,
  std::int64_t quick_n = 1 << 14;  ///< and in a quick run
  std::vector<Experiment> experiments = {};
  std::vector<std::string> what_you_should_see = {};  ///< the last section, a paragraph each
  /// Replaces the two above: adds the option --step NAME, and lists the steps in words.
  std::vector<Step> steps = {};
  std::string step_names = {};
  /// Adds options that only this lab has.
  std::function<void(CommandLine& app)> add_options = nullptr;
  /// Called once the command line has been read; an exit code replaces the experiments.
  std::function<std::optional<int>(const LabOptions& options)> instead = nullptr;
};

/// main() of a lab: takes --n, --seed, --quick, --json, --page and --no-page, runs the experiments
/// on the exercises that are done, prints tables and writes the page (default: out/labNN.html;
/// out/labNN_STEP.html for a single step). Returns the exit code; errors are printed as one line.
int run_lab(const LabApp& lab, int argc, char** argv);

}  // namespace carlo
