#include "fast_fill.h"

#include "generators.h"
#include "random/hash.h"
#include "random/philox.h"
#include "support/error.h"

#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// Each fill is written twice: in plain C++ for any machine, and with AVX2 instructions.
#if defined(__x86_64__)
#define LAB03_AVX2 __attribute__((target("avx2")))
#endif

namespace lab03 {
namespace {

bool avx2_forbidden = false;

void check_size(std::size_t size) {
  if (size % 32 != 0) throw carlo::Error("fast fills take a multiple of 32 words");
}

void leapfrog_any(std::uint32_t* lanes, std::uint32_t factor, std::uint32_t summand,
                  std::uint32_t* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += 32) {
    for (std::size_t lane = 0; lane < 32; ++lane) {
      out[i + lane] = lanes[lane];
      lanes[lane] = lanes[lane] * factor + summand;
    }
  }
}

using XoshiroLanes = std::array<std::array<std::uint32_t, 8>, 4>;

void xoshiro_any(XoshiroLanes& lanes, std::uint32_t* out, std::size_t n) {
  for (std::size_t lane = 0; lane < 8; ++lane) {
    Xoshiro128 one({lanes[0][lane], lanes[1][lane], lanes[2][lane], lanes[3][lane]});
    for (std::size_t i = lane; i < n; i += 8)
      out[i] = one.next();
    for (std::size_t word = 0; word < 4; ++word)
      lanes[word][lane] = one.state()[word];
  }
}

void philox_any(std::array<std::uint32_t, 2> key, std::uint64_t position, std::uint32_t* out,
                std::size_t n) {
  for (std::size_t i = 0; i < n; i += 4, ++position) {
    const auto block = carlo::philox4x32(
        {static_cast<std::uint32_t>(position), static_cast<std::uint32_t>(position >> 32), 0, 0},
        key);
    std::memcpy(out + i, block.data(), sizeof block);
  }
}

#if defined(__x86_64__)

LAB03_AVX2 inline __m256i load(const std::uint32_t* words) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(words));
}

LAB03_AVX2 inline void store(std::uint32_t* words, __m256i x) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(words), x);
}

LAB03_AVX2 void leapfrog_avx2(std::uint32_t* lanes, std::uint32_t factor, std::uint32_t summand,
                              std::uint32_t* out, std::size_t n) {
  const __m256i f = _mm256_set1_epi32(static_cast<int>(factor));
  const __m256i s = _mm256_set1_epi32(static_cast<int>(summand));
  __m256i x[4] = {load(lanes), load(lanes + 8), load(lanes + 16), load(lanes + 24)};
  for (std::size_t i = 0; i < n; i += 32) {
    for (std::size_t k = 0; k < 4; ++k) {
      store(out + i + 8 * k, x[k]);
      x[k] = _mm256_add_epi32(_mm256_mullo_epi32(x[k], f), s);
    }
  }
  for (std::size_t k = 0; k < 4; ++k)
    store(lanes + 8 * k, x[k]);
}

template <int by>
LAB03_AVX2 inline __m256i rotated(__m256i x) {
  return _mm256_or_si256(_mm256_slli_epi32(x, by), _mm256_srli_epi32(x, 32 - by));
}

LAB03_AVX2 void xoshiro_avx2(XoshiroLanes& lanes, std::uint32_t* out, std::size_t n) {
  __m256i s0 = load(lanes[0].data()), s1 = load(lanes[1].data());
  __m256i s2 = load(lanes[2].data()), s3 = load(lanes[3].data());
  for (std::size_t i = 0; i < n; i += 8) {
    store(out + i, _mm256_add_epi32(rotated<7>(_mm256_add_epi32(s0, s3)), s0));
    const __m256i shifted = _mm256_slli_epi32(s1, 9);
    s2 = _mm256_xor_si256(s2, s0);
    s3 = _mm256_xor_si256(s3, s1);
    s1 = _mm256_xor_si256(s1, s2);
    s0 = _mm256_xor_si256(s0, s3);
    s2 = _mm256_xor_si256(s2, shifted);
    s3 = rotated<11>(s3);
  }
  store(lanes[0].data(), s0);
  store(lanes[1].data(), s1);
  store(lanes[2].data(), s2);
  store(lanes[3].data(), s3);
}

/// Four blocks: each word in the lower half of a 64-bit lane. The upper halves hold garbage, which
/// multiplications ignore.
struct FourBlocks {
  __m256i c[4];
};

LAB03_AVX2 inline FourBlocks four_blocks(std::uint64_t position) {
  const auto p = static_cast<long long>(position);
  const __m256i low = _mm256_set_epi64x(p + 3, p + 2, p + 1, p);
  return {{low, _mm256_srli_epi64(low, 32), _mm256_setzero_si256(), _mm256_setzero_si256()}};
}

LAB03_AVX2 inline void philox_round(FourBlocks& blocks, __m256i k0, __m256i k1) {
  auto& c = blocks.c;
  const __m256i p0 = _mm256_mul_epu32(c[0], _mm256_set1_epi64x(0xD2511F53));
  const __m256i p1 = _mm256_mul_epu32(c[2], _mm256_set1_epi64x(0xCD9E8D57));
  c[0] = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(p1, 32), c[1]), k0);
  c[2] = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(p0, 32), c[3]), k1);
  c[1] = p1;
  c[3] = p0;
}

LAB03_AVX2 inline void store_blocks(const FourBlocks& blocks, std::uint32_t* out) {
  const auto& c = blocks.c;
  const __m256i first = _mm256_blend_epi32(c[0], _mm256_slli_epi64(c[1], 32), 0xAA);
  const __m256i second = _mm256_blend_epi32(c[2], _mm256_slli_epi64(c[3], 32), 0xAA);
  const __m256i even = _mm256_unpacklo_epi64(first, second);  // blocks 0 and 2
  const __m256i odd = _mm256_unpackhi_epi64(first, second);   // blocks 1 and 3
  store(out, _mm256_permute2x128_si256(even, odd, 0x20));
  store(out + 8, _mm256_permute2x128_si256(even, odd, 0x31));
}

LAB03_AVX2 void philox_avx2(std::array<std::uint32_t, 2> key, std::uint64_t position,
                            std::uint32_t* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += 32, position += 8) {
    FourBlocks a = four_blocks(position), b = four_blocks(position + 4);
    std::uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < 10; ++round, k0 += 0x9E3779B9, k1 += 0xBB67AE85) {
      const __m256i key0 = _mm256_set1_epi64x(k0), key1 = _mm256_set1_epi64x(k1);
      philox_round(a, key0, key1);
      philox_round(b, key0, key1);
    }
    store_blocks(a, out + i);
    store_blocks(b, out + i + 16);
  }
}

#else

constexpr auto leapfrog_avx2 = leapfrog_any;
constexpr auto xoshiro_avx2 = xoshiro_any;
constexpr auto philox_avx2 = philox_any;

#endif

}  // namespace

bool has_avx2() {
#if defined(__x86_64__)
  return !avx2_forbidden && __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

void forbid_avx2(bool forbid) {
  avx2_forbidden = forbid;
}

// 32 steps are the map x -> f x + s; its values at 0 and 1 give f and s.
LeapfrogLcg::LeapfrogLcg(std::uint32_t seed) {
  Lcg(seed).fill(lanes_);
  Lcg from_0(0), from_1(1);
  std::uint32_t one = 0;
  for (int i = 0; i < 32; ++i) {
    summand_ = from_0.next();
    one = from_1.next();
  }
  factor_ = one - summand_;
}

void LeapfrogLcg::fill(std::span<std::uint32_t> out) {
  check_size(out.size());
  const auto run = has_avx2() ? leapfrog_avx2 : leapfrog_any;
  run(lanes_.data(), factor_, summand_, out.data(), out.size());
}

Xoshiro128x8::Xoshiro128x8(std::uint64_t seed) {
  SplitMix64 words(seed);
  for (std::size_t lane = 0; lane < 8; ++lane) {
    for (std::size_t i = 0; i < 4; ++i)
      state_[i][lane] = static_cast<std::uint32_t>(words.next() >> 32);
  }
}

void Xoshiro128x8::fill(std::span<std::uint32_t> out) {
  check_size(out.size());
  const auto run = has_avx2() ? xoshiro_avx2 : xoshiro_any;
  run(state_, out.data(), out.size());
}

// The key is derived from the seed as in carlo::Rng.
PhiloxBlocks::PhiloxBlocks(std::uint64_t seed)
    : key_{static_cast<std::uint32_t>(carlo::mix(seed)),
           static_cast<std::uint32_t>(carlo::mix(seed) >> 32)} {}

void PhiloxBlocks::fill(std::span<std::uint32_t> out) {
  check_size(out.size());
  const auto run = has_avx2() ? philox_avx2 : philox_any;
  run(key_, position_, out.data(), out.size());
  position_ += out.size() / 4;
}

}  // namespace lab03
