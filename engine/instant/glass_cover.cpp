#include "engine/instant/glass_cover.hpp"

#include <algorithm>
#include <cmath>

#include <glm/vec2.hpp>

#include "engine/instant/clouds.hpp"
#include "engine/light/crack.hpp"
#include "engine/light/frost.hpp"

namespace septet::instant {

float frost_hides(std::span<const std::uint8_t> noise, const glm::vec3& rest_m) {
  if (!(rest_m.z >= light::least_frost_kgpm2)) return 0.0f;
  const glm::vec2 place(rest_m);
  const float grain = cloud_rank(noise, place * light::frost_noise_per_m);
  return light::frost_hides(light::feather_mass(light::feather_at(place), grain, 1.0f, 1.0f), rest_m.z);
}

CrackSeen crack_seen(std::span<const std::uint8_t> noise, const glm::vec3& rest_m, const glm::vec3& normal) {
  CrackSeen seen;
  seen.crushed = rest_m.z > 0.5f;
  if (seen.crushed) {
    const glm::vec2 grain = light::crushed_grain(glm::vec2(rest_m));
    seen.hides = light::crushed_hides(grain, rest_m.z);
    seen.albedo = std::min(0.5f + 3.0f * grain.y * grain.y, 0.95f);
    seen.normal = normal;
    return seen;
  }
  seen.normal = light::uneven_crack(normal, rest_m.x);
  if (std::abs(rest_m.y) > light::crack_width) return seen;
  seen.hides = light::crack_hides(cloud_rank(noise, light::crack_noise_place(seen.normal, rest_m.x)));
  return seen;
}

}  // namespace septet::instant
