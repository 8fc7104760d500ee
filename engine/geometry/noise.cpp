#include "engine/geometry/noise.hpp"

#include <cmath>

namespace septet::geometry {
namespace {

/// SplitMix64's finaliser (Steele, Lea and Flood 2014) over the coordinates.
std::uint64_t mixed(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  std::uint64_t z =
      seed + static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

std::int64_t wrapped(std::int64_t value, std::int64_t period) {
  return period > 0 ? (value % period + period) % period : value;
}

/// One of eight gradients, dotted with the offset from the lattice point.
double slope(std::int64_t x, std::int64_t y, double dx, double dy, std::uint64_t seed) {
  constexpr double diagonal = 0.70710678118654752;
  switch (mixed(x, y, seed) >> 61) {
    case 0:
      return dx;
    case 1:
      return -dx;
    case 2:
      return dy;
    case 3:
      return -dy;
    case 4:
      return diagonal * (dx + dy);
    case 5:
      return diagonal * (dx - dy);
    case 6:
      return diagonal * (-dx + dy);
    default:
      return -diagonal * (dx + dy);
  }
}

}  // namespace

double lattice_random(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  return static_cast<double>(mixed(x, y, seed) >> 11) * 0x1.0p-53;
}

double gradient_noise(double x, double y, std::uint64_t seed, std::int64_t period) {
  const double floor_x = std::floor(x), floor_y = std::floor(y);
  const auto cell_x = static_cast<std::int64_t>(floor_x), cell_y = static_cast<std::int64_t>(floor_y);
  const std::int64_t x0 = wrapped(cell_x, period), x1 = wrapped(cell_x + 1, period);
  const std::int64_t y0 = wrapped(cell_y, period), y1 = wrapped(cell_y + 1, period);
  const double dx = x - floor_x, dy = y - floor_y;
  const double u = fade(dx), v = fade(dy);
  const double low = std::lerp(slope(x0, y0, dx, dy, seed), slope(x1, y0, dx - 1, dy, seed), u);
  const double high = std::lerp(slope(x0, y1, dx, dy - 1, seed), slope(x1, y1, dx - 1, dy - 1, seed), u);
  return std::lerp(low, high, v);
}

double fractal_noise(double x, double y, int octaves, std::uint64_t seed, std::int64_t period) {
  double sum = 0.0, strength = 1.0, scale = 1.0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += strength * gradient_noise(x * scale, y * scale, seed + static_cast<std::uint64_t>(octave) * 7919u,
                                     period * static_cast<std::int64_t>(scale));
    strength *= 0.5;
    scale *= 2.0;
  }
  return sum;
}

}  // namespace septet::geometry
