#include "fast_fill.h"

#include "cli/error.h"
#include "generators.h"
#include "random/hash.h"
#include "random/philox.h"

#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// One body for each generator, compiled twice: once for every machine, once for those with AVX2.
#if defined(__x86_64__)
#define LAB03_AVX2 __attribute__((target("avx2")))
#else
#define LAB03_AVX2
#endif
#define LAB03_BODY static inline __attribute__((always_inline))

namespace lab03 {
namespace {

/// Eight words that compilers keep in one register (GCC and Clang's vector extension).
typedef std::uint32_t Eight __attribute__((vector_size(32)));

bool avx2_forbidden = false;

void check_size(std::size_t size) {
  if (size % 32 != 0) throw carlo::Error("fast fills take a multiple of 32 words");
}

LAB03_BODY void leapfrog(std::uint32_t* lanes, std::uint32_t factor, std::uint32_t summand,
                         std::uint32_t* out, std::size_t n) {
  Eight x[4];
  std::memcpy(x, lanes, sizeof x);
  for (std::size_t i = 0; i < n; i += 32) {
    std::memcpy(out + i, x, sizeof x);
    for (Eight& lane : x)
      lane = lane * factor + summand;
  }
  std::memcpy(lanes, x, sizeof x);
}

LAB03_BODY void xoshiro(void* state, std::uint32_t* out, std::size_t n) {
  Eight s[4];
  std::memcpy(s, state, sizeof s);
  for (std::size_t i = 0; i < n; i += 8) {
    const Eight sum = s[0] + s[3];
    const Eight result = ((sum << 7) | (sum >> 25)) + s[0];
    const Eight shifted = s[1] << 9;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= shifted;
    s[3] = (s[3] << 11) | (s[3] >> 21);
    std::memcpy(out + i, &result, sizeof result);
  }
  std::memcpy(state, s, sizeof s);
}

void leapfrog_any(std::uint32_t* lanes, std::uint32_t factor, std::uint32_t summand,
                  std::uint32_t* out, std::size_t n) {
  leapfrog(lanes, factor, summand, out, n);
}
LAB03_AVX2 void leapfrog_avx2(std::uint32_t* lanes, std::uint32_t factor, std::uint32_t summand,
                              std::uint32_t* out, std::size_t n) {
  leapfrog(lanes, factor, summand, out, n);
}
void xoshiro_any(void* state, std::uint32_t* out, std::size_t n) {
  xoshiro(state, out, n);
}
LAB03_AVX2 void xoshiro_avx2(void* state, std::uint32_t* out, std::size_t n) {
  xoshiro(state, out, n);
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

LAB03_AVX2 inline __m256i all(std::uint32_t x) {
  return _mm256_set1_epi32(static_cast<int>(x));
}

/// The upper and lower halves of the products of eight words with one.
struct Halves {
  __m256i high, low;
};

LAB03_AVX2 inline Halves products(__m256i x, __m256i factor) {
  const __m256i even = _mm256_mul_epu32(x, factor);
  const __m256i odd = _mm256_mul_epu32(_mm256_srli_epi64(x, 32), factor);
  return {_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xAA),
          _mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xAA)};
}

/// Writes eight blocks whose words stand in four registers, block after block.
LAB03_AVX2 inline void store_blocks(const __m256i (&c)[4], std::uint32_t* out) {
  const __m256i a = _mm256_unpacklo_epi32(c[0], c[1]), b = _mm256_unpackhi_epi32(c[0], c[1]);
  const __m256i d = _mm256_unpacklo_epi32(c[2], c[3]), e = _mm256_unpackhi_epi32(c[2], c[3]);
  // Each holds a block of the lower four and one of the upper four.
  const __m256i pairs[4] = {_mm256_unpacklo_epi64(a, d), _mm256_unpackhi_epi64(a, d),
                            _mm256_unpacklo_epi64(b, e), _mm256_unpackhi_epi64(b, e)};
  for (int i = 0; i < 4; ++i) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + 4 * i), _mm256_castsi256_si128(pairs[i]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + 16 + 4 * i),
                     _mm256_extracti128_si256(pairs[i], 1));
  }
}

LAB03_AVX2 void philox_avx2(std::array<std::uint32_t, 2> key, std::uint64_t position,
                            std::uint32_t* out, std::size_t n) {
  const __m256i m0 = all(0xD2511F53), m1 = all(0xCD9E8D57);
  for (std::size_t i = 0; i < n; i += 32, position += 8) {
    alignas(32) std::array<std::uint32_t, 8> low{}, high{};
    for (std::size_t lane = 0; lane < 8; ++lane) {
      low[lane] = static_cast<std::uint32_t>(position + lane);
      high[lane] = static_cast<std::uint32_t>((position + lane) >> 32);
    }
    __m256i c[4] = {_mm256_load_si256(reinterpret_cast<const __m256i*>(low.data())),
                    _mm256_load_si256(reinterpret_cast<const __m256i*>(high.data())),
                    _mm256_setzero_si256(), _mm256_setzero_si256()};
    std::uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < 10; ++round, k0 += 0x9E3779B9, k1 += 0xBB67AE85) {
      const Halves p0 = products(c[0], m0), p1 = products(c[2], m1);
      c[0] = _mm256_xor_si256(_mm256_xor_si256(p1.high, c[1]), all(k0));
      c[2] = _mm256_xor_si256(_mm256_xor_si256(p0.high, c[3]), all(k1));
      c[1] = p1.low;
      c[3] = p0.low;
    }
    store_blocks(c, out + i);
  }
}

#else

void philox_avx2(std::array<std::uint32_t, 2> key, std::uint64_t position, std::uint32_t* out,
                 std::size_t n) {
  philox_any(key, position, out, n);
}

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

// 32 steps are the map x -> f x + s; where they take 0 and 1 tells f and s.
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
  run(state_.data(), out.data(), out.size());
}

// The key is made from the seed as carlo::Rng makes it.
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
