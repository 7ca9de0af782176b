// The vector kernel's arithmetic on all instruction sets of this machine: fused operations are
// rounded once, like the standard library's fma; and elementary functions are as accurate as
// claimed, compared with the standard library's double versions.

#include "lane_records.h"
#include "random/rng.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lane_math_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// These follow the two headers above, which compile them anew.
#include "renderer/lanes/elementary-inl.h"
#include "renderer/lanes/sdf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

template <class Tag, class T>
HWY_ATTR void fuse(Tag tag, lane_math::Fused<T>& f) {
  for (std::size_t i = 0; i < f.a.size(); i += hn::MaxLanes(tag)) {
    const auto a = hn::LoadU(tag, &f.a[i]), b = hn::LoadU(tag, &f.b[i]),
               c = hn::LoadU(tag, &f.c[i]);
    hn::StoreU(mul_add(a, b, c), tag, &f.add[i]);
    hn::StoreU(mul_sub(a, b, c), tag, &f.sub[i]);
    hn::StoreU(neg_mul_add(a, b, c), tag, &f.neg_add[i]);
    hn::StoreU(neg_mul_sub(a, b, c), tag, &f.neg_sub[i]);
  }
}
HWY_ATTR void fuse_floats(lane_math::Fused<float>& f) {
  fuse(d_, f);
}
HWY_ATTR void fuse_doubles(lane_math::Fused<double>& f) {
  fuse(dd_, f);
}

HWY_ATTR void elementary(lane_math::Elementary& e) {
  for (std::size_t i = 0; i < e.x.size(); i += lanes) {
    const V x = hn::LoadU(d_, &e.x[i]), log = log_one_minus(x);
    const Exponential of_log = exponential(log);
    hn::StoreU(log, d_, &e.log[i]);
    hn::StoreU(exp_of(hn::Mul(set(-90), x)), d_, &e.exp[i]);
    hn::StoreU(neg_mul_add(of_log.scale, of_log.more, hn::Sub(set(1), of_log.scale)), d_,
               &e.minus_expm1[i]);
    hn::StoreU(turns_of_tangent(x), d_, &e.turns[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {
HWY_EXPORT(fuse_floats);
HWY_EXPORT(fuse_doubles);
HWY_EXPORT(elementary);

namespace {

using lane_math::Fused;

constexpr std::size_t count = 1 << 14;

/// Numbers of both signs, with few digits or all of them, and of sizes for which sums cancel or
/// terms vanish beside others.
template <class T>
T number(carlo::Rng& rng) {
  const auto few = static_cast<int>(rng.next_u32() % 6);
  double x = 1 + rng.uniform();
  if (few < 4) x = std::round(x * (1 << 2 * few)) / (1 << 2 * few);
  const int exponent = static_cast<int>(rng.next_u32() % 60) - 30;
  return static_cast<T>(std::ldexp(rng.next_u32() % 2 == 0 ? x : -x, exponent));
}

template <class T>
Fused<T> hard_cases() {
  carlo::Rng rng(7);
  Fused<T> f;
  for (std::size_t i = 0; i < count; ++i) {
    T a = number<T>(rng), b = number<T>(rng), c = number<T>(rng);
    constexpr T ulp = std::numeric_limits<T>::epsilon();
    switch (i % 4) {
      case 0:  // almost cancels
        c = -a * b * (1 + static_cast<T>(rng.next_u32() % 5) * ulp);
        break;
      case 1:  // halfway between two numbers, or next to it
        c = a * b;
        a = c * ulp / 2, b = 1 + static_cast<T>(rng.next_u32() % 3) * ulp;
        break;
      case 2:  // below half of the last digit
        c = a * b / (ulp * ulp);
        break;
      default:
        // Tests signs of zeros.
        if (i % 16 == 3) a *= 0;
        if (i % 32 == 3) c *= 0;
        break;
    }
    f.a.push_back(a), f.b.push_back(b), f.c.push_back(c);
  }
  for (auto* result : {&f.add, &f.sub, &f.neg_add, &f.neg_sub})
    result->resize(count);
  return f;
}

template <class T>
bool same(T a, T b) {
  return a == b && std::signbit(a) == std::signbit(b);
}

template <class T>
void check_fused(Fused<T> f, void (*fuse)(Fused<T>&)) {
  fuse(f);
  int wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const T a = f.a[i], b = f.b[i], c = f.c[i];
    const bool right = same(f.add[i], std::fma(a, b, c)) && same(f.sub[i], std::fma(a, b, -c)) &&
                       same(f.neg_add[i], std::fma(-a, b, c)) &&
                       same(f.neg_sub[i], std::fma(-a, b, -c));
    if (!right && wrong++ == 0) {
      INFO(std::hexfloat << a << " " << b << " " << c);
      CHECK(f.add[i] == std::fma(a, b, c));
      CHECK(f.sub[i] == std::fma(a, b, -c));
    }
  }
  CHECK(wrong == 0);
}

/// In units of the last place of the right value.
double error(float value, double right) {
  const double ulp = std::ldexp(1.0, std::ilogb(right) - 23);
  return right == 0 ? std::abs(static_cast<double>(value))
                    : std::abs(static_cast<double>(value) - right) / ulp;
}

}  // namespace

TEST_CASE("The vector kernel rounds products and sums once on all instruction sets") {
  const Fused<float> floats = hard_cases<float>();
  const Fused<double> doubles = hard_cases<double>();
  instruction_sets::on_all([&] {
    check_fused<float>(floats, [](Fused<float>& f) { HWY_DYNAMIC_DISPATCH(fuse_floats)(f); });
    check_fused<double>(doubles, [](Fused<double>& f) { HWY_DYNAMIC_DISPATCH(fuse_doubles)(f); });
  });
}

TEST_CASE("The vector kernel's elementary functions are as exact as they say") {
  carlo::Rng rng(8);
  lane_math::Elementary e;
  for (std::size_t i = 0; i < count; ++i) {
    // Evenly, and close to 0 and 1.
    const float u = rng.uniform_float();
    const float near = std::ldexp(u, -static_cast<int>(rng.next_u32() % 24));
    e.x.push_back(i % 3 == 0 ? u : i % 3 == 1 ? near : std::min(1 - near, 1 - 0x1p-24f));
  }
  e.x[0] = 0, e.x[1] = 1 - 0x1p-24f, e.x[2] = 0x1p-24f, e.x[3] = 0x1p-100f;
  for (auto* result : {&e.log, &e.exp, &e.minus_expm1, &e.turns})
    result->resize(count);
  std::vector<float> first;
  instruction_sets::on_all([&] {
    HWY_DYNAMIC_DISPATCH(elementary)(e);
    double log = 0, exp = 0, expm1 = 0, turns = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = static_cast<double>(e.x[i]);
      log = std::max(log, error(e.log[i], std::log1p(-x)));
      const auto power = static_cast<double>(-90 * e.x[i]);
      if (power >= -86)
        exp = std::max(exp, error(e.exp[i], std::exp(power)));
      else
        CHECK(e.exp[i] == 0);
      expm1 = std::max(expm1, error(e.minus_expm1[i], -std::expm1(static_cast<double>(e.log[i]))));
      turns = std::max(turns, error(e.turns[i], std::atan(x) / 6.283185307179586));
    }
    CHECK(log <= 2);
    CHECK(exp <= 2);
    CHECK(expm1 <= 2);
    CHECK(turns <= 4);
    std::vector<float> all = e.log;
    for (const auto* more : {&e.exp, &e.minus_expm1, &e.turns})
      all.insert(all.end(), more->begin(), more->end());
    if (first.empty()) first = all;
    CHECK(all == first);
  });
}

}  // namespace renderer
#endif
