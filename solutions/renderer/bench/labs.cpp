#include "context.h"
#include "course/report/measure.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <limits>
#include <map>

// Estimators beside GSL's, generators beside the standard library's: measured by the labs' own
// programs, whose tables are read here.

namespace bench {
namespace {

using nlohmann::json;

json read_tables(const std::filesystem::path& path) {
  try {
    return json::parse(carlo::read_file(path));
  } catch (const json::exception& e) {
    throw carlo::Error("{} is no JSON: {}", path.string(), e.what());
  }
}

double number(const json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// One chart an integrand, one curve a method.
void integrators(Context& context) {
  const json tables = read_tables(context.options().integrators);
  std::vector<std::string> integrands;
  std::map<std::string, std::vector<carlo::Curve>> curves;
  for (const json& row : tables.at("runs")) {
    const std::string integrand = row.at("integrand"), method = row.at("method");
    auto& all = curves[integrand];
    if (all.empty()) integrands.push_back(integrand);
    if (all.empty() || all.back().name != method) all.push_back({method, {}});
    all.back().runs.push_back({static_cast<std::int64_t>(number(row.at("evaluations"))), 0,
                               number(row.at("rms_error")), number(row.at("seconds"))});
  }
  for (const std::string& integrand : integrands) {
    context.page().charts(
        carlo::error_charts(integrand, "RMS error of an average", curves[integrand]));
  }
  carlo::Table table({"integrand", "method", "RMS error at equal N", "at equal time", "time"},
                     {"integrand", "method", "error_points", "error_seconds", "seconds"});
  for (const json& row : tables.at("equal")) {
    table.add_row({row.at("integrand").get<std::string>(), row.at("method").get<std::string>(),
                   number(row.at("error_points")), number(row.at("error_seconds")),
                   carlo::seconds_cell(number(row.at("seconds")))});
  }
  context.table("integrators", table, "Lab 04's estimators beside GSL's MISER and VEGAS");
}

/// The tests that reject a generator, and the number of those that it was judged by.
struct Judged {
  std::vector<std::string> failed;
  int tests = 0;
};

std::string judged_text(const Judged& judged) {
  if (judged.tests == 0) return "not judged";
  if (judged.failed.empty()) return fmt::format("none of {}", judged.tests);
  std::string text;
  for (const std::string& test : judged.failed)
    text += (text.empty() ? "" : ", ") + test;
  return text;
}

void generators(Context& context) {
  const json tables = read_tables(context.options().generators).at("tables");
  std::map<std::string, Judged> judged;
  for (const json& row : tables.at("battery_tails")) {
    Judged& j = judged[row.at("generator")];
    ++j.tests;
    if (row.at("verdict") == "rejected") j.failed.push_back(row.at("test"));
  }
  double standard = std::numeric_limits<double>::quiet_NaN();
  for (const json& row : tables.at("speed")) {
    if (row.at("generator") == "std::mt19937") standard = number(row.at("seconds"));
  }
  carlo::Table table({"generator", "time a number", "x std::mt19937", "tests that it fails"},
                     {"generator", "seconds", "ratio", "failed"});
  for (const json& row : tables.at("speed")) {
    const double seconds = number(row.at("seconds")), ratio = seconds / standard;
    const std::string name = row.at("generator");
    table.add_row(
        {name, carlo::seconds_cell(seconds), carlo::number_cell(ratio), judged_text(judged[name])});
  }
  context.table("generators", table,
                "Lab 03's generators and the standard library's, one thread; the shortest of "
                "several rounds");
}

}  // namespace

void bench_labs(Context& context) {
  context.begin("Labs: estimators and generators");
  if (!context.options().integrators.empty()) integrators(context);
  if (!context.options().generators.empty()) generators(context);
}

}  // namespace bench
