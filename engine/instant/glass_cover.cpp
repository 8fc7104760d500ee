#include "engine/instant/glass_cover.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/instant/clouds.hpp"

namespace septet::instant {
namespace {

constexpr float frost_m2pkg = 16.0f;  // 3/(2 ρ r) of grains of 0.1 mm.
constexpr float least_kgpm2 = 5e-5f;  // So little hides less than a code.
constexpr float two_pi = 2.0f * std::numbers::pi_v<float>;

glm::vec2 random_place(const glm::vec2& cell) {
  const auto of = [](float x, std::uint32_t times) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(x) + 4096) * times;
  };
  const std::uint32_t h = (of(cell.x, 1597334677u) ^ of(cell.y, 3812015801u)) * 1597334677u;
  return glm::vec2(static_cast<float>(h >> 16), static_cast<float>((h * 747796405u) >> 16)) / 65536.0f;
}

/// How much of the frost's mass lies there; 0.79 on average.
float feathers(std::span<const std::uint8_t> noise, const glm::vec2& place) {
  constexpr float cell_m = 0.034f;
  const glm::vec2 cell = glm::floor(place / cell_m - 0.5f);
  float nearest = 1e9f, second = 1e9f;
  glm::vec2 feather(0.0f);
  for (int k = 0; k < 4; ++k) {
    const glm::vec2 at = cell + glm::vec2(k & 1, k >> 1), germ = random_place(at);
    const glm::vec2 off = place - (at + 0.15f + 0.7f * germ) * cell_m,
                    way = glm::normalize(glm::fract(germ * 37.0f) - 0.5f + 1e-4f);
    const glm::vec2 own(glm::dot(off, way), glm::dot(off, glm::vec2(-way.y, way.x)));
    const float far = std::abs(own.x) * 0.55f + std::abs(own.y);
    second = std::min(second, std::max(far, nearest));
    if (far < nearest) feather = own, nearest = far;
  }
  const float aside = std::abs(feather.y), along = feather.x - 0.577f * aside;
  const float grain = cloud_rank(noise, place * 7.0f), wander = 6.0f * grain;
  const float barbs = 0.5f + 0.5f * std::cos(along * (two_pi / 0.0034f) + wander);
  const float twigs = 0.5f + 0.5f * std::cos((aside * 1.155f + 0.5f * along) * (two_pi / 0.0013f) + 2.0f * wander);
  const float stem = std::exp(-aside * aside / (0.0007f * 0.0007f));
  const float seam = glm::smoothstep(0.0f, 0.004f, second - nearest);
  const float lies = 0.3f + 1.1f * (barbs * barbs * barbs - 0.3125f) * (0.7f + 0.6f * twigs) + 0.8f * stem + grain;
  return std::max(lies * (0.55f + 0.45f * seam), 0.0f);
}

}  // namespace

float frost_hides(std::span<const std::uint8_t> noise, const glm::vec3& rest_m) {
  if (!(rest_m.z >= least_kgpm2)) return 0.0f;
  return 1.0f - std::exp(-frost_m2pkg * rest_m.z * feathers(noise, glm::vec2(rest_m)));
}

CrackSeen crack_seen(std::span<const std::uint8_t> noise, const glm::vec3& rest_m, const glm::vec3& normal) {
  CrackSeen seen;
  if (rest_m.z > 0.5f) {  // Close in the middle, ragged outwards.
    const glm::vec2 grain = random_place(glm::floor(glm::vec2(rest_m) / 0.0014f));
    seen.crushed = true;
    seen.hides = std::clamp(2.5f - rest_m.z - 0.9f * grain.x, 0.0f, 1.0f) * 0.9f;
    seen.albedo = std::min(0.5f + 3.0f * grain.y * grain.y, 0.95f);
    seen.normal = normal;
    return seen;
  }
  const glm::vec3 uneven(std::cos(rest_m.x * 61.0f), std::sin(rest_m.x * 47.0f), std::cos(rest_m.x * 83.0f + 1.0f));
  seen.normal = glm::normalize(normal + 0.25f * uneven);
  if (std::abs(rest_m.y) > 1.0f / 3.0f) return seen;  // A crack is a third as wide as its strip.
  const float touches =
      glm::smoothstep(0.15f, 0.5f, cloud_rank(noise, glm::vec2(rest_m.x * 3.0f + seen.normal.x, seen.normal.y)));
  seen.hides = glm::mix(0.4f, 0.95f, touches);
  return seen;
}

}  // namespace septet::instant
