#include "grader/calibrate/store.h"

#include "grader/calibrate/findings.h"
#include "grader/calibrate/power.h"
#include "support/atomic_file.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

using namespace carlo;
using namespace carlo::grader;

namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "carlo_store.XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path;
};

Record record(int lab, std::uint64_t seed, double p = .5, double effect = 0) {
  Record made;
  made.key = {lab, the_solution, seed, "feed"};
  made.cpu_seconds = 1.5;
  made.megabytes = 20;
  Verdict verdict;
  verdict.passed = true;
  verdict.what = "the mean of \"x\"";
  verdict.p = p;
  verdict.effect = Effect{effect, .25, "of all"};
  ExerciseResult exercise;
  exercise.tag = "Lab 1.1";
  exercise.status = Status::passed;
  exercise.tests = {{"Lab 1.1", "it is right", {verdict}, Status::passed, "", ""}};
  made.result.exercises = {exercise};
  return made;
}

ExerciseResult& only(Record& record) {
  return record.result.exercises.front();
}

std::vector<Diagnosis> diagnoses_of(const std::vector<std::string>& ids) {
  std::vector<Diagnosis> list;
  for (const std::string& id : ids)
    list.push_back({id, "it is so."});
  return list;
}

}  // namespace

TEST_CASE("a record survives its line", "[calibrate]") {
  Record made = record(3, 18'446'744'073'709'551'615U, 1e-300);
  only(made).status = Status::failed;
  only(made).diagnoses = diagnoses_of({"a", "b"});
  only(made).tests[0].verdicts[0].effect->measured = std::nan("");
  const std::string line = to_line(made);
  CHECK(line.find('\n') == std::string::npos);
  const auto back = record_from(line);
  REQUIRE(back);
  CHECK(to_line(*back) == line);
  CHECK(back->key.seed == made.key.seed);
  CHECK(comparisons(*back)[0].p == 1e-300);
  CHECK(std::isnan(comparisons(*back)[0].effect.measured));
  for (std::size_t length = 0; length < line.size(); ++length)
    CHECK_FALSE(record_from(line.substr(0, length)));
}

TEST_CASE("of verdicts is kept what calibration needs", "[calibrate]") {
  Record made = record(1, 1);
  Verdict exact;
  exact.what = "an exact one";
  exact.measured = "1";
  TestRecord& test = only(made).tests[0];
  test.verdicts.push_back(exact);
  exact.passed = true;
  test.verdicts.push_back(exact);
  test.printed = "words";
  const LabResult kept = kept_of(made.result);
  CHECK(kept.exercises[0].tests[0].printed.empty());
  CHECK(kept.exercises[0].tests[0].verdicts.size() == 2);
  CHECK(exact_failures(kept.exercises[0]) == 1);
  CHECK(comparisons(Record{made.key, 0, 0, 0, kept}).size() == 1);
  test.problem = "it crashed";
  CHECK(exact_failures(only(made)) == 2);
}

TEST_CASE("the store goes on where a killed run stopped", "[calibrate]") {
  const Folder folder;
  {
    Store store(folder.path / "calibration");
    store.append(record(1, 1));
    store.append(record(1, 2));
    store.append(record(2, 1));
  }
  const fs::path file = folder.path / "calibration" / "lab01.jsonl";
  // A line cut short, as by a full disk or a power failure.
  const std::string text = carlo::read_file(file);
  std::ofstream(file, std::ios::binary) << text.substr(0, text.size() - 10);
  {
    Store store(folder.path / "calibration");
    CHECK(store.unreadable() == 1);
    CHECK(store.records().size() == 2);
    CHECK(store.has(record(1, 1).key));
    CHECK_FALSE(store.has(record(1, 2).key));
    store.append(record(1, 2));
    store.append(record(1, 3));
  }
  const Store store(folder.path / "calibration");
  CHECK(store.unreadable() == 1);
  CHECK(store.records().size() == 4);
  for (const std::uint64_t seed : {1U, 2U, 3U})
    CHECK(store.has(record(1, seed).key));
}

TEST_CASE("what other programs gave is no answer about these", "[calibrate]") {
  const Folder folder;
  Store store(folder.path);
  store.append(record(1, 1));
  JobKey other = record(1, 1).key;
  other.programs = "beef";
  CHECK_FALSE(store.has(other));
}

TEST_CASE("findings count false failures and the p-values of each comparison", "[calibrate]") {
  std::vector<Record> records{record(1, 1, .3), record(1, 2, .6), record(1, 3, 1e-9)};
  records[2].exit_code = 1;
  only(records[2]).status = Status::failed;
  only(records[2]).tests[0].status = Status::failed;
  only(records[2]).tests[0].problem = "off";
  Judged solution;
  solution.subject.lab = 1;
  for (const Record& one : records)
    solution.records.push_back(&one);
  const LabFinding found = lab_finding(solution);
  CHECK(found.gradings == 3);
  CHECK(found.false_failures == 1);
  REQUIRE(found.failures.size() == 1);
  CHECK(found.failures[0] == "seed 3, Lab 1.1 is \"failed\": it is right: off");
  REQUIRE(found.comparisons.size() == 1);
  CHECK(found.comparisons[0].p_values == std::vector<double>{.3, .6, 1e-9});
  CHECK(found.all.smallest == 1e-9);
  CHECK(found.median_seconds == 1.5);
}

TEST_CASE("a cautious comparison says why", "[calibrate]") {
  ComparisonFinding finding;
  CHECK(finding.caution().empty());
  CHECK(finding.behaviour(1e-3) == Behaviour::uniform);
  finding.uniformity.ties = true;
  CHECK(finding.caution() == "it takes few values");
  finding.spread = .04;
  CHECK(finding.caution() == "theory's variance is a bound, the values have 0.04 of it");
  CHECK(finding.behaviour(1e-3) == Behaviour::cautious);
  finding.uniformity.too_small = 1e-9;
  CHECK(finding.behaviour(1e-3) == Behaviour::too_small);
  finding.spread = std::nan("");
  CHECK(finding.caution() == "it takes few values");
}

TEST_CASE("findings tell a mistake's margin and what the comparisons saw of it", "[calibrate]") {
  std::vector<Record> records{record(1, 1, 1e-20, .5), record(1, 2, 1e-3, -.3)};
  only(records[0]).status = only(records[1]).status = Status::failed;
  only(records[0]).diagnoses = diagnoses_of({"first", "second", "third"});
  Judged mistake;
  mistake.subject = {1, "wrong", "1.1", "second"};
  for (const Record& one : records)
    mistake.records.push_back(&one);
  const MistakeFinding found = mistake_finding(mistake);
  CHECK(found.runs == 2);
  CHECK(found.caught == 2);
  CHECK(found.named == 1);
  CHECK(found.alone == 0);
  CHECK(found.first_missed == "seed 1: failed, first, second, third");
  CHECK(std::abs(found.margin - (std::log10(1.25e-8) + 3)) <= 1e-3);
  mistake.subject.diagnosis = "third";
  CHECK(mistake_finding(mistake).named == 0);
  only(records[0]).diagnoses = diagnoses_of({"third"});
  CHECK(mistake_finding(mistake).alone == 1);
  CHECK(mistake_finding(mistake).first_missed == "seed 2: failed");

  std::vector<Record> right{record(1, 1)};
  Judged solution;
  solution.subject.lab = 1;
  solution.records = {&right[0]};
  const std::vector<PowerFinding> power = power_findings(lab_finding(solution), {mistake});
  REQUIRE(power.size() == 1);
  CHECK(power[0].mistakes_caught == 1);
  CHECK(power[0].weakest.mistake == "wrong");
  CHECK(std::abs(power[0].weakest.effect - .4) <= 1e-12);
  CHECK(power[0].weakest.caught == 1);
  CHECK(power[0].runs_in_sight == 2);
  CHECK(power[0].caught_in_sight == 1);

  for (Record& one : records)
    only(one).tests[0].problem = "it crashed";
  CHECK(mistake_finding(mistake).margin == std::numeric_limits<double>::infinity());
}
