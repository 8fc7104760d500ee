#include "engine/simulation/effects/effect_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include <glm/geometric.hpp>

#include "engine/effects/debris/piece.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet::simulation {
namespace {

constexpr double standing_reach_m = 7.0;  // From debris to obstacles beside the road.

Vec3 middle_of(const debris::Piece& piece) {
  return 0.5 * (debris::from_eigen(piece.body.position_m.front()) + debris::from_eigen(piece.body.position_m.back()));
}

/// An obstacle as a box; an endless one extends as far up and down as the place needs.
debris::Box box_of(const Obstacle& obstacle, double at_z_m) {
  const double low = std::max(obstacle.low_m, at_z_m - 20.0), high = std::min(obstacle.high_m, at_z_m + 20.0);
  const Vec2 along = obstacle.to_m - obstacle.from_m, middle = 0.5 * (obstacle.from_m + obstacle.to_m);
  debris::Box box;
  box.world_from_box = {Vec3(middle, 0.5 * (low + high)),
                        orientation_from_angles(std::atan2(along.y, along.x), 0.0, 0.0)};
  box.half_size_m = {0.5 * glm::length(along) + obstacle.radius_m, obstacle.radius_m,
                     std::max(0.05, 0.5 * (high - low))};
  box.friction = 0.5;
  return box;
}

}  // namespace

debris::GroundPoint surface_below(const road::RoadNetwork& roads, double friction_factor, double x_m, double y_m,
                                  EffectsState& state) {
  const double column = std::floor(x_m), row = std::floor(y_m);
  if (!(std::abs(column) < 1e9 && std::abs(row) < 1e9)) return {-1e9, {0.0, 0.0, 1.0}, friction_factor};
  const auto key = static_cast<std::uint64_t>(static_cast<std::int64_t>(column) + (1LL << 31)) << 32 |
                   static_cast<std::uint64_t>(static_cast<std::int64_t>(row) + (1LL << 31));
  if (state.surface_memory.size() > 50'000) state.surface_memory.clear();
  const auto [found, fresh] = state.surface_memory.try_emplace(key);
  if (fresh) {
    const auto surface =
        road::surface_at(roads, {column + 0.5, row + 0.5}, state.surface_hint ? &*state.surface_hint : nullptr, 60.0);
    if (surface) {
      found->second = {surface->height_m, surface->normal, 1.0};
      state.surface_hint = surface->position;
    } else {
      found->second.height_m = -1e9;  // Outside the world: debris that falls there is removed.
    }
  }
  debris::GroundPoint point = found->second;
  point.height_m -= ((x_m - column - 0.5) * point.normal.x + (y_m - row - 0.5) * point.normal.y) / point.normal.z;
  point.friction_factor = friction_factor;
  return point;
}

std::vector<debris::Box> vehicle_boxes(const EffectsWorld& world, const debris::State& debris, int& driver_box) {
  driver_box = -1;
  std::vector<Vec3> places;
  for (const debris::Piece& piece : debris.pieces) places.push_back(middle_of(piece));
  for (const debris::Shard& shard : debris.shards)
    if (shard.velocity_mps != Vec3(0.0)) places.push_back(shard.position_m);
  std::vector<debris::Box> boxes;
  for (const Participant& participant : world.participants) {
    const VehicleModel model = shape_of(participant);
    const double reach =
        0.5 * model.length_m + 3.5 + glm::length(participant.velocity_mps) * 2.0 * world.tick_s * effects_step_ticks;
    const Vec3 centre = participant.world_from_vehicle * Vec3(model.centre_x_m(), 0.0, 0.5 * model.height_m);
    const bool near = std::ranges::any_of(places, [&](const Vec3& place) {
      const Vec3 between = place - centre;
      return glm::dot(between, between) < reach * reach;
    });
    if (!near) continue;
    if (participant.id == world.driver) driver_box = static_cast<int>(boxes.size());
    boxes.push_back(body_box(participant));
  }
  return boxes;
}

std::vector<Vec3> moving_places(const debris::State& debris) {
  std::vector<Vec3> places;
  for (const debris::Piece& piece : debris.pieces)
    if (!piece.asleep) places.push_back(middle_of(piece));
  std::size_t moving = 0;  // Shards fly together: every eighth stands for its neighbours.
  for (const debris::Shard& shard : debris.shards)
    if (shard.velocity_mps != Vec3(0.0) && moving++ % 8 == 0) places.push_back(shard.position_m);
  return places;
}

std::vector<debris::Box> standing_boxes(const roadside::Obstacles* obstacles, std::span<const std::uint32_t> gone,
                                        const std::vector<Vec3>& places) {
  if (!obstacles) return {};
  std::vector<std::pair<Obstacle, double>> standing;
  for (const Vec3& place : places)
    for (const Obstacle& obstacle : obstacles->near(Vec2(place), standing_reach_m, gone))
      standing.emplace_back(obstacle, place.z);
  const auto key = [](const auto& entry) {
    return std::tuple(entry.first.run, entry.first.from_m.x, entry.first.from_m.y);
  };
  std::ranges::stable_sort(standing, {}, key);
  // Not std::ranges::unique: clang 14 cannot compile it.
  const auto is_same = [&](const auto& a, const auto& b) { return key(a) == key(b); };
  standing.erase(std::unique(standing.begin(), standing.end(), is_same), standing.end());
  std::vector<debris::Box> boxes;
  boxes.reserve(standing.size());
  for (const auto& [obstacle, z] : standing) boxes.push_back(box_of(obstacle, z));
  return boxes;
}

}  // namespace septet::simulation
