#include "grader/grade/cluster_plan.h"

#include "course/json/json_fields.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace carlo::grader {

namespace fs = std::filesystem;

static void as_string(JsonFields& json, const char* name, fs::path& path) {
  std::string text = path.string();
  json(name, text);
  path = text;
}

static void fields(JsonFields& json, Source& source) {
  json("name", source.name);
  as_string(json, "path", source.path);
  json("inside", source.inside);
}

static void fields(JsonFields& json, Settings& settings) {
  as_string(json, "tree", settings.tree);
  as_string(json, "build", settings.build);
  as_string(json, "out", settings.out);
  std::vector<double> labs(settings.labs.begin(), settings.labs.end());
  json("labs", labs);
  settings.labs.assign(labs.begin(), labs.end());
  json("secret_file", settings.secret_file);
  json("sandbox", settings.sandbox);
  json("deadline", settings.deadline);
}

static void fields(JsonFields& json, ClusterPlan& plan) {
  json("settings", plan.settings);
  json("toolchain", plan.toolchain);
  json("digest", plan.digest);
  json("tasks", plan.tasks);
  json("workers", plan.workers);
  json("sources", plan.sources);
}

std::vector<Source> ClusterPlan::share(int task) const {
  std::vector<Source> mine;
  const auto step = static_cast<std::size_t>(tasks);
  for (auto i = static_cast<std::size_t>(task - 1); i < sources.size(); i += step)
    mine.push_back(sources[i]);
  return mine;
}

fs::path cluster_folder(const fs::path& out) {
  return out / ".slurm";
}

fs::path plan_file(const fs::path& out) {
  return cluster_folder(out) / "plan.json";
}

void write_plan(const ClusterPlan& plan) {
  write_file(plan_file(plan.settings.out), json_text(plan, 1) + "\n");
}

ClusterPlan read_plan(const fs::path& file) {
  ClusterPlan plan = from_json_text<ClusterPlan>(read_file(file), file.string());
  if (plan.tasks < 1 || plan.workers < 1) throw Error("{}: a plan without tasks", file.string());
  return plan;
}

void refuse_node(const fs::path& out, const RefusedNode& node) {
  const fs::path folder = cluster_folder(out) / "refused";
  fs::create_directories(folder);
  write_file(folder / node.name, node.why + "\n");
}

std::vector<RefusedNode> refused_nodes(const fs::path& out) {
  std::vector<RefusedNode> nodes;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(cluster_folder(out) / "refused", ec)) {
    const std::string name = entry.path().filename().string();
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(ec);
    if (name.starts_with(".") || ec || age > std::chrono::hours(1)) continue;
    std::string why = read_file(entry.path());
    nodes.push_back({name, why.substr(0, why.find('\n'))});
  }
  std::sort(nodes.begin(), nodes.end(),
            [](const RefusedNode& a, const RefusedNode& b) { return a.name < b.name; });
  return nodes;
}

}  // namespace carlo::grader
