#pragma once
/// The sky and the sun as lights: radiance of a direction, and directions drawn by brightness.
///
/// The sky is SkyLight's table, drawn cell by cell by brightness and evenly within one; the sun, or at night the moon,
/// is a disc of 0.53° with SkyLight's irradiance.

#include <vector>

#include "engine/instant/atmosphere.hpp"
#include "engine/raytrace/directions.hpp"

namespace septet::raytrace {

struct LightSample {
  glm::vec3 direction{0.0f};  ///< Unit, to the light.
  glm::vec3 radiance{0.0f};
  float pdf = 0.0f;  ///< Density, 1/sr; 0: no light to sample.
};

class Sky {
 public:
  explicit Sky(const instant::SkyLight& light);

  glm::vec3 radiance(const glm::vec3& direction) const { return instant::sky_radiance(light_, direction); }
  bool shines() const { return !cumulative_.empty(); }
  LightSample sample(const glm::vec2& random, float random_cell) const;
  float pdf(const glm::vec3& direction) const;

  bool has_sun() const { return luminance(sun_radiance_) > 0.0f; }
  glm::vec3 sun_radiance(const glm::vec3& direction) const {
    return glm::dot(direction, sun_.axis) >= sun_cosine ? sun_radiance_ : glm::vec3(0.0f);
  }
  LightSample sample_sun(const glm::vec2& random) const;
  float sun_pdf(const glm::vec3& direction) const {
    return has_sun() && glm::dot(direction, sun_.axis) >= sun_cosine ? 1.0f / sun_solid_angle : 0.0f;
  }

 private:
  static constexpr float sun_cosine = 0.99998931f;  ///< Cosine of 0.265°.
  static constexpr float sun_solid_angle = 2.0f * pi * (1.0f - sun_cosine);
  static constexpr std::uint32_t columns = instant::SkyTable::columns, rows = instant::SkyTable::rows;

  instant::SkyLight light_;
  float sun_azimuth_rad_;
  std::vector<float> cumulative_;  ///< Cumulative shares of the cells, the last 1; empty: a black sky.
  std::vector<float> pdf_;         ///< Density by cell, 1/sr.
  Frame sun_;
  glm::vec3 sun_radiance_;
};

}  // namespace septet::raytrace
