#include "engine/instant/atmosphere.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "engine/instant/adaptation.hpp"
#include "engine/sight/air.hpp"

namespace septet::instant {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double ground_radius_m = 6.360e6, top_radius_m = 6.460e6;
constexpr double rayleigh_scale_m = 8000.0, haze_scale_m = 1200.0;
constexpr double haze_anisotropy = 0.76;
// Irradiance above the air, in the unit of irradiance.
constexpr double solar_constant = 128.0e3 / luminance_unit_cdpm2;
const Vec3 rayleigh_per_m{5.802e-6, 13.558e-6, 33.1e-6};
const Vec3 ozone_per_m{0.650e-6, 1.881e-6, 0.085e-6};
const Vec3 ground_albedo{0.11, 0.12, 0.08};
const Vec3 snow_albedo{0.75, 0.76, 0.78};  // Snow between bare tracks and objects; fresh snow alone has 0.8 to 0.9.
/// Mean albedo of houses and trees along a street, and the share of the lowest sky that they hide.
const Vec3 upright_albedo{0.36, 0.26, 0.16};
constexpr float street_hidden_share = 0.8f;
const Vec3 night_sky{1.0e-5, 1.64e-5, 3.27e-5};  // Some 0.13 cd/m², as over a lit country.
/// At night clouds return the light of towns: brighter than a clear sky (Kyba et al. 2011).
const Vec3 towns_on_clouds{4.18e-5, 3.82e-5, 3.64e-5};
const Vec3 moonlight{0.73e-4, 0.91e-4, 1.27e-4};  // Some 0.7 lx, that of a full moon over snow.

double luminance(const Vec3& color) { return glm::dot(color, Vec3(0.2126, 0.7152, 0.0722)); }

double step_between(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Air above one place: its scattering and extinction, and the transmittance of sunlight to a height.
class Air {
 public:
  explicit Air(double haze_per_m) : haze_per_m_(haze_per_m) {
    for (int h = 0; h < heights; ++h)
      for (int z = 0; z < zeniths; ++z) table_[h][z] = integrate(height_of(h), cosine_of(z));
  }

  static double rayleigh_density(double height_m) { return std::exp(-height_m / rayleigh_scale_m); }
  static double haze_density(double height_m) { return std::exp(-height_m / haze_scale_m); }
  double haze_per_m() const { return haze_per_m_; }

  Vec3 extinction(double height_m) const {
    const double ozone = std::max(0.0, 1.0 - std::abs(height_m - 25000.0) / 15000.0);
    return rayleigh_per_m * rayleigh_density(height_m) + Vec3(haze_per_m_ * 1.11 * haze_density(height_m)) +
           ozone_per_m * ozone;
  }
  /// Transmittance of sunlight to `height_m` from the zenith cosine; 0 if the Earth hides the sun.
  Vec3 transmittance(double height_m, double cosine) const {
    const double h = std::sqrt(std::clamp(height_m / max_height_m, 0.0, 1.0)) * (heights - 1);
    const double z = std::clamp((cosine + 0.3) / 1.3, 0.0, 1.0) * (zeniths - 1);
    const int h0 = std::min(static_cast<int>(h), heights - 2), z0 = std::min(static_cast<int>(z), zeniths - 2);
    const Vec3 low = glm::mix(table_[h0][z0], table_[h0][z0 + 1], z - z0);
    const Vec3 high = glm::mix(table_[h0 + 1][z0], table_[h0 + 1][z0 + 1], z - z0);
    return glm::mix(low, high, h - h0);
  }

 private:
  static constexpr int heights = 24, zeniths = 104;
  static constexpr double max_height_m = top_radius_m - ground_radius_m;
  static double height_of(int i) { return max_height_m * i * i / double((heights - 1) * (heights - 1)); }
  static double cosine_of(int i) { return -0.3 + 1.3 * i / double(zeniths - 1); }

  Vec3 integrate(double height_m, double cosine) const {
    const double r = ground_radius_m + height_m;
    const double closest_m = r * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    if (cosine < 0.0 && closest_m < ground_radius_m) {
      // The Earth's edge is soft: the sun's disc sinks behind it over half a degree.
      return Vec3(0.0);
    }
    const double length_m = -r * cosine + std::sqrt(r * r * (cosine * cosine - 1.0) + top_radius_m * top_radius_m);
    constexpr int steps = 24;
    Vec3 depth(0.0);
    for (int i = 0; i < steps; ++i) {
      // Steps grow with the square, because the air is densest at the start.
      const double a = double(i) / steps, b = double(i + 1) / steps;
      const double at_m = length_m * 0.5 * (a * a + b * b), step_m = length_m * (b * b - a * a);
      const double height = std::sqrt(r * r + at_m * at_m + 2.0 * r * at_m * cosine) - ground_radius_m;
      depth += extinction(std::max(0.0, height)) * step_m;
    }
    return glm::exp(-depth);
  }

  double haze_per_m_;
  std::array<std::array<Vec3, zeniths>, heights> table_;
};

/// Single scattering along a ray from the ground, plus an even share of light scattered more than once.
Vec3 scattered(const Air& air, const Vec3& direction, const Vec3& sun, double sun_scale) {
  const double c = glm::dot(direction, sun), g = haze_anisotropy;
  const double rayleigh_phase = 3.0 / (16.0 * pi) * (1.0 + c * c);
  const double haze_phase =
      3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + c * c) / ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * c, 1.5));
  constexpr double even_phase = 1.0 / (4.0 * pi);
  constexpr double again = 0.55;  // Share of scattered light that is scattered once more, ground included.
  const double z = std::max(direction.z, 0.0), r = ground_radius_m + 2.0;
  const double length_m = -r * z + std::sqrt(r * r * (z * z - 1.0) + top_radius_m * top_radius_m);
  constexpr int steps = 28;
  Vec3 sum(0.0), depth(0.0);
  for (int i = 0; i < steps; ++i) {
    const double a = double(i) / steps, b = double(i + 1) / steps;
    const double at_m = length_m * 0.5 * (a * a + b * b), step_m = length_m * (b * b - a * a);
    const Vec3 position = Vec3(0, 0, r) + at_m * direction;
    const double radius = glm::length(position), height = std::max(0.0, radius - ground_radius_m);
    const Vec3 extinction = air.extinction(height);
    const Vec3 sunlight = air.transmittance(height, glm::dot(position, sun) / radius) * solar_constant * sun_scale;
    const Vec3 rayleigh = rayleigh_per_m * Air::rayleigh_density(height);
    const double haze = air.haze_per_m() * Air::haze_density(height);
    const Vec3 source =
        sunlight * (rayleigh * (rayleigh_phase + again * even_phase) + Vec3(haze * (haze_phase + again * even_phase)));
    // Exact for constant air within the step (Hillaire 2015): ∫ S·exp(−βt) dt = S·(1 − exp(−βΔ))/β.
    const Vec3 through = glm::exp(-extinction * step_m);
    sum += glm::exp(-depth) * source * (Vec3(1.0) - through) / extinction;
    depth += extinction * step_m;
  }
  return sum;
}

Vec3 table_direction(std::uint32_t column, std::uint32_t row, const Vec3& sun) {
  const double u = (column + 0.5) / SkyTable::columns, v = (row + 0.5) / SkyTable::rows;
  const double s = 2.0 * v - 1.0, z = s * std::abs(s), level = std::sqrt(std::max(0.0, 1.0 - z * z));
  const double azimuth = std::atan2(sun.y, sun.x) + 2.0 * std::asin(u);
  return {level * std::cos(azimuth), level * std::sin(azimuth), z};
}

/// Strength of the sun relative to a usual one, 1, for an illuminance across its beam. A usual sun gives 80,000 lx from
/// high up and less from further down, through more air: both the true illuminance of a low sun and a default of 80,000
/// lx at any height mean the usual sun.
double share_of_sun(const Air& air, double sine, double illuminance_lux) {
  constexpr double usual_lux = 80000.0, usual_sine = 0.68;
  const double of_high = illuminance_lux / usual_lux;
  const double through =
      luminance(air.transmittance(2.0, std::min(sine, usual_sine))) / luminance(air.transmittance(2.0, usual_sine));
  return std::clamp(std::min(of_high / std::max(through, 1e-6), std::max(1.0, of_high)), 0.0, 1.5);
}

}  // namespace

SkyLight sky_light(const Environment& environment) {
  SkyLight light;
  const double elevation = environment.sun_elevation_rad, azimuth = environment.sun_azimuth_rad;
  // OpenSCENARIO measures azimuth clockwise from north; y points north.
  const Vec3 sun{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth), std::sin(elevation)};
  light.sun_direction = glm::vec3(sun);
  const double visibility_m = std::clamp(environment.visibility_m, 10.0, 200.0e3);
  light.fog_per_m = static_cast<float>(sight::fog_extinction_per_m(visibility_m));
  const double overcast = step_between(0.55, 1.0, environment.cloud_cover);
  light.overcast = static_cast<float>(overcast);
  light.fall_per_m =
      static_cast<float>(sight::fall_extinction_per_m(environment.rain_mm_per_h, environment.temperature_k));
  // Haze near the ground, where visibility is measured, is thicker than in the column above it: a share of it counts.
  const Air air(std::clamp(0.15 * 3.912 / visibility_m, 4.0e-6, 6.0e-5));
  const double sun_scale = share_of_sun(air, sun.z, environment.sun_illuminance_lux);

  const Vec3 direct = solar_constant * sun_scale * air.transmittance(2.0, sun.z) * (1.0 - 0.97 * overcast);
  // Fog is some 150 m deep: it attenuates the sun's beam and scatters its light evenly.
  const double fog_depth = 150.0 * std::max(0.0, 3.912 / visibility_m - 2.0e-4) / std::max(0.15, sun.z);
  const Vec3 sunlight = direct * std::exp(-fog_depth);

  // Clear sky in the table's directions; clouds and fog follow.
  SkyTable& table = light.table;
  table.radiance.resize(SkyTable::columns * SkyTable::rows);
  std::vector<Vec3> clear(table.radiance.size());
  Vec3 sky(0.0);
  double weight = 0.0;
  for (std::uint32_t row = SkyTable::rows / 2; row < SkyTable::rows; ++row)
    for (std::uint32_t column = 0; column < SkyTable::columns; ++column) {
      const Vec3 direction = table_direction(column, row, sun);
      const Vec3 radiance = scattered(air, direction, sun, sun_scale) + night_sky * (1.0 + 0.6 * (1.0 - direction.z));
      clear[row * SkyTable::columns + column] = radiance;
      // Solid angle: dz · dΔ with z = s², Δ = 2·asin u.
      const double s = 2.0 * (row + 0.5) / SkyTable::rows - 1.0, u = (column + 0.5) / SkyTable::columns;
      const double solid_angle = s / std::sqrt(1.0 - u * u);
      sky += radiance * (direction.z * solid_angle);
      weight += direction.z * solid_angle;
    }
  const Vec3 clear_sky_irradiance = sky * (pi / weight);
  // A closed cover transmits about a quarter of the light, without its colour (Kasten and Czeplak 1980).
  const Vec3 clear_total =
      clear_sky_irradiance + solar_constant * sun_scale * air.transmittance(2.0, sun.z) * std::max(0.0, sun.z);
  const Vec3 grey = Vec3(luminance(clear_total)) * Vec3(0.97, 1.0, 1.04);
  const Vec3 towns = towns_on_clouds * overcast;
  const Vec3 sky_irradiance = glm::mix(clear_sky_irradiance, 0.25 * grey, overcast) +
                              (direct - sunlight) * (0.6 * std::max(0.0, sun.z)) + pi * towns;
  const Vec3 albedo = glm::mix(ground_albedo, snow_albedo, std::clamp(environment.snow_cover, 0.0, 1.0));
  const Vec3 ground = albedo * (sky_irradiance + sunlight * std::max(0.0, sun.z)) / pi;
  const double fogged = 1.0 - std::exp(-8.0 * 150.0 * std::max(0.0, 3.912 / visibility_m - 2.0e-4));
  const Vec3 fog_radiance = glm::mix(sky_irradiance, Vec3(luminance(sky_irradiance)), 0.7) / pi;
  for (std::uint32_t row = SkyTable::rows / 2; row < SkyTable::rows; ++row)
    for (std::uint32_t column = 0; column < SkyTable::columns; ++column) {
      const double z = table_direction(column, row, sun).z;
      // CIE overcast sky: L(z) ∝ (1 + 2z)/3, mean weight 7/9.
      const Vec3 cover = 0.25 * grey / pi * ((1.0 + 2.0 * z) / 3.0 * 9.0 / 7.0 * 0.6 + 0.4) + towns;
      Vec3 radiance = glm::mix(clear[row * SkyTable::columns + column], cover, overcast);
      radiance = glm::mix(radiance, fog_radiance, fogged);
      table.radiance[row * SkyTable::columns + column] = glm::vec3(radiance);
    }
  for (std::uint32_t row = 0; row < SkyTable::rows / 2; ++row)
    for (std::uint32_t column = 0; column < SkyTable::columns; ++column) {
      const double z = table_direction(column, row, sun).z;
      const glm::vec3 horizon = table.radiance[SkyTable::rows / 2 * SkyTable::columns + column];
      table.radiance[row * SkyTable::columns + column] =
          glm::mix(horizon, glm::vec3(ground), static_cast<float>(step_between(0.0, 0.25, -z)));
    }

  Vec3 beam = sunlight;
  if (luminance(sunlight) > 0.001) {
    light.light_direction = glm::vec3(sun);
  } else {
    // The moon stands opposite the sun, 40° up.
    const double moon_azimuth = azimuth + pi;
    light.light_direction =
        glm::vec3(std::cos(0.7) * std::sin(moon_azimuth), std::cos(0.7) * std::cos(moon_azimuth), std::sin(0.7));
    beam = moonlight * (1.0 - 0.9 * overcast);
  }
  const double level = luminance(sky_irradiance) + luminance(beam) * std::max(0.0f, light.light_direction.z);
  const Adaptation adapted = adaptation(level * luminance_unit_cdpm2);
  light.light_up = adapted.light_up;
  light.night = adapted.night;
  light.street_lamps = adapted.street_lamps;
  for (glm::vec3& radiance : table.radiance) radiance *= adapted.light_up;
  light.sky_irradiance = glm::vec3(sky_irradiance) * adapted.light_up;
  light.ground_irradiance = glm::vec3(pi * ground) * adapted.light_up;
  light.irradiance = instant::sky_irradiance(table, light.sky_irradiance, glm::vec3(ground) * adapted.light_up);
  const Vec3 half_of_both = 0.5 * (sky_irradiance + pi * ground), level_sun = sunlight * std::cos(elevation);
  light.street_irradiance =
      instant::street_irradiance(table, light.sky_irradiance, glm::vec3(ground) * adapted.light_up,
                                 {street_hidden_share, glm::vec3(upright_albedo * half_of_both / pi) * adapted.light_up,
                                  glm::vec3(upright_albedo * level_sun / pi) * adapted.light_up,
                                  glm::vec3(albedo * sunlight * std::max(0.0, sun.z) / pi) * adapted.light_up});
  light.light_irradiance = glm::vec3(beam) * adapted.light_up;
  // Under a closed cover the exposure stays a little lower.
  light.exposure = static_cast<float>(1.0 - 0.22 * overcast) * adapted.exposure;
  return light;
}

glm::vec3 sky_radiance(const SkyLight& light, const glm::vec3& direction) {
  const glm::vec2 sun(light.sun_direction), level(direction);
  const float lengths = glm::length(sun) * glm::length(level);
  const float cosine = lengths > 1e-6f ? glm::dot(sun, level) / lengths : 1.0f;
  const float u = std::sqrt(std::max(0.0f, 0.5f - 0.5f * cosine));
  const float v = 0.5f + 0.5f * std::copysign(std::sqrt(std::abs(direction.z)), direction.z);
  const float x = std::clamp(u * SkyTable::columns - 0.5f, 0.0f, SkyTable::columns - 1.001f);
  const float y = std::clamp(v * SkyTable::rows - 0.5f, 0.0f, SkyTable::rows - 1.001f);
  const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
  const auto at = [&](std::uint32_t c, std::uint32_t r) { return light.table.radiance[r * SkyTable::columns + c]; };
  return glm::mix(glm::mix(at(column, row), at(column + 1, row), x - column),
                  glm::mix(at(column, row + 1), at(column + 1, row + 1), x - column), y - row);
}

}  // namespace septet::instant
