#pragma once
/// Random numbers of a path: a function of the picture's seed, the pixel, the sample and the number of draws before,
/// and of nothing else, so that a picture is the same bit for bit on any machine and in any order of pixels.
///
/// Numbers are a counter put through the finaliser of SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom
/// Number Generators", 2014), after the pixel and the sample have been mixed into its beginning the same way.

#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "engine/raytrace/eight.hpp"

namespace septet::raytrace {

class PathRandom {
 public:
  PathRandom() = default;  ///< Numbers of no path.
  PathRandom(std::uint64_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t sample)
      : PathRandom(of_pixel(seed, x, y), sample) {}
  /// `pixel`: result of `of_pixel`, which all samples of a pixel share.
  PathRandom(std::uint64_t pixel, std::uint32_t sample) : counter_(mixed(pixel + sample)) {}
  static std::uint64_t of_pixel(std::uint64_t seed, std::uint32_t x, std::uint32_t y) {
    return mixed(mixed(seed) ^ (std::uint64_t{y} << 32 | x));
  }

  /// Uniform in [0, 1), 24 bits.
  float uniform() { return static_cast<float>(next() >> 40) * unit; }
  /// Two such numbers.
  glm::vec2 pair() {
    const std::uint64_t bits = next();
    return {static_cast<float>(bits >> 40) * unit, static_cast<float>(bits & 0xffffffu) * unit};
  }

 private:
  static constexpr float unit = 1.0f / 16777216.0f;
  friend class PathRandom8;
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15u;
  template <typename Word>
  static Word mixed(Word z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t next() { return mixed(counter_ += step); }

  std::uint64_t counter_ = 0;
};

/// Random numbers of eight paths: each draws the numbers that it would draw by itself.
class PathRandom8 {
 public:
  /// `of(n)`: the numbers of path n.
  template <typename Of>
  explicit PathRandom8(const Of& of) {
    for (std::size_t n = 0; n < 4; ++n) low_[n] = of(n).counter_, high_[n] = of(n + 4).counter_;
  }
  PathRandom operator[](std::size_t n) const {
    PathRandom one;
    one.counter_ = n < 4 ? low_[n] : high_[n - 4];
    return one;
  }

  /// Draws for the paths with a true `drawn`; the others' counters stay.
  Float8 uniform(Int8 drawn) {
    step(drawn);
    return numbers(PathRandom::mixed(low_) >> 40, PathRandom::mixed(high_) >> 40);
  }
  struct Pair {
    Float8 x, y;
  };
  Pair pair(Int8 drawn) {
    step(drawn);
    const Word4 low = PathRandom::mixed(low_), high = PathRandom::mixed(high_);
    return {numbers(low >> 40, high >> 40), numbers(low & 0xffffffu, high & 0xffffffu)};
  }

 private:
  using Word4 = std::uint64_t __attribute__((vector_size(32)));
  void step(Int8 drawn) {
    const __m256i truths = std::bit_cast<__m256i>(drawn);
    low_ += std::bit_cast<Word4>(_mm256_cvtepi32_epi64(_mm256_castsi256_si128(truths))) & PathRandom::step;
    high_ += std::bit_cast<Word4>(_mm256_cvtepi32_epi64(_mm256_extracti128_si256(truths, 1))) & PathRandom::step;
  }
  static Float8 numbers(Word4 low, Word4 high) {
    // Lower half of each word, in order.
    const Float8 halves = _mm256_shuffle_ps(std::bit_cast<Float8>(low), std::bit_cast<Float8>(high), 0x88);
    return number(std::bit_cast<Int8>(_mm256_permute4x64_epi64(std::bit_cast<__m256i>(halves), 0xd8))) *
           PathRandom::unit;
  }

  Word4 low_, high_;
};

}  // namespace septet::raytrace
