#include "engine/raytrace/sky.hpp"

#include <algorithm>

namespace septet::raytrace {
namespace {

/// Height of a row's edge, and azimuth from the sun of a column's: the inverse of SkyTable's places.
float height_of(float row, float rows) {
  const float s = 2.0f * row / rows - 1.0f;
  return s * std::abs(s);
}
float azimuth_of(float column, float columns) { return 2.0f * std::asin(std::min(1.0f, column / columns)); }

}  // namespace

Sky::Sky(const instant::SkyLight& light)
    : light_(light),
      sun_azimuth_rad_(std::atan2(light.sun_direction.y, light.sun_direction.x)),
      sun_(glm::normalize(light.light_direction)),
      sun_radiance_(light.light_irradiance / sun_solid_angle) {
  pdf_.resize(std::size_t{rows} * columns);
  cumulative_.resize(pdf_.size());
  double sum = 0.0;
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const float solid_angle = 2.0f * (height_of(row + 1.0f, rows) - height_of(static_cast<float>(row), rows)) *
                                (azimuth_of(column + 1.0f, columns) - azimuth_of(static_cast<float>(column), columns));
      // Between cells the table is interpolated: the brightest neighbour counts. Cells below the horizon are mostly
      // hidden.
      float brightest = 0.0f;
      for (std::uint32_t r = std::max(row, 1u) - 1; r <= std::min(row + 1, rows - 1); ++r)
        for (std::uint32_t c = std::max(column, 1u) - 1; c <= std::min(column + 1, columns - 1); ++c)
          brightest = std::max(brightest, luminance(light_.table.radiance[std::size_t{r} * columns + c]));
      const std::size_t cell = std::size_t{row} * columns + column;
      pdf_[cell] = brightest * (row < rows / 2 ? 0.25f : 1.0f);
      sum += double{pdf_[cell]} * double{solid_angle};
      cumulative_[cell] = static_cast<float>(sum);
    }
  if (!(sum > 0.0)) {
    cumulative_.clear();
    return;
  }
  for (float& density : pdf_) density = static_cast<float>(density / sum);
  for (float& share : cumulative_) share = static_cast<float>(share / sum);
  cumulative_.back() = 1.0f;
}

LightSample Sky::sample(const glm::vec2& random, float random_cell) const {
  if (cumulative_.empty()) return {};
  const auto cell = static_cast<std::uint32_t>(
      std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, random_cell) - cumulative_.begin());
  const std::uint32_t row_index = cell / columns, column_index = cell % columns;
  const auto row = static_cast<float>(row_index), column = static_cast<float>(column_index);
  const float low = height_of(row, rows), high = height_of(row + 1.0f, rows);
  const float z = std::clamp(low + (high - low) * random.x, -1.0f, 1.0f);
  // Both sides of the sun's azimuth share a cell.
  const float side = random.y < 0.5f ? 1.0f : -1.0f, along = random.y < 0.5f ? 2.0f * random.y : 2.0f * random.y - 1.0f;
  const float near = azimuth_of(column, columns), far = azimuth_of(column + 1.0f, columns);
  const glm::vec3 direction = from_angles(z, sun_azimuth_rad_ + side * (near + (far - near) * along));
  return {direction, radiance(direction), pdf_[cell]};
}

float Sky::pdf(const glm::vec3& direction) const {
  if (cumulative_.empty()) return 0.0f;
  const float level = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  const float sun_x = std::cos(sun_azimuth_rad_), sun_y = std::sin(sun_azimuth_rad_);
  const float cosine = level > 1e-6f ? (direction.x * sun_x + direction.y * sun_y) / level : 1.0f;
  const float u = std::sqrt(std::max(0.0f, 0.5f - 0.5f * cosine));
  const float v = 0.5f + 0.5f * std::copysign(std::sqrt(std::abs(direction.z)), direction.z);
  const auto column = std::min(static_cast<std::uint32_t>(u * columns), columns - 1);
  const auto row = std::min(static_cast<std::uint32_t>(v * rows), rows - 1);
  return pdf_[std::size_t{row} * columns + column];
}

LightSample Sky::sample_sun(const glm::vec2& random) const {
  const float cosine = 1.0f - random.x * (1.0f - sun_cosine);
  // Cosines so near to 1 have few digits left: the sine is computed from 1 − cosine.
  const float lack = random.x * (1.0f - sun_cosine), sine = std::sqrt(lack * (2.0f - lack));
  const float azimuth_rad = 2.0f * pi * random.y;
  return {sun_.to_world({sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), cosine}), sun_radiance_,
          1.0f / sun_solid_angle};
}

}  // namespace septet::raytrace
