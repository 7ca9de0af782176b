// Checks of exercise 9.7, interpolate() and cached_irradiance(), all exact.

#include "09_bias/irradiance_theory.h"
#include "grader/judge/judge.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab09_tests;

namespace {

namespace use_slips {

const Diagnosis division_by_zero{
    "error-zero",
    "exactly at a record its error is 0 and the weight 1/0: use this record alone "
    "there."};
const Diagnosis invented{"something-from-nothing",
                         "if no record can be used, return nothing: std::nullopt."};
const Diagnosis not_kept{"record-not-kept", "a new record has to be added to the cache."};
const Diagnosis made_always{"made-always",
                            "make() is called although records can be used: avoiding it is the "
                            "point of the cache."};
const Diagnosis made_twice{"made-twice",
                           "make() is called twice for one record: call it once and keep its "
                           "result."};
const Diagnosis kept_always{"interpolated-values-kept",
                            "interpolated values are added to the cache: they are not records, "
                            "and their errors accumulate."};

}  // namespace use_slips

struct Answered {
  bool any;
  Double3 E;

  bool is(const std::optional<Double3>& value) const {
    if (!value || !any) return any == value.has_value();
    for (const int c : {0, 1, 2}) {
      if (!(std::abs(E[c] - (*value)[c]) <= 2e-5 * std::abs((*value)[c]))) return false;
    }
    return true;
  }
  std::string text() const {
    return any ? fmt::format("({:.5g}, {:.5g}, {:.5g})", E.x, E.y, E.z) : "nothing";
  }
};

struct Interpolations {
  std::vector<Query> queries;
  std::vector<Answered> answers;

  bool fits(std::size_t i, Slip97 slip) const {
    const Query& q = queries[i];
    return answers[i].is(interpolated97(q.records, q.p, q.n, q.most, slip));
  }
  bool fits(Slip97 slip) const {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (!fits(i, slip)) return false;
    }
    return true;
  }
};

Interpolations interpolations(std::int64_t drawn) {
  const auto count = drawn == 0 ? named_queries().size() : static_cast<std::size_t>(drawn);
  const Answer rows = probe("Lab 9.7 interpolated", {.n = drawn},
                            {.rows = count,
                             .columns = 4,
                             .finite = false,
                             .of = drawn == 0 ? "lists of records" : "drawn lists of records"});
  Interpolations all{drawn == 0 ? named_queries() : drawn_queries(rows.seed, drawn), {}};
  for (std::size_t i = 0; i < count; ++i)
    all.answers.push_back({rows.at(i, 0) == 1, {rows.at(i, 1), rows.at(i, 2), rows.at(i, 3)}});
  return all;
}

/// The mistakes that explain all answers.
std::vector<Diagnosis> common_slip97(const Interpolations& all) {
  std::vector<Diagnosis> fitting;
  for (const auto& slips : {use_slips97(), error_slips97()}) {
    for (const Told97& told : slips) {
      if (all.fits(told.slip)) fitting.push_back(told.diagnosis);
    }
  }
  return fitting;
}

/// One row of the probe "Lab 9.7 cache".
struct CacheRow {
  Double3 E{0};
  double made = 0, kept = 0;

  bool is(const CacheRow& other) const {
    return made == other.made && kept == other.kept &&
           glm::length(E - other.E) <= 1e-5 * glm::length(other.E);
  }
};

enum class CacheSlip { none, not_kept, made_always, made_first, made_twice };

/// The rows of a right solution, or of one with a given mistake.
std::vector<CacheRow> cache_rows(const std::vector<Asker>& askers, CacheSlip slip) {
  std::vector<KnownRecord> records;
  std::vector<CacheRow> rows;
  double made = 0;
  for (const Asker& asker : askers) {
    auto E = interpolated97(records, asker.p, asker.n, cache_most, Slip97::none);
    const bool known = E && slip != CacheSlip::made_always;
    if (!known || slip == CacheSlip::made_first) made += slip == CacheSlip::made_twice ? 2 : 1;
    const KnownRecord record = made_at(asker.p, asker.n);
    if (!known) E = Double3(record.E);
    if (!known && slip != CacheSlip::not_kept) records.push_back(record);
    rows.push_back({*E, made, static_cast<double>(records.size())});
  }
  return rows;
}

std::vector<Diagnosis> cache_slip(const std::vector<Asker>& askers,
                                  const std::vector<CacheRow>& rows) {
  if (rows.back().kept > rows.back().made) return {use_slips::kept_always};
  const std::pair<CacheSlip, Diagnosis> slips[] = {{CacheSlip::not_kept, use_slips::not_kept},
                                                   {CacheSlip::made_always, use_slips::made_always},
                                                   {CacheSlip::made_first, use_slips::made_always},
                                                   {CacheSlip::made_twice, use_slips::made_twice}};
  for (const auto& [slip, diagnosis] : slips) {
    const std::vector<CacheRow> wrong = cache_rows(askers, slip);
    bool fits = true;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      fits = fits && rows[i].made == wrong[i].made && rows[i].kept == wrong[i].kept;
    }
    if (fits) return {diagnosis};
  }
  return {};
}

}  // namespace

TEST_CASE("Lab 9.7: irradiance from records near and far, turned, in front and behind",
          "[lab09][ex7]") {
  const Interpolations all = interpolations(0);
  const std::vector<Diagnosis> slip = common_slip97(all);
  for (std::size_t i = 0; i < all.queries.size(); ++i) {
    const Query& q = all.queries[i];
    const Answered& answer = all.answers[i];
    const auto right = interpolated97(q.records, q.p, q.n, q.most, Slip97::none);
    std::vector<Diagnosis> diagnoses = slip;
    const bool number = std::isfinite(answer.E.x + answer.E.y + answer.E.z);
    if (answer.any && (!number || !right) && q.records.empty()) diagnoses = {use_slips::invented};
    if (answer.any && !number && !q.records.empty()) diagnoses = {use_slips::division_by_zero};
    judge(holds("irradiance from " + std::string(q.name), all.fits(i, Slip97::none), answer.text(),
                right ? Answered{true, *right}.text() : "nothing", diagnoses));
  }
}

TEST_CASE("Lab 9.7: irradiance from records drawn at random", "[lab09][ex7]") {
  const Interpolations all = interpolations(300);
  std::size_t wrong = 0, first = all.queries.size();
  for (std::size_t i = all.queries.size(); i-- > 0;) {
    if (all.fits(i, Slip97::none)) continue;
    ++wrong;
    first = i;
  }
  if (wrong == 0) {
    judge(holds("irradiance from lists of eight records", true, "right for all 300", "right"));
    return;
  }
  const Query& q = all.queries[first];
  const auto right = interpolated97(q.records, q.p, q.n, q.most, Slip97::none);
  judge(holds(fmt::format("irradiance from lists of eight records (number {})", first + 1), false,
              fmt::format("{}; {} of 300 are wrong", all.answers[first].text(), wrong),
              right ? Answered{true, *right}.text() : "nothing", common_slip97(all)));
}

TEST_CASE("Lab 9.7: a record is made where none serves, once, and kept", "[lab09][ex7]") {
  constexpr std::int64_t count = 160;
  const Answer answer = probe("Lab 9.7 cache", {.n = count},
                              {.rows = count, .columns = 5, .of = "160 points that ask"});
  const std::vector<Asker> asking = askers(answer.seed, count);
  std::vector<CacheRow> rows;
  for (std::size_t i = 0; i < count; ++i) {
    rows.push_back(
        {{answer.at(i, 0), answer.at(i, 1), answer.at(i, 2)}, answer.at(i, 3), answer.at(i, 4)});
  }
  const std::vector<CacheRow> right = cache_rows(asking, CacheSlip::none);
  std::size_t first = 0;
  while (first < count && rows[first].is(right[first]))
    ++first;
  const auto text = [](const CacheRow& row) {
    return fmt::format("E = ({:.5g}, {:.5g}, {:.5g}), {:g} made, {:g} kept", row.E.x, row.E.y,
                       row.E.z, row.made, row.kept);
  };
  const bool passed = first == count;
  const std::size_t shown = passed ? count - 1 : first;
  judge(holds(fmt::format("after {} points have asked", shown + 1), passed, text(rows[shown]),
              text(right[shown]), passed ? std::vector<Diagnosis>{} : cache_slip(asking, rows)));
}

TEST_CASE("Lab 9.7: in a furnace all irradiances are the same, interpolated or not",
          "[lab09][ex7]") {
  constexpr std::size_t count = 40;
  const Rows rows = probe("Lab 9.7 furnace", {.n = count},
                          {.rows = count, .finite = false, .of = "points of a furnace"});
  const double albedo = furnace_albedo;
  const double right = std::numbers::pi * (1 - std::pow(albedo, furnace_bounces)) / (1 - albedo);
  judge(all_equal("irradiance in a furnace after four bounces", rows.values,
                  std::vector<double>(count, right), 1e-4 * right));
}
