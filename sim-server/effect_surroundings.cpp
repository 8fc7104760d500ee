#include "sim-server/effect_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"

namespace septet::server {
namespace {

constexpr double stretch_m = 8.0;        // Of barrier, as one box.
constexpr double barrier_reach_m = 7.0;  // Across the road.

Vec3 middle_of(const debris::Piece& piece) {
  return 0.5 * (debris::from_eigen(piece.body.position_m.front()) + debris::from_eigen(piece.body.position_m.back()));
}

struct Wall {
  road::RoadIndex road = 0;
  long stretch = 0;
  double t_m = 0.0, thickness_m = 0.0, height_m = 0.0;
  auto key() const { return std::tuple(road, stretch, t_m); }
};

void append_walls(const road::Road& road, const road::RoadPosition& at, long stretch, std::vector<Wall>& walls) {
  const double s = (static_cast<double>(stretch) + 0.5) * stretch_m;
  if (s < 0.0 || s > road.length_m) return;
  const auto add = [&](double t, double thickness, double height) {
    if (std::abs(t - at.t_m) < barrier_reach_m) walls.push_back({at.road, stretch, t, thickness, height});
  };
  for (const road::RoadObject& object : road.objects) {
    if (object.type != "barrier") continue;
    for (const road::ObjectRepeat& repeat : object.repeats) {
      if (s < repeat.s_m || s > repeat.s_m + repeat.length_m) continue;
      const double share = repeat.length_m > 0.0 ? (s - repeat.s_m) / repeat.length_m : 0.0;
      add(std::lerp(repeat.t_start_m, repeat.t_end_m, share), std::max(0.1, std::lerp(repeat.width_start_m, repeat.width_end_m, share)),
          std::lerp(repeat.height_start_m, repeat.height_end_m, share));
    }
  }
  for (const road::RoadStructure& structure : road.structures) {
    if (structure.kind != road::RoadStructure::Kind::tunnel || s < structure.s_m || s > structure.s_m + structure.length_m) continue;
    const road::RoadExtent extent = road::road_extent(road, s);
    for (const double t : {extent.left_t_m + 0.8, extent.right_t_m - 0.8, 0.0}) add(t, t == 0.0 ? 0.7 : 0.6, 6.0);
  }
}

debris::Box box_of(const road::RoadNetwork& roads, const Wall& wall) {
  const double s = (static_cast<double>(wall.stretch) + 0.5) * stretch_m;
  debris::Box box;
  box.world_from_box = road::world_from_road(road::evaluate(roads, {wall.road, s, wall.t_m}));
  box.world_from_box.position_m.z += 0.5 * wall.height_m;
  box.half_size_m = {0.5 * stretch_m + 0.05, 0.5 * wall.thickness_m, 0.5 * wall.height_m};
  box.friction = 0.5;
  return box;
}

double clearance_m(ParticipantKind kind) {
  switch (kind) {
    case ParticipantKind::lorry:
    case ParticipantKind::bus: return 0.45;
    case ParticipantKind::motorcycle:
    case ParticipantKind::bicycle:
    case ParticipantKind::pedestrian: return 0.05;
    default: return 0.20;
  }
}

/// From the bonnet's edge to where the roof begins, as shares of the height and the length (engine/scenery/car_body.cpp).
struct Slope {
  double edge_height, roof_begins;
};
std::optional<Slope> front_slope(ParticipantKind kind) {
  switch (kind) {
    case ParticipantKind::car: return Slope{0.55, 0.43};
    case ParticipantKind::van:
    case ParticipantKind::ambulance: return Slope{0.48, 0.26};
    default: return std::nullopt;
  }
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
    const auto surface = road::surface_at(roads, {column + 0.5, row + 0.5}, state.surface_hint ? &*state.surface_hint : nullptr, 60.0);
    if (surface) {
      found->second = {surface->height_m, surface->normal, 1.0};
      state.surface_hint = surface->position;
    } else {
      found->second.height_m = -1e9;  // Off the world: what falls there is gone.
    }
  }
  debris::GroundPoint point = found->second;
  point.height_m -= ((x_m - column - 0.5) * point.normal.x + (y_m - row - 0.5) * point.normal.y) / point.normal.z;
  point.friction_factor = friction_factor;
  return point;
}

debris::Box body_box(const Participant& participant) {
  const VehicleModel& model = vehicle_models()[participant.model];
  const double low = clearance_m(model.kind), high = model.height_m;
  const Vec3 centre(model.centre_x_m(), 0.0, 0.5 * (low + high));
  const Vec3 arm = participant.world_from_vehicle.orientation * centre;
  debris::Box box;
  box.world_from_box = {participant.world_from_vehicle.position_m + arm, participant.world_from_vehicle.orientation};
  box.half_size_m = {0.5 * model.length_m, 0.5 * model.width_m, 0.5 * (high - low)};
  if (const auto slope = front_slope(model.kind)) {
    const double rise = (1.0 - slope->edge_height) * model.height_m, run = slope->roof_begins * model.length_m;
    const Vec3 normal = glm::normalize(Vec3(rise, 0.0, run));
    const Vec3 roof_begins(box.half_size_m.x - run, 0.0, box.half_size_m.z);
    box.cuts.push_back({normal, glm::dot(normal, roof_begins)});
  }
  box.velocity_mps = participant.velocity_mps + glm::cross(participant.angular_velocity_radps, arm);
  box.angular_velocity_radps = participant.angular_velocity_radps;
  return box;
}

std::vector<debris::Box> vehicle_boxes(const EffectsWorld& world, const debris::State& debris, int& driver_box) {
  driver_box = -1;
  std::vector<Vec3> places;
  for (const debris::Piece& piece : debris.pieces) places.push_back(middle_of(piece));
  for (const debris::Shard& shard : debris.shards)
    if (shard.velocity_mps != Vec3(0.0)) places.push_back(shard.position_m);
  std::vector<debris::Box> boxes;
  for (const Participant& participant : world.participants) {
    const VehicleModel& model = vehicle_models()[participant.model];
    const double reach = 0.5 * model.length_m + 3.5 + glm::length(participant.velocity_mps) * 2.0 * world.tick_s * effects_step_ticks;
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

std::vector<debris::Box> barrier_boxes(const road::RoadNetwork& roads, const std::vector<Vec3>& places, const road::RoadPosition* hint) {
  std::vector<Wall> walls;
  for (const Vec3& place : places) {
    const auto at = road::locate(roads, {place.x, place.y}, hint, 30.0);
    if (!at) continue;
    const auto stretch = static_cast<long>(std::floor(at->position.s_m / stretch_m));
    for (const long k : {stretch - 1, stretch, stretch + 1}) append_walls(roads.roads[at->position.road], at->position, k, walls);
  }
  std::ranges::sort(walls, {}, &Wall::key);
  const auto repeated = std::unique(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.key() == b.key(); });
  walls.erase(repeated, walls.end());
  std::vector<debris::Box> boxes;
  for (const Wall& wall : walls) boxes.push_back(box_of(roads, wall));
  return boxes;
}

}  // namespace septet::server
