#pragma once

#include "course/report/page.h"
#include "course/report/results.h"
#include "course/report/table.h"
#include "image/image.h"
#include "render/driver.h"
#include "renderer/bench/spread.h"
#include "scene/scene.h"
#include "support/progress.h"

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// `./carlo bench`: all measurements in one run, on one page.

namespace bench {

struct Options {
  bool full = false;  ///< all scenes, larger films, more samples and runs
  std::uint64_t seed = 1;
  std::filesystem::path scenes, references, scratch;
  std::filesystem::path page;
  std::string peers;                   ///< the Python that has the peers; empty: none are measured
  std::filesystem::path peer_scripts;  ///< the scripts that it runs
  std::vector<std::string> only;       ///< parts of the page; empty: all
  /// What is measured beside other renderers; empty: all that can be.
  std::vector<std::string> peer_scenes;
  std::string peer;  ///< mitsuba, cycles or luxcore; empty: all that are installed
};

/// The output of every part of the benchmark: the page, and the same numbers as JSON.
class Context {
 public:
  /// `all_weights`: the sum of the weights that start() will be given.
  Context(const Options& options, double all_weights);

  const Options& options() const { return options_; }
  carlo::Page& page() { return page_; }

  /// Starts the next part of the run; `weight` is its share, roughly in seconds.
  void start(double weight);
  void begin(std::string_view title) { page_.section(title); }
  /// Reports the finished fraction of the current part, in [0, 1]. Throws Error after Ctrl-C.
  void progress(double fraction);
  void table(const std::string& key, const carlo::Table& table, std::string_view caption);
  /// Prints a line to the terminal and the page.
  void remark(const std::string& line);
  /// The same in red, for a measurement that is not as it should be. The run continues, and fails
  /// in the end.
  void fault(const std::string& line);
  bool sound() const { return faults_.empty(); }

  /// Writes the page and, beside it, the JSON file; `missing`: the parts that are still to come.
  void write(const std::vector<std::string>& missing = {});

 private:
  Options options_;
  carlo::Page page_;
  carlo::Progress bar_;
  carlo::Results results_;
  std::vector<std::string> faults_;
  bool written_ = false;
  double all_weights_, done_ = 0, weight_ = 0;
};

/// "0.123 [0.12, 0.13]"; machine-readable output gets the median.
carlo::Cell spread_cell(const Spread& spread);
/// The same for durations.
carlo::Cell seconds_spread_cell(const Spread& spread);

/// One render on one thread.
struct Rendered {
  carlo::Film film;
  double seconds;  ///< of one processor
  double paths, rays;
};
Rendered render_timed(const carlo::Integrator& integrator, const carlo::Scene& scene,
                      std::uint32_t spp);

/// The parts, in the order of the page.
void bench_scenes(Context& context);
void bench_equal_time(Context& context);
void bench_threads(Context& context);
void bench_triangles(Context& context);
void bench_shapes(Context& context);
void bench_lights(Context& context);
void bench_depth(Context& context);
void bench_needs(Context& context);
void bench_floors(Context& context);
/// Does nothing without a Python that has the peers.
void bench_peers(Context& context);

/// Measures one mesh in a process of its own, and prints the results for bench_triangles().
void print_mesh_costs(const std::filesystem::path& scene);

/// A reference image of tests/references/scenes on a film of `size` x `size`, and its own
/// contribution to a mean square error against it.
struct Reference {
  carlo::Image image;
  double noise = 0;  ///< the mean over pixels and channels of its squared standard error
};

/// The scenes that have a reference image.
std::set<std::string> reference_scenes(const Options& options);

/// Throws Error when the file's size is not a multiple of `size`, or it lacks the standard error.
Reference read_reference(const std::filesystem::path& path, int size);

}  // namespace bench
