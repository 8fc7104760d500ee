#include "engine/instant/clouds.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/light/clouds.hpp"

namespace septet::instant {
namespace {

/// Number in [0, 1) for a lattice point: an integer hash.
float lattice(std::uint32_t x, std::uint32_t y, std::uint32_t octave) {
  std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ octave * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) / 16777216.0f;
}

/// Adds value noise with `period` cells along each side of the tile.
void add_octave(std::vector<float>& sum, std::uint32_t period, std::uint32_t octave, float weight) {
  std::vector<float> corners(std::size_t{period} * period);
  for (std::uint32_t y = 0; y < period; ++y)
    for (std::uint32_t x = 0; x < period; ++x) corners[y * period + x] = weight * lattice(x, y, octave);
  const auto ease = [](float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); };
  struct Column {
    std::uint32_t left, right;
    float share;
  };
  std::vector<Column> columns(cloud_noise_side);
  for (std::uint32_t x = 0; x < cloud_noise_side; ++x) {
    const float at = static_cast<float>(x * period) / cloud_noise_side;
    const auto left = static_cast<std::uint32_t>(at);
    columns[x] = {left, (left + 1) % period, ease(at - static_cast<float>(left))};
  }
  for (std::uint32_t y = 0; y < cloud_noise_side; ++y) {
    const Column& row = columns[y];  // The tile is square: rows have the form of columns.
    const float *top = &corners[row.left * period], *bottom = &corners[row.right * period];
    for (std::uint32_t x = 0; x < cloud_noise_side; ++x) {
      const Column& column = columns[x];
      const float above = glm::mix(top[column.left], top[column.right], column.share);
      const float below = glm::mix(bottom[column.left], bottom[column.right], column.share);
      sum[y * cloud_noise_side + x] += glm::mix(above, below, row.share);
    }
  }
}

}  // namespace

float cloud_rank(std::span<const std::uint8_t> noise, const glm::vec2& at) {
  const glm::vec2 texel = (at - glm::floor(at)) * float(cloud_noise_side) - 0.5f, low = glm::floor(texel);
  const glm::vec2 share = texel - low;
  const auto read = [&](float x, float y) {
    const auto wrapped = [](float n) {
      return static_cast<std::uint32_t>(n + float(cloud_noise_side)) % cloud_noise_side;
    };
    return static_cast<float>(noise[std::size_t{wrapped(y)} * cloud_noise_side + wrapped(x)]) / 255.0f;
  };
  return glm::mix(glm::mix(read(low.x, low.y), read(low.x + 1.0f, low.y), share.x),
                  glm::mix(read(low.x, low.y + 1.0f), read(low.x + 1.0f, low.y + 1.0f), share.x), share.y);
}

std::vector<std::uint8_t> cloud_noise() {
  std::vector<float> sum(cloud_noise_side * cloud_noise_side, 0.0f);
  std::uint32_t period = 4;
  float weight = 0.5f;
  for (std::uint32_t octave = 0; octave < 6; ++octave, period *= 2, weight *= 0.55f)
    add_octave(sum, period, octave, weight);
  // Each value becomes its rank, so that a share c of the tile lies above 1 − c.
  const auto [low, high] = std::minmax_element(sum.begin(), sum.end());
  constexpr std::size_t bins = 4096;
  const float least = *low, scale = (bins - 1) / (*high - *low);
  const auto bin = [&](float value) { return static_cast<std::size_t>((value - least) * scale); };
  std::vector<std::uint32_t> below(bins + 1, 0);
  for (const float value : sum) ++below[bin(value) + 1];
  for (std::size_t i = 1; i <= bins; ++i) below[i] += below[i - 1];
  std::vector<std::uint8_t> ranks;
  ranks.reserve(sum.size());
  for (const float value : sum)
    ranks.push_back(static_cast<std::uint8_t>(std::uint64_t{255} * below[bin(value)] / sum.size()));
  return ranks;
}

glm::vec2 cloud_drift_m(const Environment& environment, double simulated_time_s) {
  const double drift_m = std::fmod(simulated_time_s * 2.0 * environment.wind_speed_mps, double(light::cloud_tile_m));
  return {-drift_m * std::cos(environment.wind_direction_rad), -drift_m * std::sin(environment.wind_direction_rad)};
}

CloudSeen cloud_seen(std::span<const std::uint8_t> noise, const SkyLight& sky, double cloud_cover,
                     const glm::vec2& drift_m, const glm::vec3& direction) {
  const auto cover = static_cast<float>(cloud_cover);
  if (!(cover > 0.0f) || direction.z <= 0.015f) return {};
  const glm::vec2 place = light::cloud_place(direction, drift_m);
  const float density = light::cloud_density(cloud_rank(noise, place), cover);
  const glm::vec2 sunward = light::cloud_sunward(place, sky.sun_direction);
  const float beyond = light::cloud_density(cloud_rank(noise, sunward), cover);
  const float toward_sun = glm::dot(direction, sky.sun_direction);
  return {light::cloud_radiance(density, beyond, toward_sun, sky.light_irradiance, sky.sky_irradiance),
          light::cloud_hides(density, direction.z, sky.overcast)};
}

}  // namespace septet::instant
