// The vector kernel's sample points are those of sampling/sobol.h, bit for bit, on all instruction
// sets of this machine.

#include "random/hash.h"
#include "random/to_float.h"
#include "renderer/flat/flat_kernel.h"
#include "sampling/sobol.h"

#include <catch2/catch_test_macros.hpp>

#include <cstdint>
#include <string>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sobol_lanes_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the two above, which compile it anew.
#include "renderer/flat/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// A function of each word, or pair of words, of arrays whose size all numbers of lanes divide.
HWY_ATTR void second_coordinates(const std::vector<std::uint32_t>& words,
                                 std::vector<std::uint32_t>& result) {
  for (std::size_t i = 0; i < words.size(); i += lanes)
    hn::StoreU(second_coordinate(hn::LoadU(du_, &words[i])), du_, &result[i]);
}

HWY_ATTR void sobol_points(const std::vector<std::uint32_t>& indices,
                           const std::vector<std::uint32_t>& keys, std::vector<float>& x,
                           std::vector<float>& y) {
  for (std::size_t i = 0; i < indices.size(); i += lanes) {
    const U reversed = reverse_bits(hn::LoadU(du_, &indices[i]));
    const V2 p = sobol_2d(reversed, hn::LoadU(du_, &keys[i]));
    hn::StoreU(p.x, d_, &x[i]);
    hn::StoreU(p.y, d_, &y[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {
HWY_EXPORT(second_coordinates);
HWY_EXPORT(sobol_points);
}  // namespace renderer

namespace {

/// "lowbias32", the scalar twin of the kernel's mix().
std::uint32_t low_bias(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7FEB352D;
  x = (x ^ x >> 15) * 0x846CA68B;
  return x ^ x >> 16;
}

/// Numbers without pattern.
std::vector<std::uint32_t> words(std::uint64_t seed, std::size_t count) {
  std::vector<std::uint32_t> result;
  for (std::uint64_t i = 0; i < count; ++i)
    result.push_back(static_cast<std::uint32_t>(carlo::hash(seed, i)));
  return result;
}

template <class Check>
void on_all_instruction_sets(const Check& check) {
  for (const std::string& name : renderer::flat_instruction_sets()) {
    renderer::use_instruction_set(name);
    INFO(name);
    check();
  }
  renderer::use_instruction_set("");
}

}  // namespace

// Both sides are linear over the bits, so equality on the words of one bit is equality on all.
TEST_CASE("The second Sobol' coordinate in lanes is sobol_second()") {
  std::vector<std::uint32_t> x = words(1, 1024);
  for (std::size_t bit = 0; bit < 32; ++bit)
    x[bit] = std::uint32_t{1} << bit;
  x[32] = 0;
  on_all_instruction_sets([&] {
    std::vector<std::uint32_t> y(x.size());
    HWY_DYNAMIC_DISPATCH(renderer::second_coordinates)(x, y);
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK(y[i] == carlo::sobol_second(carlo::reverse_bits(x[i])));
  });
}

TEST_CASE("Sobol' points in lanes are shuffled and shifted as in sampling/sobol.h") {
  const std::vector<std::uint32_t> keys = words(2, 1024);
  std::vector<std::uint32_t> indices = words(3, 1024);
  for (std::uint32_t i = 0; i < 512; ++i)
    indices[i] = i;
  on_all_instruction_sets([&] {
    std::vector<float> x(keys.size()), y(keys.size());
    HWY_DYNAMIC_DISPATCH(renderer::sobol_points)(indices, keys, x, y);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::uint32_t k = low_bias(keys[i]);
      const std::uint32_t first = carlo::nested_hash(carlo::reverse_bits(indices[i]), k);
      const std::uint32_t second = carlo::sobol_second(carlo::reverse_bits(first));
      CHECK(x[i] == carlo::to_float(first));
      CHECK(y[i] == carlo::to_float(second ^ k * 0xB5297A4D));
    }
  });
}
#endif
