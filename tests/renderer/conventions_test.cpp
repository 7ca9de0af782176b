// The rows of `./carlo bench peers --conventions` without the peers: our values are the closed
// forms, each peer's scene can be written, and the page has every row.

#include "renderer/bench/conventions/conventions.h"

#include "course/cli/scratch_folder.h"
#include "course/cli/source_folder.h"
#include "support/atomic_file.h"

#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <set>
#include <string>

namespace {

TEST_CASE("Our values of the conventions are the closed forms, within 4 standard errors") {
  const carlo::ScratchFolder scratch;
  std::set<std::string> done;
  for (const bench::Convention& row : bench::conventions()) {
    INFO(bench::name_of(row.peer) << ": " << row.what);
    const nlohmann::json task = bench::peer_task(row, scratch.path());
    CHECK(task.at("theirs") == row.theirs);
    const bool is_new = done.insert(row.scene.shared + row.scene.ours).second;
    if (!is_new || std::isnan(row.scene.exact)) continue;
    const bench::Estimate ours = bench::our_value(row, scratch.path(), 4);
    INFO(ours.value << " +- " << ours.standard_error << " for " << row.scene.exact);
    CHECK(std::abs(bench::z_of(ours, {row.scene.exact, 0})) < 4);
    CHECK(ours.standard_error <= .05 * row.scene.exact);
  }
}

TEST_CASE("The page of the conventions has every row and no other") {
  const std::string page =
      carlo::read_file(carlo::source_folder() / "solutions/renderer/BESIDE.md");
  std::set<std::string> names;
  for (const bench::Convention& row : bench::conventions()) {
    const std::string name = bench::name_of(row.peer) + ": " + row.what;
    INFO(name);
    CHECK(names.insert(name).second);
    const std::size_t begin = page.find("\n| " + name + " | ");
    REQUIRE(begin != std::string::npos);
    CHECK(page.substr(begin + 1, page.find('\n', begin + 1) - begin).find("| " + row.rule) !=
          std::string::npos);
  }
  std::size_t rows = 0;
  for (const std::string peer : {"mitsuba", "cycles", "luxcore"}) {
    const std::string start = "\n| " + peer + ": ";
    for (std::size_t i = page.find(start); i != std::string::npos; i = page.find(start, i + 1))
      ++rows;
  }
  CHECK(rows == names.size());
}

}  // namespace
