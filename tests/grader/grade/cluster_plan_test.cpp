#include "grader/grade/cluster_plan.h"

#include "course/cli/scratch_folder.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <chrono>
#include <set>
#include <string>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

ClusterPlan plan_of(int submissions, int tasks) {
  ClusterPlan plan;
  plan.tasks = tasks;
  for (int i = 0; i < submissions; ++i)
    plan.sources.push_back({.name = std::to_string(i), .path = "/class"});
  return plan;
}

TEST_CASE("cluster: each submission is in one task's share, and shares differ by one at most") {
  for (const int tasks : {1, 2, 7, 10}) {
    const ClusterPlan plan = plan_of(10, tasks);
    std::set<std::string> seen;
    for (int task = 1; task <= tasks; ++task) {
      const std::vector<Source> share = plan.share(task);
      CHECK(share.size() >= static_cast<std::size_t>(10 / tasks));
      CHECK(share.size() <= static_cast<std::size_t>((10 + tasks - 1) / tasks));
      for (const Source& source : share)
        CHECK(seen.insert(source.name).second);
    }
    CHECK(seen.size() == 10);
  }
}

TEST_CASE("cluster: a plan is read as it was written") {
  const ScratchFolder scratch;
  fs::create_directory(cluster_folder(scratch.path()));
  ClusterPlan plan = plan_of(2, 2);
  plan.settings = {"/tree", "/build", scratch.path(), {1, 9}, "/secret", "landlock", 2.5};
  plan.toolchain = "g++; ld";
  plan.digest = "0123";
  plan.workers = 3;
  plan.sources[1] = {"b", "/class/all.zip", "b/b.zip"};
  write_plan(plan);
  const ClusterPlan read = read_plan(plan_file(scratch.path()));
  CHECK(read.settings.tree == "/tree");
  CHECK(read.settings.build == "/build");
  CHECK(read.settings.out == scratch.path());
  CHECK(read.settings.labs == std::vector<int>{1, 9});
  CHECK(read.settings.secret_file == "/secret");
  CHECK(read.settings.sandbox == "landlock");
  CHECK(read.settings.deadline == 2.5);
  CHECK(read.toolchain == plan.toolchain);
  CHECK(read.digest == plan.digest);
  CHECK(read.tasks == 2);
  CHECK(read.workers == 3);
  REQUIRE(read.sources.size() == 2);
  CHECK(read.sources[1].handed_in() == "all.zip/b/b.zip");
  CHECK(read.sources[1].name == "b");
  write_file(plan_file(scratch.path()), "{}");
  CHECK_THROWS_AS(read_plan(plan_file(scratch.path())), Error);
}

TEST_CASE("cluster: a node that has refused counts for an hour") {
  const ScratchFolder scratch;
  CHECK(refused_nodes(scratch.path()).empty());
  fs::create_directory(cluster_folder(scratch.path()));
  refuse_node(scratch.path(), {"node2", "no sandbox"});
  refuse_node(scratch.path(), {"node1", "another compiler"});
  const std::vector<RefusedNode> nodes = refused_nodes(scratch.path());
  REQUIRE(nodes.size() == 2);
  CHECK(nodes[0].name == "node1");
  CHECK(nodes[1].why == "no sandbox");
  const fs::path note = cluster_folder(scratch.path()) / "refused" / "node2";
  fs::last_write_time(note, fs::last_write_time(note) - std::chrono::hours(2));
  CHECK(refused_nodes(scratch.path()).size() == 1);
}

}  // namespace
}  // namespace carlo::grader
