// Probes of exercise 9.7: they call the student's functions and return raw values;
// checks_irradiance_cache.cpp and checks_irradiance_use.cpp say what the values should be.

#include "09_bias/irradiance_cases.h"
#include "bias.h"
#include "grader/worker/probe.h"

#include <array>
#include <vector>

using namespace lab09_tests;
using carlo::grader::Params;
using carlo::grader::Rows;
using carlo::grader::RowWriter;

namespace {

double real(float x) {
  return static_cast<double>(x);
}

lab09::Record record_of(const KnownRecord& known) {
  return {known.p, known.n, known.E, known.distance};
}

/// Returns what arrives, and calls `asked` with each direction.
lab09::LookAround looking(const Params& params, Vec3 n, const std::function<void(Vec3)>& asked) {
  const auto around = static_cast<Around>(params.whole("around"));
  const double scale = params["scale"];
  return [=](Vec3 wi) {
    asked(wi);
    const Arrived a = arrived(around, Double3(n), Double3(wi), scale);
    return lab09::Arrival{Rgb(a.radiance), a.distance};
  };
}

void add_optional(RowWriter& rows, const std::optional<Rgb>& E) {
  if (!E) return rows.add({0, 0, 0, 0});
  rows.add({1, real(E->r), real(E->g), real(E->b)});
}

}  // namespace

PROBE("Lab 9.7 record", "wi.x", "wi.y", "wi.z",
      "(last three rows: E; distance, directions asked for; where p and n are kept)") {
  const Vec3 n = record_normals().at(static_cast<std::size_t>(params.whole("normal")));
  const Vec3 p(3, -1, 2);
  carlo::Rng rng(params.seed);
  std::vector<Vec3> directions;
  const auto room = static_cast<std::size_t>(params.n * params.n);
  double calls = 0;
  const lab09::Record record = lab09::make_record(p, n, static_cast<int>(params.n),
                                                  looking(params, n,
                                                          [&](Vec3 wi) {
                                                            calls += 1;
                                                            if (directions.size() < room)
                                                              directions.push_back(wi);
                                                          }),
                                                  rng);
  directions.resize(room, Vec3(0));
  RowWriter rows;
  for (const Vec3 wi : directions)
    rows.add({real(wi.x), real(wi.y), real(wi.z)});
  rows.add({real(record.E.r), real(record.E.g), real(record.E.b)});
  rows.add({record.distance, calls, 0});
  rows.add({record.p == p ? 1.0 : 0.0, record.n == n ? 1.0 : 0.0, 0});
  return rows.take();
}

// Many records of one point: for each the means of its directions along the normal and two
// tangents.
PROBE("Lab 9.7 records", "along n", "along s", "along t", "1/distance", "directions") {
  const Vec3 n = record_normals().at(static_cast<std::size_t>(params.whole("normal")));
  const Tangents axes{Double3(n)};
  const int strata = static_cast<int>(params.whole("strata"));
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    Double3 sum(0);
    double calls = 0;
    const auto look = looking(params, n, [&](Vec3 wi) {
      const Double3 w(wi);
      sum += Double3(glm::dot(w, Double3(n)), glm::dot(w, axes.s), glm::dot(w, axes.t));
      calls += 1;
    });
    const lab09::Record record = lab09::make_record({0, 0, 0}, n, strata, look, rng);
    rows.add({sum.x / calls, sum.y / calls, sum.z / calls, 1 / record.distance, calls});
  }
  return rows.take();
}

PROBE("Lab 9.7 errors", "error") {
  RowWriter rows;
  for (const ErrorCase& c : error_cases())
    rows.add({lab09::record_error(record_of(c.record), c.p, c.n)});
  return rows.take();
}

PROBE("Lab 9.7 interpolated", "there is one", "red", "green", "blue") {
  const std::vector<Query> queries =
      params.n == 0 ? named_queries() : drawn_queries(params.seed, params.n);
  RowWriter rows;
  for (const Query& q : queries) {
    std::vector<lab09::Record> records;
    for (const KnownRecord& known : q.records)
      records.push_back(record_of(known));
    add_optional(rows, lab09::interpolate(records, q.p, q.n, q.most));
  }
  return rows.take();
}

PROBE("Lab 9.7 cache", "red", "green", "blue", "records made so far", "records kept") {
  lab09::Cache cache(cache_most, 0, endless);
  double made = 0;
  RowWriter rows;
  for (const Asker& asker : askers(params.seed, params.n)) {
    const Rgb E = lab09::cached_irradiance(cache, asker.p, asker.n, cache_most, [&] {
      made += 1;
      return record_of(made_at(asker.p, asker.n));
    });
    rows.add({real(E.r), real(E.g), real(E.b), made, static_cast<double>(cache.records().size())});
  }
  return rows.take();
}

// A ball of radius 1 whose wall emits 1 and reflects. A record's rays meet emission and irradiance
// from the cache of the next bounce; those of the last bounce meet only emission.
PROBE("Lab 9.7 furnace", "E") {
  carlo::Rng rng(params.seed);
  std::vector<lab09::Cache> caches(furnace_bounces, {cache_most, 0, endless});
  const std::function<Rgb(std::size_t, Vec3)> irradiance = [&](std::size_t bounce, Vec3 p) {
    const Vec3 n = -p;
    const lab09::LookAround look = [&](Vec3 wi) {
      const float along = -2 * glm::dot(p, wi);
      const Vec3 q = glm::normalize(p + along * wi);
      Rgb radiance(1);
      if (bounce + 1 < caches.size()) {
        const double reflects = furnace_albedo / 3.14159265358979;
        radiance += static_cast<float>(reflects) * irradiance(bounce + 1, q);
      }
      return lab09::Arrival{radiance, std::max(real(along), 1e-6)};
    };
    return lab09::cached_irradiance(caches[bounce], p, n, cache_most,
                                    [&] { return lab09::make_record(p, n, 4, look, rng); });
  };
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const float z = 2 * rng.uniform_float() - 1;
    const float turn = 6.2831853f * rng.uniform_float();
    const float r = std::sqrt(1 - z * z);
    rows.add({real(irradiance(0, {r * std::cos(turn), r * std::sin(turn), z}).r)});
  }
  return rows.take();
}
