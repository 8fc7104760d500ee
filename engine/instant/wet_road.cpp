#include "engine/instant/wet_road.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/instant/clouds.hpp"
#include "engine/light/wet_road.hpp"

namespace septet::instant {
namespace {

constexpr double wheelbase_m = 2.7, track_m = 1.5;

bool has_wheels(const scene::Prototype& prototype) {
  return std::ranges::any_of(prototype.parts, [](const scene::Instance& part) {
    return part.role >= scene::PartRole::wheel_front_left && part.role <= scene::PartRole::wheel_rear_right;
  });
}

/// Plane through the wheels' points of contact, whatever their springs' travel.
RoadPlane below(const DrawnParticipant& vehicle) {
  const auto& lift = vehicle.wheel_lift_m;
  const double front = 0.5 * (lift[0] + lift[1]), rear = 0.5 * (lift[2] + lift[3]);
  const double left = 0.5 * (lift[0] + lift[2]), right = 0.5 * (lift[1] + lift[3]);
  const Vec3 up(-(front - rear) / wheelbase_m, -(left - right) / track_m, 1.0);
  const RigidTransform& place = vehicle.world_from_vehicle;
  return {place * Vec3(0.0, 0.0, rear), glm::vec3(place.orientation * glm::normalize(up))};
}

/// Number in [0, 1) for a ring; `what` selects one of its properties.
double chance(std::uint32_t ring, std::uint32_t life, std::uint32_t what) {
  std::uint32_t h = ring * 0x9e3779b1u ^ life * 0x85ebca77u ^ what * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<double>((h ^ (h >> 15)) >> 8) / 16777216.0;
}

}  // namespace

std::optional<RoadPlane> road_below(std::span<const DrawnParticipant> participants,
                                    std::span<const scene::Prototype> prototypes, const Vec3& eye_m) {
  constexpr double furthest_m = 80.0;
  const DrawnParticipant* nearest = nullptr;
  double least = furthest_m * furthest_m;
  for (const DrawnParticipant& participant : participants) {
    if (participant.prototype >= prototypes.size() || !has_wheels(prototypes[participant.prototype])) continue;
    const Vec3 away = participant.world_from_vehicle.position_m - eye_m;
    const double square = away.x * away.x + away.y * away.y;
    if (!(square < least) || !(away.z < -0.2)) continue;
    least = square;
    nearest = &participant;
  }
  if (!nearest) return std::nullopt;
  const RoadPlane plane = below(*nearest);
  // Vehicles on their side do not give the road's plane.
  if (!(plane.normal.z > 0.9f) || !(glm::dot(glm::vec3(eye_m - plane.point_m), plane.normal) > 0.2f))
    return std::nullopt;
  return plane;
}

float puddle(std::span<const std::uint8_t> noise, double x_m, double y_m, float rut, float wetness) {
  const float share = light::puddle_share(wetness);
  if (share <= 0.0f) return 0.0f;
  const double across = x_m / light::puddle_tile_m, along = y_m / light::puddle_tile_m;
  const glm::vec2 at(across - std::floor(across), along - std::floor(along));
  return light::puddle_at(cloud_rank(noise, at), rut, share);
}

std::vector<glm::vec2> ripple_slopes(double rain_mm_per_h, double simulated_time_s) {
  constexpr double life_s = 0.5, speed_mps = 0.23, wave_m = 0.03, height_m = 0.0006, train_m = 0.03;
  constexpr double most_rain_mm_per_h = 200.0, tile_m = light::ripple_tile_m;
  std::vector<glm::vec2> slopes(std::size_t{ripple_side} * ripple_side, glm::vec2(0.0f));
  if (!(rain_mm_per_h > 0.0) || !std::isfinite(simulated_time_s)) return slopes;
  // Drops above D fall at a rate of N0 v/Λ·exp(−ΛD) on each square metre: N0 = 8000 /(m³·mm), v about 8 m/s.
  const double rain = std::min(rain_mm_per_h, most_rain_mm_per_h), per_mm = 4.1 * std::pow(rain, -0.21);
  const double per_m2_s = 8000.0 * 8.0 / per_mm * std::exp(-2.0 * per_mm);
  const double wanted = per_m2_s * life_s * tile_m * tile_m;
  const auto rings = static_cast<std::uint32_t>(std::min(400.0, std::ceil(wanted)));
  constexpr double texel_m = tile_m / ripple_side;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const double lives = simulated_time_s / life_s + chance(ring, 0, 0);
    const double whole = std::floor(lives), age_s = (lives - whole) * life_s;
    const auto life = static_cast<std::uint32_t>(std::fmod(std::fmod(whole, 65536.0) + 65536.0, 65536.0));
    const glm::dvec2 middle(chance(ring, life, 1) * ripple_side, chance(ring, life, 2) * ripple_side);
    const double radius_m = speed_mps * age_s, fade = (1.0 - age_s / life_s) * std::min(1.0, age_s / 0.04);
    const double reach = (radius_m + train_m) / texel_m;
    const auto from = [&](double at) { return static_cast<int>(std::floor(at - reach)); };
    const auto to = [&](double at) { return static_cast<int>(std::ceil(at + reach)); };
    for (int y = from(middle.y); y <= to(middle.y); ++y)
      for (int x = from(middle.x); x <= to(middle.x); ++x) {
        const glm::dvec2 away = (glm::dvec2(x + 0.5, y + 0.5) - middle) * texel_m;
        const double distance_m = glm::length(away), behind_m = distance_m - radius_m;
        if (distance_m < 1e-6 || std::abs(behind_m) >= train_m) continue;
        const double envelope = 0.5 + 0.5 * std::cos(std::numbers::pi * behind_m / train_m);
        const double phase = 2.0 * std::numbers::pi * behind_m / wave_m;
        const double slope = height_m * 2.0 * std::numbers::pi / wave_m * fade * envelope * std::cos(phase);
        constexpr int side = ripple_side;
        const auto column = static_cast<std::size_t>((x % side + side) % side),
                   row = static_cast<std::size_t>((y % side + side) % side);
        slopes[row * ripple_side + column] += glm::vec2(away * (slope / distance_m));
      }
  }
  return slopes;
}

}  // namespace septet::instant
