#include "context.h"

#include "course/json/json_fields.h"
#include "course/report/format.h"
#include "course/report/machine.h"
#include "course/report/stopwatch.h"
#include "image/exr.h"
#include "render/interrupt.h"
#include "render/scene_film.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/terminal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace bench {
namespace {

/// What stands beside the page.
struct Record {
  std::map<std::string, std::string> about;
  carlo::Results tables;
  std::vector<std::string> missing, faults;
};

void fields(carlo::JsonFields& json, Record& record) {
  json("about", record.about);
  json("tables", record.tables);
  json("missing", record.missing);
  json("faults", record.faults);
}

}  // namespace

Context::Context(const Options& options, double all_weights)
    : options_(options),
      page_("Speed against error",
            options.full ? "All scenes, integrators and samplers; what each idea buys."
                         : "A short run: --full takes more samples and, of our own measurements, "
                           "more scenes."),
      bar_("measuring", true),
      all_weights_(all_weights) {}

void Context::start(double weight) {
  done_ += weight_;
  weight_ = weight;
  progress(0);
}

void Context::progress(double fraction) {
  if (carlo::interrupt_noted()) {
    throw carlo::Error("interrupted; {}",
                       written_ ? options_.page.string() + " has the parts that were finished"
                                : "no page was written");
  }
  bar_.update(std::min((done_ + weight_ * fraction) / all_weights_, 1.0));
}

void Context::table(const std::string& key, const carlo::Table& table, std::string_view caption) {
  page_.table(table, caption);
  results_.tables.insert_or_assign(key, table);
  bar_.clear();
  fmt::print("{}\n{}\n", caption, table.text());
  std::fflush(stdout);
}

void Context::remark(const std::string& line) {
  page_.note(line);
  bar_.clear();
  fmt::print("{}\n\n", line);
  std::fflush(stdout);
}

void Context::fault(const std::string& line) {
  faults_.push_back(line);
  page_.note(line);
  bar_.clear();
  fmt::print("{}\n\n", carlo::coloured(carlo::Colour::red, line));
  std::fflush(stdout);
}

void Context::write(const std::vector<std::string>& missing) {
  bar_.clear();
  carlo::Page page = page_;
  if (!missing.empty()) page.note(fmt::format("Unfinished: without {}.", fmt::join(missing, ", ")));
  double load[3] = {};
  const bool known = getloadavg(load, 3) == 3;
  const std::string load_text =
      known ? fmt::format("{:.1f} in the last minute, {:.1f} in the last quarter of an hour",
                          load[0], load[2])
            : "not known";
  const std::vector<std::pair<std::string, std::string>> facts = {
      {"Command", fmt::format("./carlo bench{}{}{} --seed {}", options_.full ? " --full" : "",
                              options_.only.empty() ? "" : " --only ",
                              fmt::join(options_.only, ","), options_.seed)},
      {"Seed", std::to_string(options_.seed)},
      {"Machine", carlo::machine_text()},
      {"Vector instructions", carlo::instruction_sets_text()},
      {"Compiler", carlo::compiler_text()},
      {"Load", load_text}};
  for (const auto& [name, value] : facts)
    page.fact(name, value);
  page.write(options_.page);
  const auto json = std::filesystem::path(options_.page).replace_extension(".json");
  const Record record{{facts.begin(), facts.end()}, results_, missing, faults_};
  carlo::write_file(json, carlo::json_text(record, 2) + "\n");
  written_ = true;
  if (missing.empty()) fmt::print("written: {} and {}\n", options_.page.string(), json.string());
}

carlo::Cell spread_cell(const Spread& s) {
  return {fmt::format("{} [{}, {}]", carlo::number_text(s.median, 3),
                      carlo::number_text(s.least, 3), carlo::number_text(s.greatest, 3)),
          s.median};
}

carlo::Cell seconds_spread_cell(const Spread& s) {
  return {fmt::format("{} [{}, {}]", carlo::duration_text(s.median), carlo::duration_text(s.least),
                      carlo::duration_text(s.greatest)),
          s.median};
}

Rendered render_timed(const carlo::Integrator& integrator, const carlo::Scene& scene,
                      std::uint32_t spp) {
  const carlo::Stopwatch stopwatch;
  carlo::RenderResult result = carlo::render(integrator, scene.width, scene.height,
                                             {.spp = spp, .threads = 1, .progress = false});
  return {std::move(result.film), stopwatch.seconds(), static_cast<double>(result.counts.paths),
          static_cast<double>(result.counts.rays)};
}

using carlo::Image;

std::set<std::string> reference_scenes(const Options& options) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(options.references)) {
    if (entry.path().extension() == ".exr") names.insert(entry.path().stem().string());
  }
  return names;
}

Reference read_reference(const std::filesystem::path& path, int size) {
  const carlo::ExrFile file = carlo::read_exr(path);
  if (!file.standard_error) throw carlo::Error("{} has no standard error", path.string());
  const int factor = file.image.width / size;
  if (file.image.width != factor * size || file.image.height != factor * size) {
    throw carlo::Error("{} has {} x {} pixels, which {} x {} does not divide", path.string(),
                       file.image.width, file.image.height, size, size);
  }
  const auto share = 1 / static_cast<float>(factor * factor);
  Reference result{Image(size, size), 0};
  const double weight = static_cast<double>(share) / (3.0 * size * size);
  for (int y = 0; y < file.image.height; ++y) {
    for (int x = 0; x < file.image.width; ++x) {
      result.image.at(x / factor, y / factor) += share * file.image.at(x, y);
      // The variance of a mean over factor^2 pixels is the mean of their variances over factor^2.
      for (int c = 0; c < 3; ++c) {
        const double error = file.standard_error->at(x, y)[c];
        result.noise += weight * static_cast<double>(share) * error * error;
      }
    }
  }
  return result;
}

}  // namespace bench
