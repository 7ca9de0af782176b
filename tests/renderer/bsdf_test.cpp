#include "renderer/bsdf.h"

#include "closed_forms.h"
#include "random/rng.h"
#include "renderer/warp.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace renderer;
using carlo::Rng;

constexpr float last_float = 0x1.fffffep-1f;
const Vec3 up(0, 0, 1);

Vec3 at_angle(double theta) {
  return {static_cast<float>(std::sin(theta)), 0, static_cast<float>(std::cos(theta))};
}

Vec2 draw_2d(Rng& rng) {
  const float x = rng.uniform_float();
  const float y = rng.uniform_float();
  return {x, y};
}

struct Mean {
  double sum = 0, sum2 = 0;
  int n = 0;
  void add(double x) {
    sum += x;
    sum2 += x * x;
    ++n;
  }
  double value() const { return sum / n; }
  double error() const { return std::sqrt((sum2 / n - value() * value()) / n); }
};

TEST_CASE("Frames are orthonormal and right-handed for every normal") {
  // Hard case 17: near n.z = -1 Frisvad's frame has an edge of length 1.27.
  Rng rng(1);
  std::vector<Vec3> normals = {up, -up, {1, 0, 0}, {0, 1, 0}, {0, 0, -0.0f}};
  normals.back() = Vec3(0, 1, -0.0f);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 near_pole(1e-4f * (rng.uniform_float() - 0.5f), 1e-4f * (rng.uniform_float() - 0.5f),
                         -1);
    const float z = 2 * rng.uniform_float() - 1;
    normals.push_back(i % 2 == 0 ? glm::normalize(near_pole)
                                 : spherical(z, std::sqrt(1 - z * z), rng.uniform_float()));
  }
  float worst = 0;
  for (const Vec3 n : normals) {
    const Frame f(n);
    for (const float e :
         {glm::length(f.s) - 1, glm::length(f.t) - 1, glm::dot(f.s, f.t), glm::dot(f.s, n),
          glm::dot(f.t, n), glm::length(glm::cross(f.s, f.t) - n)}) {
      worst = std::max(worst, std::abs(e));
    }
  }
  CHECK(worst <= 1e-6f);
}

TEST_CASE("The albedo of the lobe agrees with the closed form for every exponent and angle") {
  // The mean weight of sample(): one sample has sd below 1, n = 2e5: 4.5 standard errors detect
  // an error of 1 % with power > .999. 24 tests at |z| < 5.3: family-wise alpha = 3e-6.
  Rng rng(2);
  for (const int n : {0, 1, 2, 50, 1000, 1000000}) {
    const ModifiedPhong bsdf(Rgb(0), Rgb(1), static_cast<float>(n));
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
      const double theta = degrees * closed_forms::pi / 180;
      Mean mean;
      int below = 0;
      constexpr int count = 200000;
      for (int i = 0; i < count; ++i) {
        const float u_lobe = rng.uniform_float();
        const auto s = bsdf.sample(up, at_angle(theta), u_lobe, draw_2d(rng));
        mean.add(s ? static_cast<double>(s->weight.r) : 0);
        below += s ? 0 : 1;
      }
      const double exact = closed_forms::phong_albedo(n, theta);
      INFO("n = " << n << ", " << degrees << " degrees: " << mean.value() << " for " << exact);
      CHECK(std::abs(mean.value() - exact) <= 5.3 * mean.error() + 2e-6);
      const double p = std::max(0.0, closed_forms::phong_below(n, theta));
      CHECK(std::abs(below - count * p) <= 5.3 * std::sqrt(count * p * (1 - p)) + 1);
    }
  }
}

TEST_CASE("The closed form has the values tabulated from quad-precision quadrature") {
  const double degree = closed_forms::pi / 180;
  CHECK(std::abs(closed_forms::phong_albedo(0, 30 * degree) - .9330127019) <= 1e-10);
  CHECK(std::abs(closed_forms::phong_albedo(1, 80 * degree) - .4099452536) <= 1e-10);
  CHECK(std::abs(closed_forms::phong_albedo(2, 60 * degree) - .5625) <= 1e-10);
  CHECK(std::abs(closed_forms::phong_albedo(50, 89 * degree) - .0652907382) <= 1e-10);
  CHECK(std::abs(closed_forms::phong_albedo(1000, 89 * degree) - .0232122927) <= 1e-10);
  CHECK(std::abs(closed_forms::phong_below(1, 60 * degree) - .25) <= 1e-10);
  CHECK(std::abs(closed_forms::phong_below(10, 80 * degree) - .285238) <= 1e-6);
  CHECK(std::abs(closed_forms::phong_below(1000, 89 * degree) - .290449) <= 1e-6);
}

TEST_CASE("Directions follow the pdf: chi-square over cells of the hemisphere") {
  // Cells in (cos theta, phi); expected masses by quadrature of evaluate().pdf; directions below
  // the horizon are a cell of their own. 1e6 samples, cells pooled to >= 100. Normal approximation
  // of chi-square: z < 6.
  const ModifiedPhong bsdf(Rgb(0.3f), Rgb(0.5f), 20);
  const Vec3 wo = at_angle(70 * closed_forms::pi / 180);
  constexpr int rows = 40, columns = 80, fine = 24, samples = 1000000;
  std::vector<double> expected(rows * columns + 1), seen(rows * columns + 1);
  double mass = 0;
  for (int r = 0; r < rows * fine; ++r) {
    for (int c = 0; c < columns * fine; ++c) {
      const double z = (r + 0.5) / (rows * fine), phi = (c + 0.5) / (columns * fine);
      const Vec3 wi = spherical(static_cast<float>(z), static_cast<float>(std::sqrt(1 - z * z)),
                                static_cast<float>(phi));
      const double p = static_cast<double>(bsdf.evaluate(up, wo, wi).pdf) * 2 * closed_forms::pi /
                       (rows * fine * columns * fine);
      expected[static_cast<std::size_t>(r / fine * columns + c / fine)] += p * samples;
      mass += p;
    }
  }
  expected.back() = (1 - mass) * samples;
  const double below = 0.5 / 0.8 * closed_forms::phong_below(20, 70 * closed_forms::pi / 180);
  CHECK(std::abs(1 - mass - below) <= 1e-4);
  Rng rng(3);
  for (int i = 0; i < samples; ++i) {
    const float u_lobe = rng.uniform_float();
    const auto s = bsdf.sample(up, wo, u_lobe, draw_2d(rng));
    std::size_t cell = seen.size() - 1;
    if (s) {
      const double phi = std::atan2(s->wi.y, s->wi.x) / (2 * closed_forms::pi);
      const int c = std::min(columns - 1, static_cast<int>((phi < 0 ? phi + 1 : phi) * columns));
      const int r = std::min(rows - 1, static_cast<int>(s->wi.z * rows));
      cell = static_cast<std::size_t>(r * columns + c);
    }
    ++seen[cell];
  }
  double chi2 = 0, pooled_expected = 0, pooled_seen = 0;
  int cells = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    pooled_expected += expected[i];
    pooled_seen += seen[i];
    if (pooled_expected < 100) continue;
    chi2 += (pooled_seen - pooled_expected) * (pooled_seen - pooled_expected) / pooled_expected;
    ++cells;
    pooled_expected = pooled_seen = 0;
  }
  const double dof = cells - 1;
  INFO("chi2 = " << chi2 << " with " << dof << " degrees of freedom");
  CHECK(std::abs(chi2 - dof) <= 6 * std::sqrt(2 * dof));
}

TEST_CASE("sample() and evaluate() agree: weight = f cos / pdf, and f is reciprocal") {
  Rng rng(4);
  const ModifiedPhong bsdf(Rgb(0.2f, 0.3f, 0.1f), Rgb(0.4f, 0.1f, 0.6f), 33.5f);
  for (int i = 0; i < 20000; ++i) {
    const float z = std::max(1e-3f, rng.uniform_float());
    const Vec3 wo = spherical(z, std::sqrt(1 - z * z), rng.uniform_float());
    const float u_lobe = rng.uniform_float();
    const auto s = bsdf.sample(up, wo, u_lobe, draw_2d(rng));
    if (!s) continue;
    const auto v = bsdf.evaluate(up, wo, s->wi);
    CHECK(std::abs(v.pdf / s->pdf - 1) <= 1e-4f);
    CHECK(glm::length(v.f * s->wi.z / v.pdf - s->weight) <= 1e-4f);
    const auto reversed = bsdf.evaluate(up, s->wi, wo);
    CHECK(glm::length(reversed.f - v.f) <= 2e-4f * glm::length(v.f));
  }
}

TEST_CASE("The ends of the unit interval and grazing angles give finite weights") {
  // Hard cases 2, 20, 21 and 22.
  for (const float n : {0.0f, 0.5f, 1.0f, 2.0f, 1e3f, 1e6f, 1e7f}) {
    const ModifiedPhong bsdf(Rgb(0.3f), Rgb(0.6f), n);
    for (const double degrees : {0.0, 80.0, 89.9, 89.9999}) {
      for (const float a : {0.0f, 0.5f, last_float}) {
        for (const float b : {0.0f, 0.37f, last_float}) {
          for (const float lobe : {0.0f, last_float}) {
            const Vec3 wo = at_angle(degrees * closed_forms::pi / 180);
            const auto s = bsdf.sample(up, wo, lobe, {a, b});
            if (!s) continue;
            CHECK(std::isfinite(s->pdf));
            CHECK(s->pdf > 0);
            CHECK(s->wi.z > 0);
            CHECK((s->weight.r >= 0 && s->weight.r <= 2.1f));
          }
        }
      }
    }
  }
  const ModifiedPhong lambert(Rgb(0.3f), Rgb(0), 0);
  CHECK_FALSE(lambert.sample(up, up, 0, {1.0f, 0}).has_value());
}

TEST_CASE("The lobe has the right mean angle for exponents up to 1e8") {
  // Hard case 19: through acos of a float power, 1e7 gives -8.6 %, 1e8 -86 %. For large n,
  // E[alpha^2] = 2 / (n + 1) to relative 1/n. n = 1e5 samples: sd of the mean of alpha^2 is .0032.
  Rng rng(5);
  for (const float n : {1e5f, 1e6f, 1e7f, 1e8f}) {
    Mean mean;
    for (int i = 0; i < 100000; ++i) {
      const Vec3 w = sample_lobe(draw_2d(rng), n);
      mean.add(static_cast<double>(w.x) * w.x + static_cast<double>(w.y) * w.y);
    }
    CHECK(std::abs(mean.value() * (static_cast<double>(n) + 1) / 2 - 1) <= 5 * 0.0032);
  }
}

TEST_CASE("cos_power is 1 for equal directions and right near them, for exponents up to 1e7") {
  // Hard case 20: pow(dot(d, r), n) with d = r reads 10.9 at n = 1e7.
  Rng rng(6);
  for (int i = 0; i < 1000; ++i) {
    const float z = 2 * rng.uniform_float() - 1;
    const Vec3 d = spherical(z, std::sqrt(1 - z * z), rng.uniform_float());
    CHECK(cos_power(d, d, 1e7f) == 1);
    CHECK(cos_power(d, -d, 2) == 0);  // hard case 21: the back of an even lobe
  }
  for (const double alpha : {1e-4, 3e-4, 1e-3}) {
    const double exact = std::exp(1e6 * std::log(std::cos(alpha)));
    CHECK(std::abs(static_cast<double>(cos_power(at_angle(alpha), up, 1e6f)) / exact - 1) <= 2e-3);
  }
}

TEST_CASE("Glass obeys Snell and Fresnel") {
  const float eta = 1 / 1.5f;
  const Refraction normal = refract(up, up, eta);
  CHECK(std::abs(normal.reflectance - 0.04f) <= 1e-6f);
  REQUIRE(normal.wt);
  CHECK(glm::length(*normal.wt + up) <= 1e-6f);
  // Brewster's angle: only perpendicular light is reflected; r_s^2 / 2 = ((1 - n^2)/(1 + n^2))^2
  // / 2.
  const float brewster = refract(up, at_angle(std::atan(1.5)), eta).reflectance;
  CHECK(std::abs(brewster - 0.5f * std::pow(1.25f / 3.25f, 2.0f)) <= 1e-6f);
  for (const double degrees : {10.0, 45.0, 80.0, 89.0}) {
    const Vec3 wo = at_angle(degrees * closed_forms::pi / 180);
    const Refraction in = refract(up, wo, eta);
    REQUIRE(in.wt);
    CHECK(std::abs(-in.wt->x * 1.5f - wo.x) <= 1e-5f);  // Snell
    // The way out has the same reflectance.
    const Refraction out = refract(-up, *in.wt, 1.5f);
    CHECK(std::abs(out.reflectance - in.reflectance) <= 2e-4f);
  }
  CHECK_FALSE(refract(up, at_angle(0.8), 1.5f).wt.has_value());  // beyond 41.8 degrees
  CHECK(refract(up, at_angle(0.8), 1.5f).reflectance == 1);
}

}  // namespace
