#pragma once
/// Vectors of eight numbers in 256 bits, one number for each of eight paths. Templates for one number (directions.hpp)
/// also work for eight.
///
/// Truth values are Int8 of −1 and 0. A number never depends on those beside it. Vector extensions of GCC and Clang,
/// compiled for AVX2, which Embree is started for too.

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace septet::raytrace {

using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));
using Bits8 = std::uint32_t __attribute__((vector_size(32)));

inline Float8 eight(float x) { return Float8{x, x, x, x, x, x, x, x}; }
inline Int8 eight(std::int32_t x) { return Int8{x, x, x, x, x, x, x, x}; }

inline Float8 larger(Float8 a, Float8 b) { return a > b ? a : b; }
inline float larger(float a, float b) { return std::max(a, b); }
inline Float8 magnitude(Float8 x) { return std::bit_cast<Float8>(std::bit_cast<Int8>(x) & 0x7fffffff); }
inline float magnitude(float x) { return std::abs(x); }
inline Float8 root(Float8 x) { return _mm256_sqrt_ps(x); }
inline float root(float x) { return std::sqrt(x); }
/// 1 with the sign of `x`.
inline Float8 sign_of(Float8 x) {
  return std::bit_cast<Float8>((std::bit_cast<Int8>(x) & INT32_MIN) | std::bit_cast<Int8>(eight(1.0f)));
}
inline float sign_of(float x) { return std::copysign(1.0f, x); }
/// Rounds towards zero; `number` converts back.
inline Int8 whole(Float8 x) { return __builtin_convertvector(x, Int8); }
inline int whole(float x) { return static_cast<int>(x); }
inline Float8 number(Int8 x) { return __builtin_convertvector(x, Float8); }
inline float number(int x) { return static_cast<float>(x); }

/// Bit mask of eight truth values; `truths_of` converts back.
inline std::uint32_t bits_of(Int8 truths) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(std::bit_cast<Float8>(truths)));
}
inline Int8 truths_of(std::uint32_t bits) {
  const Int8 each{1, 2, 4, 8, 16, 32, 64, 128};
  return (eight(static_cast<std::int32_t>(bits)) & each) != 0;
}

constexpr bool holds(std::uint32_t bits, std::size_t n) { return (bits >> n & 1u) != 0; }

/// Eight points, vectors or colours.
struct Vec8 {
  Float8 x, y, z;

  glm::vec3 operator[](std::size_t n) const { return {x[n], y[n], z[n]}; }
  void set(std::size_t n, const glm::vec3& v) { x[n] = v.x, y[n] = v.y, z[n] = v.z; }
};

inline Vec8 eight(const glm::vec3& v) { return {eight(v.x), eight(v.y), eight(v.z)}; }
inline Vec8 operator+(const Vec8& a, const Vec8& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec8 operator-(const Vec8& a, const Vec8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec8 operator*(const Vec8& a, const Vec8& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec8 operator*(const Vec8& a, Float8 b) { return {a.x * b, a.y * b, a.z * b}; }
inline Float8 dot(const Vec8& a, const Vec8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec8 chosen(Int8 truths, const Vec8& a, const Vec8& b) {
  return {truths ? a.x : b.x, truths ? a.y : b.y, truths ? a.z : b.z};
}

/// Transposes eight rows of eight numbers, each row aligned to 32 bytes, into eight columns.
inline void transpose(const float* const (&rows)[8], Float8 (&columns)[8]) {
  Float8 r[8], pairs[8], fours[8];
  for (int n = 0; n < 8; ++n) r[n] = _mm256_load_ps(rows[n]);
  for (int n = 0; n < 8; n += 2)
    pairs[n] = _mm256_unpacklo_ps(r[n], r[n + 1]), pairs[n + 1] = _mm256_unpackhi_ps(r[n], r[n + 1]);
  for (int n = 0; n < 8; n += 4)
    for (int half = 0; half < 2; ++half) {
      const Float8 a = pairs[n + half], b = pairs[n + half + 2];
      fours[n + 2 * half] = _mm256_shuffle_ps(a, b, 0x44), fours[n + 2 * half + 1] = _mm256_shuffle_ps(a, b, 0xee);
    }
  for (int n = 0; n < 4; ++n) {
    columns[n] = _mm256_permute2f128_ps(fours[n], fours[n + 4], 0x20);
    columns[n + 4] = _mm256_permute2f128_ps(fours[n], fours[n + 4], 0x31);
  }
}

}  // namespace septet::raytrace
