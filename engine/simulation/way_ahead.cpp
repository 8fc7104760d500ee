#include "engine/simulation/way_ahead.hpp"

#include <algorithm>
#include <cmath>

#include "engine/effects/debris/piece.hpp"
#include "engine/road/road_position.hpp"
#include "engine/scenario/run/resolve_position.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet::simulation {
namespace {

constexpr double sight_m = 160.0;  // Braking distance from 130 km/h with 4 m/s².
constexpr double room_beside_m = 0.1;
constexpr double over_debris_mps = 3.0, least_debris_m = 0.3;

/// The path ahead, seen from the entity's rear axle along its lane: the bend is that of the lane here, the width covers
/// the body between its place across the lane and the one to which its script moves it.
struct Way {
  RigidTransform world_from_way;
  double curvature_per_m = 0.0;
  double right_m = 0.0, left_m = 0.0, front_m = 0.0, middle_m = 0.0;
  std::optional<scenario::InTheWay> nearest;
  double nearest_needs_mps2 = 0.0;

  /// Forward along the path, and to the left of it.
  Vec2 along(const Vec3& world_m) const {
    const Vec3 seen = glm::conjugate(world_from_way.orientation) * (world_m - world_from_way.position_m);
    return {seen.x, seen.y - 0.5 * curvature_per_m * seen.x * seen.x};
  }
  bool holds(const Vec2& middle, const Vec2& half_m) const {
    return middle.x > middle_m && middle.x - half_m.x < front_m + sight_m &&
           middle.y + half_m.y + room_beside_m > right_m && middle.y - half_m.y - room_beside_m < left_m;
  }
  void mind(double gap_m, double speed_mps, double own_mps) {
    const double closing_mps = std::max(0.0, own_mps - speed_mps),
                 needs_mps2 = closing_mps * closing_mps / std::max(0.5, 2.0 * gap_m) + 1.0 / std::max(gap_m, 0.5);
    if (nearest && needs_mps2 <= nearest_needs_mps2) return;
    nearest = {std::max(0.0, gap_m), speed_mps};
    nearest_needs_mps2 = needs_mps2;
  }
};

/// `moves_over`: the path leads to the target of the entity's lateral action.
Way way_of(const Model& model, const scenario::EntityState& entity, const VehicleModel& body, bool moves_over) {
  Way way;
  way.world_from_way = scenario::lane_pose(model.roads, entity.lane, entity.along_s, 0.0, 0.0);
  const double side = entity.along_s ? 1.0 : -1.0;
  way.curvature_per_m = side * road::evaluate_lane(model.roads, entity.lane).road.curvature_per_m;
  const auto& control = entity.lateral_control;
  const double goes_left_m = control.active && moves_over ? side * (control.transition.to - entity.lane.offset_m) : 0.0;
  way.right_m = std::min(0.0, goes_left_m) - 0.5 * body.width_m;
  way.left_m = std::max(0.0, goes_left_m) + 0.5 * body.width_m;
  way.front_m = body.front_m();
  way.middle_m = body.centre_x_m();
  return way;
}

/// A body as a box along and across the path: its middle, and half its extent.
struct Seen {
  Vec2 middle{0.0}, half_m{0.0};
};

Seen seen_on(const Way& way, const Participant& other, double ahead_m) {
  const VehicleModel body = shape_of(other);
  const Vec3 heads = other.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  const Vec3 seen = glm::conjugate(way.world_from_way.orientation) * heads;
  // The lane bends: its direction there is not the one here.
  const double bend = way.curvature_per_m * ahead_m;
  const double across = std::abs(seen.y - bend * seen.x), along = std::abs(seen.x);
  return {
      way.along(other.world_from_vehicle * Vec3(body.centre_x_m(), 0.0, 0.0)),
      {0.5 * (along * body.length_m + across * body.width_m), 0.5 * (across * body.length_m + along * body.width_m)}};
}

/// True where a participant is beside the body in the widened path, or one of the two would have to brake for the other
/// harder than people like.
bool is_taken_beside(const std::vector<Participant>& participants, ParticipantId self, double own_mps,
                     const VehicleModel& body, const Way& way) {
  const double half_width_m = 0.5 * body.width_m, rear_m = 0.5 * body.length_m;
  const double from_m = way.right_m < -half_width_m ? way.right_m : half_width_m;
  const double to_m = way.right_m < -half_width_m ? -half_width_m : way.left_m;
  constexpr double reach_m = 120.0, least_gap_m = 4.0, braking_mps2 = 2.0;
  const Vec3 forward = way.world_from_way.orientation * Vec3(1.0, 0.0, 0.0);
  return std::ranges::any_of(participants, [&](const Participant& other) {
    const Vec3 away = other.world_from_vehicle.position_m - way.world_from_way.position_m;
    const double ahead_m = glm::dot(away, forward);
    if (other.id == self || std::abs(ahead_m) > reach_m || std::abs(away.z) > 4.0) return false;
    const Seen seen = seen_on(way, other, ahead_m);
    if (seen.middle.y + seen.half_m.y <= from_m || seen.middle.y - seen.half_m.y >= to_m) return false;
    const double mps = glm::dot(other.velocity_mps, forward);
    const bool is_ahead = seen.middle.x > way.middle_m;
    const double gap_m = is_ahead ? seen.middle.x - seen.half_m.x - way.front_m
                                  : way.middle_m - rear_m - (seen.middle.x + seen.half_m.x);
    const double closing_mps = std::max(0.0, is_ahead ? own_mps - mps : mps - own_mps);
    return gap_m < least_gap_m + closing_mps * closing_mps / (2.0 * braking_mps2);
  });
}

void look_at_vehicles(const std::vector<Participant>& participants, ParticipantId self, double own_mps, Way& way) {
  const Vec3 forward = way.world_from_way.orientation * Vec3(1.0, 0.0, 0.0);
  for (const Participant& other : participants) {
    const Vec3 away = other.world_from_vehicle.position_m - way.world_from_way.position_m;
    const double ahead_m = glm::dot(away, forward);
    if (other.id == self || ahead_m < -20.0 || ahead_m > sight_m + 20.0 || std::abs(away.z) > 4.0) continue;
    const auto [middle, half_m] = seen_on(way, other, ahead_m);
    if (way.holds(middle, half_m))
      way.mind(middle.x - half_m.x - way.front_m, std::max(0.0, glm::dot(other.velocity_mps, forward)), own_mps);
  }
}

void look_at_debris(const debris::State& debris, double own_mps, Way& way) {
  for (const debris::Piece& piece : debris.pieces) {
    Vec2 low(1e9), high(-1e9);
    for (const auto& node : piece.body.position_m) {
      const Vec2 at = way.along({node.x(), node.y(), node.z()});
      low = glm::min(low, at), high = glm::max(high, at);
    }
    const Vec2 half_m = 0.5 * (high - low);
    if (std::max(half_m.x, half_m.y) < 0.5 * least_debris_m || !way.holds(low + half_m, half_m)) continue;
    way.mind(std::max(3.0, low.x - way.front_m), over_debris_mps, own_mps);
  }
}

}  // namespace

void look_ahead(const Model& model, const std::vector<Participant>& participants, const EffectsState& effects,
                scenario::ScenarioState& state) {
  for (scenario::EntityIndex i = 0; i < state.entities.size(); ++i) {
    const scenario::EntityState& entity = state.entities[i];
    const bool hurries = entity.lamps.has(Lamp::beacon) || entity.lamps.has(Lamp::siren);
    if (!hurries || !entity.active || entity.external || !entity.on_road ||
        !(entity.speed_mps + entity.held_back_mps > 0.0)) {
      scenario::mind_the_way(i, std::nullopt, false, state);
      continue;
    }
    const VehicleModel& body = vehicle_models()[model.scenario.entities[i].model];
    const ParticipantId self = first_scripted_participant + i;
    Way way = way_of(model, entity, body, true);
    const bool is_taken =
        scenario::has_yet_to_move_aside(entity) && is_taken_beside(participants, self, entity.speed_mps, body, way);
    if (is_taken) way = way_of(model, entity, body, false);
    look_at_vehicles(participants, self, entity.speed_mps, way);
    look_at_debris(effects.debris, entity.speed_mps, way);
    scenario::mind_the_way(i, way.nearest, is_taken, state);
  }
}

}  // namespace septet::simulation
