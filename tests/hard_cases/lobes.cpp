#include "hard_case.h"
#include "numeric/robust.h"
#include "random/rng.h"
#include "renderer/bsdf.h"
#include "renderer/warp.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hard_cases {
namespace {

using carlo::pi;
using carlo::Rgb;
using carlo::Vec2;
using carlo::Vec3;
using renderer::ModifiedPhong;

Vec3 at_degrees(double degrees) {
  const double angle = degrees * pi / 180;
  return {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
}

const Vec3 normal(0, 0, 1);

HardCase zero_cosine() {
  const float cosine = std::sqrt(0.0f);  // the draw u = 0 of cos = sqrt(u)
  const float naive = 0.5f / carlo::pi_f * cosine / (cosine / carlo::pi_f);
  const ModifiedPhong grey(Rgb(0.5f), Rgb(0), 0);
  int bad = 0;
  for (const float u : {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f}) {
    for (const float v : {0.0f, 0.25f, 1 - 0x1p-24f}) {
      const auto next = grey.sample(normal, at_degrees(30), 0.1f, {u, v});
      if (next && !(std::isfinite(next->weight.r) && next->pdf > 0)) ++bad;
    }
  }
  return {2,
          "cosine-weighted draws at the horizon",
          fmt::format("{:g}", naive),
          fmt::format("{} not finite", bad),
          "0",
          bad == 0};
}

HardCase lobe_angle() {
  carlo::Rng rng(19);
  constexpr float n = 1e7f;
  double naive = 0, ours = 0;
  std::set<float> naive_angles, angles;
  constexpr int count = 200'000;
  for (int i = 0; i < count; ++i) {
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    const float alpha = std::acos(std::pow(u, 1 / (n + 1)));
    naive += static_cast<double>(alpha) / count;
    naive_angles.insert(alpha);
    const Vec3 w = renderer::sample_lobe({u, v}, n);
    const float sine = std::hypot(w.x, w.y);
    ours += static_cast<double>(sine) / count;
    angles.insert(sine);
  }
  // E[alpha] of a narrow lobe: sqrt(pi / (2 n)).
  const double exact = std::sqrt(pi / (2 * (static_cast<double>(n) + 1)));
  return {19,
          "mean angle of the lobe, n = 1e7",
          fmt::format("{:+.1f} %, {} angles", 100 * (naive / exact - 1), naive_angles.size()),
          fmt::format("{:+.2f} %, {} angles", 100 * (ours / exact - 1), angles.size()),
          "within 1 %",
          std::abs(ours / exact - 1) <= 0.01 && angles.size() > 10'000};
}

HardCase peak_value() {
  double naive = 0, ours = 0;
  const ModifiedPhong phong(Rgb(0), Rgb(1), 1e7f);
  carlo::Rng rng(20);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 wo =
        glm::normalize(Vec3(rng.uniform_float() - 0.5f, rng.uniform_float() - 0.5f, 0.7f));
    const Vec3 mirror = renderer::reflect(normal, wo);
    naive = std::max(naive, static_cast<double>(std::pow(glm::dot(mirror, mirror), 1e7f)));
    const double peak =
        static_cast<double>(phong.evaluate(normal, wo, mirror).f.r) * 2 * pi / (1e7 + 2);
    ours = std::max(ours, std::abs(peak - 1));
  }
  return {20,
          "cos^n at the mirror direction, n = 1e7",
          fmt::format("up to {:.1f}", naive),
          fmt::format("1 within {:.1e}", ours),
          "1 within 1e-5",
          ours <= 1e-5};
}

/// Mean weight of ks = 1 by sampling.
double albedo(float n, double degrees, double& error) {
  const ModifiedPhong phong(Rgb(0), Rgb(1), n);
  carlo::Rng rng(21);
  constexpr int count = 400'000;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    const auto next = phong.sample(normal, at_degrees(degrees), 0.5f, {u, v});
    const double w = next ? static_cast<double>(next->weight.r) : 0;
    sum += w;
    squares += w * w;
  }
  error = std::sqrt((squares / count - sum / count * (sum / count)) / count);
  return sum / count;
}

HardCase back_of_lobe() {
  // Midpoint rule over the hemisphere with |cos|^n, which does not stop at 90 degrees.
  const Vec3 mirror = renderer::reflect(normal, at_degrees(80));
  double naive = 0;
  constexpr int steps = 600;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double z = (i + 0.5) / steps, phi = 2 * pi * (j + 0.5) / steps,
                   r = std::sqrt(1 - z * z);
      const double c =
          r * std::cos(phi) * static_cast<double>(mirror.x) + z * static_cast<double>(mirror.z);
      naive += 4 / (2 * pi) * c * c * z * 2 * pi / steps / steps;
    }
  }
  double error = 0;
  const double ours = albedo(2, 80, error);
  return {21,
          "albedo at 80 degrees, n = 2",
          fmt::format("{:.3f} (both halves)", naive),
          fmt::format("{:.4f}", ours),
          ".3444 +- 4 se",
          std::abs(ours - 0.3443625112) <= 4 * error};
}

HardCase below_horizon() {
  double error = 0;
  const double ours = albedo(1, 80, error);
  carlo::Rng rng(22);
  double naive = 0;
  const Vec3 mirror = renderer::reflect(normal, at_degrees(80));
  const Vec3 across(mirror.z, 0, -mirror.x), third(0, 1, 0);
  constexpr int count = 400'000;
  for (int i = 0; i < count; ++i) {
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    const Vec3 w = renderer::sample_lobe({u, v}, 1);
    naive +=
        1.5 * static_cast<double>(std::abs((w.x * across + w.y * third + w.z * mirror).z)) / count;
  }
  return {22,
          "albedo at 80 degrees, n = 1",
          fmt::format("{:.3f} (|cos|)", naive),
          fmt::format("{:.4f}", ours),
          ".4099 +- 4 se",
          std::abs(ours - 0.4099452536) <= 4 * error};
}

HardCase reused_number() {
  // Half diffuse, half mirror-like; light from a cap of 20 degrees that the diffuse half alone
  // sees.
  const ModifiedPhong phong(Rgb(0.5f), Rgb(0.5f), 1e4f);
  const Vec3 wo = at_degrees(45);
  const float cap = std::cos(20 * carlo::pi_f / 180);
  carlo::Rng rng(27);
  double naive = 0, ours = 0;
  constexpr int count = 400'000;
  for (int i = 0; i < count; ++i) {
    const float u_lobe = rng.uniform_float();
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    const auto light = [&](Vec2 place) {
      const auto next = phong.sample(normal, wo, u_lobe, place);
      return next && next->wi.z > cap ? static_cast<double>(next->weight.r) / count : 0.0;
    };
    ours += light({u, v});
    naive += light({1 - u_lobe, v});
  }
  const double exact = 0.5 * std::pow(std::sin(20 * pi / 180), 2);
  return {27,
          "one number for lobe and direction",
          fmt::format("{:.3f}", naive),
          fmt::format("{:.4f}", ours),
          fmt::format("{:.4f} within 3 %", exact),
          std::abs(ours / exact - 1) <= 0.03};
}

}  // namespace

std::vector<HardCase> lobe_cases() {
  return {zero_cosine(),  lobe_angle(),    peak_value(),
          back_of_lobe(), below_horizon(), reused_number()};
}

}  // namespace hard_cases
