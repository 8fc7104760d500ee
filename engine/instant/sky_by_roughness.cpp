#include "engine/instant/sky_by_roughness.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace septet::instant {
namespace {

constexpr float half_turn_rad = std::numbers::pi_v<float>;

/// Direction of light relative to the mirrored one, which is z, and its weight.
struct Lobe {
  glm::vec3 direction{0.0f, 0.0f, 1.0f};
  float weight = 1.0f;
};

std::vector<Lobe> lobe_of(float roughness) {
  constexpr std::uint32_t rings = 6, spokes = 8;
  const float alpha = roughness * roughness;
  std::vector<Lobe> lobe;
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    for (std::uint32_t spoke = 0; spoke < spokes; ++spoke) {
      // Facets drawn evenly by their density; every other ring turned by half a spoke.
      const float share = (static_cast<float>(ring) + 0.5f) / rings;
      const float square = (1.0f - share) / (1.0f + (alpha * alpha - 1.0f) * share), cosine = std::sqrt(square);
      const float around =
          2.0f * half_turn_rad * (static_cast<float>(spoke) + 0.5f * static_cast<float>(ring % 2)) / spokes;
      const float up = 2.0f * square - 1.0f, across = 2.0f * cosine * std::sqrt(std::max(0.0f, 1.0f - square));
      if (up > 0.0f) lobe.push_back({{across * std::cos(around), across * std::sin(around), up}, up});
    }
  return lobe;
}

/// Direction of a table's cell, with x towards the sun.
glm::vec3 direction_of(float column, float row, float columns, float rows) {
  const float s = 2.0f * (row + 0.5f) / rows - 1.0f, z = s * std::abs(s), level = std::sqrt(1.0f - z * z);
  const float u = (column + 0.5f) / columns, cosine = 1.0f - 2.0f * u * u;
  return {level * cosine, level * std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)), z};
}

}  // namespace

std::array<SkyTable, light::roughness_steps> sky_by_roughness(const SkyLight& light) {
  constexpr std::uint32_t columns = SkyTable::columns, rows = SkyTable::rows, coarser = 2;
  const glm::vec3 ground = light.ground_irradiance / half_turn_rad;
  // Frame of the table: x points to the sun's azimuth.
  SkyLight from_sun = light;
  from_sun.sun_direction = {1.0f, 0.0f, 0.0f};
  const auto seen = [&](const glm::vec3& direction) {
    return direction.z > 0.0f ? sky_radiance(from_sun, {direction.x, direction.y, std::max(direction.z, 2e-3f)})
                              : ground;
  };
  std::array<SkyTable, light::roughness_steps> tables;
  tables[0].radiance = light.table.radiance;
  std::fill_n(tables[0].radiance.begin(), std::size_t{rows / 2} * columns, ground);
  for (std::uint32_t step = 1; step < light::roughness_steps; ++step) {
    const std::vector<Lobe> lobe = lobe_of(light::roughness_step * static_cast<float>(step));
    // Every other direction suffices: rough reflections have no detail.
    constexpr std::uint32_t few_columns = columns / coarser, few_rows = rows / coarser;
    std::vector<glm::vec3> few(std::size_t{few_columns} * few_rows);
    for (std::uint32_t row = 0; row < few_rows; ++row)
      for (std::uint32_t column = 0; column < few_columns; ++column) {
        const glm::vec3 axis = direction_of(static_cast<float>(column), static_cast<float>(row), few_columns, few_rows);
        const glm::vec3 across = glm::normalize(glm::vec3(-axis.y, axis.x, 0.0f)), along = glm::cross(axis, across);
        glm::vec3 sum(0.0f);
        float weight = 0.0f;
        for (const Lobe& each : lobe) {
          sum += each.weight * seen(across * each.direction.x + along * each.direction.y + axis * each.direction.z);
          weight += each.weight;
        }
        few[std::size_t{row} * few_columns + column] = sum / weight;
      }
    tables[step].radiance.resize(std::size_t{rows} * columns);
    for (std::uint32_t row = 0; row < rows; ++row)
      for (std::uint32_t column = 0; column < columns; ++column) {
        const float x = std::clamp((static_cast<float>(column) + 0.5f) / coarser - 0.5f, 0.0f, few_columns - 1.001f);
        const float y = std::clamp((static_cast<float>(row) + 0.5f) / coarser - 0.5f, 0.0f, few_rows - 1.001f);
        const auto left = static_cast<std::uint32_t>(x), low = static_cast<std::uint32_t>(y);
        const auto at = [&](std::uint32_t c, std::uint32_t r) { return few[std::size_t{r} * few_columns + c]; };
        const auto fraction_x = x - static_cast<float>(left), fraction_y = y - static_cast<float>(low);
        tables[step].radiance[std::size_t{row} * columns + column] =
            glm::mix(glm::mix(at(left, low), at(left + 1, low), fraction_x),
                     glm::mix(at(left, low + 1), at(left + 1, low + 1), fraction_x), fraction_y);
      }
  }
  return tables;
}

}  // namespace septet::instant
