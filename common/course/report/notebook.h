#pragma once

#include "course/not_implemented.h"
#include "course/report/page.h"
#include "course/report/results.h"
#include "course/report/table.h"
#include "random/rng.h"
#include "support/progress.h"

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// The options of every lab's executable.
struct LabOptions {
  std::int64_t n = 1 << 18;  ///< the largest number of points that an experiment uses
  std::uint64_t seed = 1;
  bool quick = false;  ///< fewer points and repetitions; the same experiments
};

/// The output of a lab's experiments: each heading, sentence and table goes to the console and to
/// the page, charts go to the page, tables to the JSON file as well.
class Notebook {
 public:
  Notebook(std::string label, const LabOptions& options, Page& page);

  const LabOptions& options() const { return options_; }

  /// Returns a stream of random numbers that no other call of rng() returns.
  Rng rng() { return Rng(options_.seed, next_stream_++); }

  /// Returns `full` repetitions; fewer in a quick run.
  int repetitions(int full) const { return options_.quick ? full / 4 : full; }

  void begin(std::string_view title);
  void say(std::string_view paragraph);
  /// Says something that the reader must not miss.
  void warn(const std::string& text);
  void table(const std::string& key, const Table& table, std::string_view caption);
  /// The same, but the page gets `html` (trusted) instead of the table.
  void table(const std::string& key, const Table& table, std::string_view caption,
             std::string_view html);
  /// Adds the numbers of a chart: a table that is folded on the page.
  void numbers(const std::string& key, const Table& table, std::string_view caption);
  /// The same, and not on the console: numbers that would only distract.
  void data(const std::string& key, const Table& table, std::string_view caption);
  void charts(const std::vector<Chart>& row) { page_.charts(row); }
  /// Adds trusted HTML and JavaScript to the page (page.h); prints nothing.
  void raw_html(std::string_view html) { page_.raw_html(html); }
  void script(std::string_view code) { page_.script(code); }

  /// Does `work`, which calls exercises. If one of them has not been done, says so (once per
  /// section) and returns false.
  template <class Work>
  bool attempt(const Work& work) {
    try {
      work();
      return true;
    } catch (const NotImplemented& missing) {
      leave_out(missing);
      return false;
    }
  }

  /// Reports progress: `done` of `total` steps of the current experiment.
  void progress(double done, double total);
  /// Sets the current experiment, by its number in the lab; its part of the run is between the
  /// fractions `from` and `to` of the time.
  void set_experiment(int index, double from, double to);
  /// For code that may never return: the progress line reports a standstill.
  void report_stalls() { bar_.report_stalls(); }
  void finish() { bar_.finish(); }

  /// The tags of exercises that were left out, for the last lines of the run; and everything
  /// measured.
  const std::set<std::string>& left_out() const { return left_out_; }
  const Results& results() const { return results_; }

 private:
  void leave_out(const NotImplemented& missing);
  void fold(const Table& table, std::string_view caption);
  void print_table(const std::string& key, const Table& table, std::string_view caption);

  LabOptions options_;
  Page& page_;
  Progress bar_;
  Results results_;
  std::set<std::string> left_out_;
  std::set<std::string> left_out_here_;
  std::uint64_t next_stream_ = 0;
  double from_ = 0, to_ = 1;
};

}  // namespace carlo
