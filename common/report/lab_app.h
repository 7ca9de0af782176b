#pragma once

#include "report/notebook.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

class CommandLine;

using Experiment = void (*)(Notebook& notebook);

/// A lab's executable: its experiments and the words around them.
struct LabApp {
  int number = 0;
  std::string title;               ///< "Lab 01: integration"
  std::string subtitle;            ///< one sentence under the page's title
  std::int64_t n = 1 << 18;        ///< largest number of points by default,
  std::int64_t quick_n = 1 << 14;  ///< and in a quick run
  std::vector<Experiment> experiments;
  int experiments_before = 0;  ///< of the whole lab, when `experiments` are a part of it
  std::vector<std::string> what_you_should_see;  ///< the last section, a paragraph each
  /// The part of the lab that runs alone, if one does: its page is out/labNN_PART.html.
  std::string part = {};
  /// Adds options of this lab alone to the common ones.
  std::function<void(CommandLine& app)> add_options = nullptr;
  /// Called once the command line has been read; an exit code takes the place of the experiments.
  std::function<std::optional<int>(const LabOptions& options)> instead = nullptr;
};

/// main() of a lab: takes --n, --seed, --quick, --json, --page and --no-page, runs the experiments
/// on the exercises that are done, prints tables and writes the page (default: out/labNN.html;
/// of a part alone out/labNN_PART.html).
/// Returns the exit code; errors are printed as one line.
int run_lab(const LabApp& lab, int argc, char** argv);

}  // namespace carlo
