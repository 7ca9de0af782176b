#include "bias.h"
#include "hemisphere.h"
#include "numeric/robust.h"

#include <algorithm>
#include <cmath>

// Lab 09, step g: an irradiance cache. Solved.

namespace lab09 {
namespace {

/// A uniform number in stratum number `stratum`.
float within(int stratum, int strata, Rng& rng) {
  const auto first = static_cast<float>(stratum);
  const float u = (first + rng.uniform_float()) / static_cast<float>(strata);
  return std::min(u, 0x1.fffffep-1f);  // the sum may be rounded up to the stratum's end
}

/// True if the record lies in front of the point, so that it may see what the point does not.
bool lies_in_front(const Record& record, Vec3 p, Vec3 n) {
  const Vec3 up = (n + record.n) / 2.0f;
  return static_cast<double>(glm::dot(record.p - p, up)) > record.distance / 100;
}

}  // namespace

// Lab 9.7 -----------------------------------------------------------------------------------------

Record make_record(Vec3 p, Vec3 n, int strata, const LookAround& look, Rng& rng) {
  const lab07::Frame frame(n);
  glm::dvec3 radiance(0);
  double inverse_distances = 0;
  for (int row = 0; row < strata; ++row) {
    for (int column = 0; column < strata; ++column) {
      const float u = within(column, strata, rng);
      const float v = within(row, strata, rng);
      const Arrival arrival = look(frame.to_world(lab07::sample_cosine_hemisphere({u, v})));
      radiance += arrival.radiance;
      inverse_distances += 1 / arrival.distance;
    }
  }
  const double count = static_cast<double>(strata) * strata;
  // The cosine of the rendering equation and that in the density cancel.
  return {p, n, carlo::pi / count * radiance, count / inverse_distances};
}

double record_error(const Record& record, Vec3 p, Vec3 n) {
  const auto away = static_cast<double>(glm::length(p - record.p));
  // 1 - n . n' = |n - n'|^2 / 2, and the difference has all its digits.
  const auto turned = static_cast<double>(glm::length(n - record.n));
  return away / record.distance + turned / std::sqrt(2.0);
}

std::optional<Rgb> interpolate(std::span<const Record> records, Vec3 p, Vec3 n, double most) {
  glm::dvec3 sum(0);
  double weights = 0;
  for (const Record& record : records) {
    const double error = record_error(record, p, n);
    if (!(error < most) || lies_in_front(record, p, n)) continue;
    if (error == 0) return record.E;
    sum += glm::dvec3(record.E) / error;
    weights += 1 / error;
  }
  if (weights == 0) return std::nullopt;
  return Rgb(sum / weights);
}

Rgb cached_irradiance(Cache& cache, Vec3 p, Vec3 n, double most,
                      const std::function<Record()>& make) {
  if (const auto known = interpolate(cache.near(p), p, n, most)) return *known;
  const Record record = make();
  cache.add(record);
  return record.E;
}

}  // namespace lab09
