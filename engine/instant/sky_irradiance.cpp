#include "engine/instant/sky_irradiance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/instant/atmosphere.hpp"

namespace septet::instant {
namespace {

/// Functions of the terms.
std::array<double, 7> functions(double x, double y, double z) {
  const double z2 = z * z;
  return {1.0, z, x, 3.0 * z2 - 1.0, x * z, x * x - y * y, 35.0 * z2 * z2 - 30.0 * z2 + 3.0};
}

/// `radiance(row, column, z, cosine)`: of a cell of the sky's table, at the direction's height z and the cosine of its
/// azimuth from the sun.
template <class Radiance>
SkyIrradiance irradiance_from(const Radiance& radiance, const glm::vec3& level_irradiance) {
  std::array<Vec3, 7> sums{};
  for (std::uint32_t row = 0; row < SkyTable::rows; ++row)
    for (std::uint32_t column = 0; column < SkyTable::columns; ++column) {
      const double s = 2.0 * (row + 0.5) / SkyTable::rows - 1.0, z = s * std::abs(s);
      const double u = (column + 0.5) / SkyTable::columns;
      const double cosine = 1.0 - 2.0 * u * u, level = std::sqrt(1.0 - z * z);
      const double x = level * cosine, y = level * std::sqrt(1.0 - cosine * cosine);
      // Δz · ΔΔ of the cell, with z = s·|s| and Δ = 2·asin u, on both sides of the sun.
      const double height = 4.0 * std::abs(s) / SkyTable::rows;
      const double width =
          2.0 * (std::asin((column + 1.0) / SkyTable::columns) - std::asin(double(column) / SkyTable::columns));
      const double solid_angle = 2.0 * height * width;
      const std::array<double, 7> shape = functions(x, y, z);
      const Vec3 light = radiance(row, column, z, cosine) * solid_angle;
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += light * shape[i];
    }
  // Squared norms of the harmonics, times π, 2π/3, π/4 and −π/24, the coefficients of the cosine.
  constexpr std::array<double, 7> weights{1.0 / 4.0,   1.0 / 2.0,   1.0 / 2.0,    5.0 / 64.0,
                                          15.0 / 16.0, 15.0 / 64.0, -3.0 / 2048.0};
  SkyIrradiance irradiance;
  for (std::size_t i = 0; i < sums.size(); ++i) irradiance[i] = glm::vec3(sums[i] * weights[i]);
  const glm::vec3 missing =
      level_irradiance - (irradiance[0] + irradiance[1] + 2.0f * irradiance[3] + 8.0f * irradiance[6]);
  irradiance[0] += 0.5f * missing;
  irradiance[1] += 0.5f * missing;
  return irradiance;
}

bool is_sky(std::uint32_t row) { return row >= SkyTable::rows / 2; }

}  // namespace

SkyIrradiance sky_irradiance(const SkyTable& table, const glm::vec3& level_irradiance,
                             const glm::vec3& ground_radiance) {
  return irradiance_from(
      [&](std::uint32_t row, std::uint32_t column, double, double) {
        return Vec3(is_sky(row) ? table.radiance[row * SkyTable::columns + column] : ground_radiance);
      },
      level_irradiance);
}

SkyIrradiance street_irradiance(const SkyTable& table, const glm::vec3& level_irradiance,
                                const glm::vec3& ground_radiance, const Street& street) {
  // Sine of 13°, the height of houses across a street.
  constexpr double hidden_below = 0.23;
  // Share of the ground in a wall's shadow, of that which it sees straight away from the sun.
  constexpr double own_shadow = 0.7;
  return irradiance_from(
      [&](std::uint32_t row, std::uint32_t column, double z, double cosine) {
        const double from_sun = std::max(0.0, -cosine);
        if (!is_sky(row)) return Vec3(ground_radiance) - own_shadow * from_sun * Vec3(street.ground_sun_radiance);
        const Vec3 sky(table.radiance[row * SkyTable::columns + column]);
        if (z > hidden_below) return sky;
        const Vec3 upright = Vec3(street.shaded_radiance) + from_sun * Vec3(street.sunlit_radiance);
        return glm::mix(sky, upright, double{street.hidden_share});
      },
      level_irradiance);
}

}  // namespace septet::instant
