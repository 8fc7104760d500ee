#pragma once
/// Deterministic noise: the same on every machine for the same seed.
///
/// Gradient noise after Perlin, "Improving Noise" (2002), with hashed gradients instead of a table.

#include <cstdint>

namespace septet::geometry {

/// A well mixed number in [0, 1) for a lattice point.
double lattice_random(std::int64_t x, std::int64_t y, std::uint64_t seed);

/// Smooth in x and y, zero at whole numbers, about −0.8 to 0.8. With `period` > 0 it repeats after
/// that many units in both directions (for textures that tile).
double gradient_noise(double x, double y, std::uint64_t seed, std::int64_t period = 0);

/// Sum of `octaves` of gradient noise, each twice as fine and half as strong; about −1 to 1.
double fractal_noise(double x, double y, int octaves, std::uint64_t seed, std::int64_t period = 0);

}  // namespace septet::geometry
