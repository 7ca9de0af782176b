#include "bias.h"
#include "course/not_implemented.h"
#include "hemisphere.h"
#include "numeric/robust.h"

#include <cmath>

// Lab 09, step g: an irradiance cache. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.7 -----------------------------------------------------------------------------------------

Record make_record(Vec3 p, Vec3 n, int strata, const LookAround& look, Rng& rng) {
  // 1. A direction for each stratum of [0, 1)^2: Lab 7.4 makes it of a point there, in the frame
  //    of n (Lab 7.1). Draw u.x and u.y in two statements. In floats i + u may round up to i + 1.
  // 2. E: the mean of what arrives, over a density that has the cosine in it already.
  // 3. The harmonic mean: one over the mean of one over the distances, all of them.
  carlo::not_implemented("Lab 9.7", "Summary");
}

double record_error(const Record& record, Vec3 p, Vec3 n) {
  // 1. How far away, measured by the record's distance.
  // 2. How far turned: 1 - n . n' is a difference of nearly equal numbers. Lab 8.3 has the way out.
  carlo::not_implemented("Lab 9.7", "Summary");
}

std::optional<Rgb> interpolate(std::span<const Record> records, Vec3 p, Vec3 n, double most) {
  // 1. Which records may serve? Their error here is below `most`, and they do not lie in front.
  // 2. The mean, each weighed by one over its error; what is the weight of an error of 0?
  carlo::not_implemented("Lab 9.7", "Summary");
}

Rgb cached_irradiance(Cache& cache, Vec3 p, Vec3 n, double most,
                      const std::function<Record()>& make) {
  // 1. Ask what is there: cache.near(p).
  // 2. Only where that says nothing: make a record, keep it, return its irradiance.
  carlo::not_implemented("Lab 9.7", "Summary");
}

}  // namespace lab09
