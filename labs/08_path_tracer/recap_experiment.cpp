#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "experiments.h"
#include "images/images.h"
#include "numeric/robust.h"
#include "recap_room.h"
#include "stats/running_mean.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

// The Recap in rooms where the right answer, and that of the printed forms, are known.

namespace lab08 {
namespace {

/// The most calls of one path. For albedo .8, one path in 10^24 needs more.
constexpr int most_calls = 256;

struct NamedRoom {
  std::string name;
  RecapRoom room;
};

/// The emission of the ball is such that the wall has radiance 5, 2 and 2.
std::vector<NamedRoom> rooms() {
  return {{"walls that emit", {0.8, 0.5, 1, 5}},
          {"dark walls", {0.5, 0.5, 0, 10}},
          {"dark walls, small ball", {0.5, 0.1, 0, 202}}};
}

struct NamedForm {
  std::string name;
  RecapForm form;
  double (RecapRoom::*mean)() const;  ///< in theory
};

std::vector<NamedForm> forms() {
  return {
      {"d' at random, as printed", random_direction_as_printed, &RecapRoom::random_direction_mean},
      {"the Recap, as printed", recap_as_printed, &RecapRoom::recap_mean},
      {"the Recap, mended", recap_mended, &RecapRoom::exact}};
}

/// The results of many paths.
struct Tally {
  carlo::RunningMean radiance;
  double calls = 0, cut = 0, seconds = 0;
};

Tally many_paths(const NamedRoom& in, RecapForm form, std::int64_t n, Rng rng) {
  const World world(in.room.scene());
  Tally tally;
  const carlo::Stopwatch watch;
  for (std::int64_t i = 0; i < n; ++i) {
    const RecapPath path = form(world, in.room.light(), RecapRoom::ray(), most_calls, rng);
    tally.radiance.add(static_cast<double>(path.radiance.r));
    tally.calls += path.calls;
    tally.cut += path.cut ? 1 : 0;
  }
  tally.seconds = watch.seconds();
  return tally;
}

void add_row(carlo::Table& table, const NamedRoom& in, const NamedForm& form, const Tally& tally) {
  const double exact = in.room.exact(), theory = (in.room.*form.mean)();
  const double n = tally.radiance.count(), mean = tally.radiance.mean();
  const double error = tally.radiance.error();
  table.add_row({in.name, form.name, exact, carlo::interval_cell(mean, 1.96 * error),
                 std::isinf(theory) ? carlo::Cell("none") : carlo::Cell(theory),
                 carlo::number_cell(mean / exact), error, carlo::number_cell(tally.calls / n),
                 carlo::Cell(fmt::format("{:.3g} %", 100 * tally.cut / n), tally.cut / n),
                 carlo::seconds_cell(tally.seconds)});
}

/// The factors of the Recap's two rays, relative to the right ones.
carlo::Table weights_table() {
  carlo::Table table({"ball / room", "solid angle", "p_light", "light ray", "non-light ray"},
                     {"ball", "solid_angle", "p_light", "light", "non_light"});
  for (const double ball : {0.05, 0.1, 0.25, 0.5, 0.75, 0.9}) {
    const RecapRoom room{0.5, ball, 0, 1};
    table.add_row({ball, room.solid_angle(), 1 / room.solid_angle(), room.light_ratio(),
                   room.non_light_ratio()});
  }
  return table;
}

}  // namespace

void recap_experiment(Notebook& notebook) {
  notebook.begin("The Recap, word for word and mended");
  notebook.say(
      "A ball of light in a round room, where the wall's radiance has a closed form. The "
      "lecture's TracePath divides by p_emit, but not by the density of its direction d'. With "
      "one direction d' at random each bounce is too dark by 2 pi. The Recap's two rays are off "
      "by factors of their own, which depend on the light's solid angle. Where the walls do not "
      "emit its light rays end at the light, and nothing ends its non-light rays: every path "
      "here is cut off.");
  carlo::Table table(
      {"room", "method", "exact", "mean", "in theory", "mean / exact", "std. error", "calls a path",
       "cut off", "time"},
      {"room", "method", "exact", "mean", "theory", "ratio", "error", "calls", "cut", "seconds"});
  const std::int64_t paths = notebook.options().n / 16;
  double done = 0;
  for (const NamedRoom& in : rooms()) {
    for (const NamedForm& form : forms()) {
      notebook.attempt(
          [&] { add_row(table, in, form, many_paths(in, form.form, paths, notebook.rng())); });
      notebook.progress(++done, 9);
    }
  }
  if (table.rows().empty()) return;
  notebook.table("recap", table,
                 fmt::format("The printed forms and the corrected one: means with their 95 % "
                             "interval, of {} paths of at most {} calls",
                             carlo::count_text(paths), most_calls));
  notebook.table("recap_weights", weights_table(),
                 fmt::format("What the Recap multiplies its rays with, over what it should be; for "
                             "one direction d' at random it is 1/(2 pi) = {:.3f}",
                             1 / (2 * carlo::pi)));
}

}  // namespace lab08
