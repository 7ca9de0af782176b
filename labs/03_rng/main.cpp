#include "course/cli/arguments.h"
#include "course/report/lab_app.h"
#include "experiments.h"
#include "generators.h"

int main(int argc, char** argv) {
  std::string stream;
  carlo::LabApp lab{
      .number = 3,
      .title = "Lab 03: random numbers",
      .subtitle = "Making them, mapping them to ranges, and finding out what is wrong with them.",
      .n = 1 << 24,
      .quick_n = 1 << 18,
      .experiments = {lab03::planes_experiment, lab03::battery_experiment,
                      lab03::estimates_experiment, lab03::conversions_experiment,
                      lab03::speed_experiment},
      .what_you_should_see = {
          "RANDU's triples lie on 15 planes, and one look along them shows it. The lecture's LCG "
          "has some 2000 planes: to see them you have to look at a small corner of the cube.",
          "No single test is enough. Equal frequencies and no correlation of neighbours catch "
          "almost nothing; the lowest bits, birthday spacings and matrix ranks catch what is "
          "linear; lagged Fibonacci fails every test that compares numbers across its lags. "
          "PCG32, xoshiro128++, Philox and splitmix64 pass everything here; mt19937 fails only "
          "linear complexity.",
          "For most integrands a weak generator is good enough, and that is what makes it "
          "dangerous: with a wave along its planes the error of an LCG stays where it is however "
          "large N grows.",
          "A float made by dividing all 32 bits reaches 1; a remainder or a division favours some "
          "integers as soon as the range is not small against 2^32.",
          "A good generator costs about a nanosecond a number, no more than a bad one; a tenth of "
          "that where eight lanes run side by side."}};
  lab.add_options = [&stream](carlo::CommandLine& app) {
    app.option("--stream", stream,
               "write this generator's raw 32-bit words to standard output and do nothing else, "
               "e.g. for `dieharder -a -g 200`");
  };
  lab.instead = [&stream](const carlo::LabOptions& options) -> std::optional<int> {
    if (stream.empty()) return std::nullopt;
    lab03::write_raw_stream(stream, options.seed);
    return 0;
  };
  return carlo::run_lab(lab, argc, argv);
}
