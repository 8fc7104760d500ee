#pragma once
/// Random numbers of a path: a function of the picture's seed, the pixel, the sample and how many were drawn before, and of
/// nothing else, so that a picture is the same bit for bit whoever traces which of its pixels when.
///
/// A counter is put through the finaliser of SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number
/// Generators", 2014), after the pixel and the sample have been mixed into its beginning the same way.

#include <cstdint>

#include <glm/vec2.hpp>

namespace septet::raytrace {

class PathRandom {
 public:
  PathRandom() = default;  ///< Of no path.
  PathRandom(std::uint64_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t sample)
      : PathRandom(of_pixel(seed, x, y), sample) {}
  /// `pixel`: as `of_pixel` has it, which all samples of a pixel share.
  PathRandom(std::uint64_t pixel, std::uint32_t sample) : counter_(mixed(pixel + sample)) {}
  static std::uint64_t of_pixel(std::uint64_t seed, std::uint32_t x, std::uint32_t y) {
    return mixed(mixed(seed) ^ (std::uint64_t{y} << 32 | x));
  }

  /// Uniform in [0, 1), 24 bits.
  float uniform() { return static_cast<float>(next() >> 40) * unit; }
  /// Two of them.
  glm::vec2 pair() {
    const std::uint64_t bits = next();
    return {static_cast<float>(bits >> 40) * unit, static_cast<float>(bits & 0xffffffu) * unit};
  }

 private:
  static constexpr float unit = 1.0f / 16777216.0f;
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t next() { return mixed(counter_ += 0x9e3779b97f4a7c15u); }

  std::uint64_t counter_ = 0;
};

}  // namespace septet::raytrace
