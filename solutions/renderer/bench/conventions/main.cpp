// `./carlo bench peers --conventions`: other renderers' quantities beside ours, as a table.

#include "../peer_program.h"
#include "conventions.h"
#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "render/interrupt.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/terminal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace {

namespace fs = std::filesystem;
using bench::Convention;
using bench::Estimate;
using nlohmann::json;

constexpr int runs = 16;      ///< of the peer, with a seed each
constexpr double most_z = 4;  ///< for 16 runs of the same mean exceeded once in 860 rows
constexpr const char* most_seconds = "300";

struct Options {
  fs::path out = "out/conventions", scripts = "solutions/renderer/bench/peers";
  std::string python = "python3", peer;
};

Estimate estimate(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double v : values)
    squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (n * (n - 1)))};
}

/// What decides the row's values, to recognize a finished one.
json definition(const Convention& row) {
  return {row.scene.shared,
          row.scene.ours,
          row.scene.stand_in,
          row.scene.window,
          row.theirs,
          row.samples,
          runs};
}

json measured(const Convention& row, const Options& options) {
  const fs::path scratch = options.out / "scratch";
  const Estimate ours = bench::our_value(row, scratch, runs);
  json task = bench::peer_task(row, scratch);
  task["runs"] = runs;
  task["seed"] = 1;
  task["output"] = fs::absolute(scratch / "peer.exr").string();
  const json answer = bench::answer_of(
      {row.what,
       {"timeout", most_seconds, options.python, (options.scripts / "conventions.py").string()},
       scratch},
      task, [] {
        if (carlo::interrupt_noted()) throw carlo::Error("interrupted; the same command continues");
      });
  const Estimate theirs = estimate(answer.at("values").get<std::vector<double>>());
  return {{"definition", definition(row)},
          {"version", answer.at("version")},
          {"ours", ours.value},
          {"ours_se", ours.standard_error},
          {"theirs", theirs.value},
          {"theirs_se", theirs.standard_error}};
}

/// What follows from the numbers and the row's text.
void judge(json& result, const Convention& row) {
  const Estimate ours{result["ours"], result["ours_se"]};
  const Estimate theirs{result["theirs"], result["theirs_se"]};
  const double z = bench::z_of(theirs, {row.factor * ours.value, row.factor * ours.standard_error});
  result["peer"] = bench::name_of(row.peer);
  result["what"] = row.what;
  result["exact"] = std::isnan(row.scene.exact) ? json() : json(row.scene.exact);
  result["factor"] = row.factor;
  result["z"] = z;
  result["rule"] = row.rule;
  result["reason"] = row.reason;
  result["as_stated"] = (std::abs(z) < most_z) == row.reason.empty();
}

std::string z_text(const json& z) {
  const double value = z;
  return fmt::format("{:.1f}", std::abs(value) < .05 ? 0 : value);
}

std::string number(const json& value, const json& error) {
  const double v = value, e = error;
  // A digit beyond the error, or six if it is smaller.
  const int digits = v == 0 || e <= 0 ? 6 : static_cast<int>(std::log10(std::abs(v) / e)) + 2;
  std::string text = fmt::format("{:.{}g}", v, std::clamp(digits, 3, 6));
  return e > 5e-6 * std::abs(v) ? fmt::format("{} ± {:.1g}", text, e) : text;
}

std::string markdown(const json& results) {
  std::string text =
      "| what | ours | closed form | theirs | factor | z | rule |\n|---|---|---|---|---|---|---|\n";
  for (const json& r : results) {
    const std::string reason = r["reason"];
    text += fmt::format("| {}: {} | {} | {} | {} | {:.6g} | {} | {}{} |\n",
                        r["peer"].get<std::string>(), r["what"].get<std::string>(),
                        number(r["ours"], r["ours_se"]),
                        r["exact"].is_null() ? "" : fmt::format("{:.6g}", r["exact"].get<double>()),
                        number(r["theirs"], r["theirs_se"]), r["factor"].get<double>(),
                        z_text(r["z"]), r["rule"].get<std::string>(),
                        reason.empty() ? "" : fmt::format(". **Differs**: {}", reason));
  }
  return text;
}

std::string csv(const json& results) {
  const auto quoted = [](std::string text) {
    for (std::size_t i = text.find('"'); i != std::string::npos; i = text.find('"', i + 2))
      text.insert(i, 1, '"');
    return '"' + text + '"';
  };
  const std::vector<std::string> columns = {"peer",    "version", "what",   "ours",
                                            "ours_se", "exact",   "theirs", "theirs_se",
                                            "factor",  "z",       "rule",   "reason"};
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const json& r : results) {
    for (const std::string& column : columns) {
      const json& value = r[column];
      text += value.is_string() ? quoted(value) : value.is_null() ? "" : value.dump();
      text += column == columns.back() ? '\n' : ',';
    }
  }
  return text;
}

/// Measures what is not finished, and writes everything after each row. Returns whether all rows
/// are as stated.
bool measure_all(const Options& options) {
  const fs::path file = options.out / "results.json";
  const json before = fs::exists(file) ? json::parse(carlo::read_file(file)) : json::array();
  json results = json::array();
  int wrong = 0;
  for (const Convention& row : bench::conventions()) {
    const bool wanted = options.peer.empty() || options.peer == bench::name_of(row.peer);
    const auto found = std::find_if(before.begin(), before.end(), [&](const json& r) {
      return r["peer"] == bench::name_of(row.peer) && r["definition"] == definition(row);
    });
    if (found == before.end() && !wanted) continue;
    const std::string name = bench::name_of(row.peer) + ": " + row.what;
    try {
      json result = found == before.end() ? measured(row, options) : *found;
      judge(result, row);
      fmt::print("{}: {} {} z {}\n", name, number(result["ours"], result["ours_se"]),
                 number(result["theirs"], result["theirs_se"]), z_text(result["z"]));
      if (!result["as_stated"].get<bool>()) {
        ++wrong;
        fmt::print("{}\n", carlo::coloured(carlo::Colour::red, "  not as stated: " + row.rule));
      }
      results.push_back(std::move(result));
    } catch (const carlo::Error& error) {
      if (carlo::interrupt_noted()) throw;
      ++wrong;
      fmt::print("{}\n", carlo::coloured(carlo::Colour::red, name + ": " + error.what()));
    }
    std::fflush(stdout);
    carlo::write_file(file, results.dump(1) + "\n");
    carlo::write_file(options.out / "table.md", markdown(results));
    carlo::write_file(options.out / "table.csv", csv(results));
  }
  fmt::print("{} rows, {} not as stated; written: {}\n", results.size(), wrong,
             (options.out / "table.md").string());
  return wrong == 0;
}

int run(int argc, char** argv) {
  Options options;
  carlo::CommandLine app(
      "Which quantity of Mitsuba 3, Cycles and LuxCore is which of ours: small "
      "scenes, rendered by both.",
      "./carlo bench peers --conventions");
  app.option("-o,--output", options.out,
             "folder for table.md, table.csv and results.json, where the same command continues")
      .default_value("out/conventions");
  app.option("--peer", options.peer, "only the rows of one peer")
      .one_of({"mitsuba", "cycles", "luxcore"});
  // Set by the script ./carlo.
  app.option("--python", options.python).hidden();
  app.option("--peer-scripts", options.scripts).hidden();
  if (const auto code = app.parse(argc, argv)) return *code;
  fs::create_directories(options.out);
  const carlo::InterruptGuard guard;
  return measure_all(options) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] { return run(argc, argv); });
}
