#include "car-io/simulated_driver/driver_view.hpp"

#include <cmath>
#include <cstdlib>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"

namespace septet::car_io {
namespace {

constexpr double sight_m = 250.0;
constexpr double body_over_line_m =
    0.2;  ///< From here on a vehicle counts in the lane beside, too.

Vec2 ground_position(const Participant& participant) {
  return Vec2(participant.world_from_vehicle.position_m);
}

/// Offset from the lane's centre to the driver's left, for an offset towards +t.
double to_the_left(const traffic::CorridorPiece& piece, double towards_t_m) {
  return piece.along_s ? towards_t_m : -towards_t_m;
}

}  // namespace

bool lanes_grow_to_the_right(const traffic::CorridorPiece& piece) {
  return (piece.side < 0) == piece.along_s;
}

std::optional<traffic::Corridor> find_corridor(const road::RoadNetwork& network,
                                               const Snapshot& snapshot) {
  const Participant* body = find_participant(snapshot, snapshot.driver_car.participant);
  if (!body) return std::nullopt;
  const auto location = road::locate(network, ground_position(*body));
  if (!location || location->lanes.lane == 0) return std::nullopt;
  return traffic::build_corridor(
      network, {location->position.road, location->lanes.lane, location->position.s_m, 0.0});
}

std::optional<OwnPlace> see_own_place(const road::RoadNetwork& network,
                                      const traffic::Corridor& corridor, const Snapshot& snapshot,
                                      const std::optional<road::RoadPosition>& hint) {
  const Participant* body = find_participant(snapshot, snapshot.driver_car.participant);
  if (!body) return std::nullopt;
  const auto location = road::locate(network, ground_position(*body), hint ? &*hint : nullptr);
  if (!location || location->lanes.lane == 0) return std::nullopt;
  const auto x_m = traffic::x_of(network, corridor, location->position, location->lanes.lane);
  if (!x_m) return std::nullopt;
  const VehicleModel& model = vehicle_models()[body->model];
  const Vec3 forward = body->world_from_vehicle.orientation * Vec3(1, 0, 0);
  OwnPlace own;
  own.position = location->position;
  own.x_m = *x_m;
  own.lane = std::abs(location->lanes.lane);
  own.offset_m = to_the_left(traffic::piece_at(corridor, *x_m), location->lanes.offset_m);
  own.speed_mps = snapshot.driver_car.speed_mps;
  own.acceleration_mps2 = glm::dot(body->acceleration_mps2, forward);
  own.front_m = model.front_m();
  own.rear_m = model.rear_overhang_m;
  return own;
}

std::vector<SeenVehicle> see_vehicles(const road::RoadNetwork& network,
                                      const traffic::Corridor& corridor, const Snapshot& snapshot,
                                      const OwnPlace& own) {
  std::vector<SeenVehicle> seen;
  const Participant* self = find_participant(snapshot, snapshot.driver_car.participant);
  if (!self) return seen;
  const Vec2 here = ground_position(*self);
  // The search along the road begins where another would be if it ran straight on.
  const double ahead_along_s = traffic::piece_at(corridor, own.x_m).along_s ? 1.0 : -1.0;
  const Vec2 forward = ahead_along_s * Vec2(self->world_from_vehicle.orientation * Vec3(1, 0, 0));
  for (const Participant& other : snapshot.participants) {
    if (other.id == self->id || glm::distance(ground_position(other), here) > sight_m) continue;
    road::RoadPosition hint = own.position;
    hint.s_m += glm::dot(ground_position(other) - here, forward);
    const auto location = road::locate(network, ground_position(other), &hint);
    if (!location || location->lanes.lane == 0 || location->lanes.outside_m > 0.0) continue;
    const auto x_m = traffic::x_of(network, corridor, location->position, location->lanes.lane);
    if (!x_m) continue;
    const VehicleModel& model = vehicle_models()[other.model];
    const traffic::CorridorPiece& piece = traffic::piece_at(corridor, *x_m);
    SeenVehicle vehicle;
    vehicle.id = other.id;
    vehicle.lane = std::abs(location->lanes.lane);
    const double left_m = to_the_left(piece, location->lanes.offset_m);
    const double lane_m = road::lane_width_m(network, location->position.road, location->lanes.lane,
                                             location->position.s_m);
    if (std::abs(left_m) + model.width_m / 2.0 > lane_m / 2.0 + body_over_line_m)
      vehicle.also_in_lane =
          vehicle.lane + ((left_m > 0.0) == lanes_grow_to_the_right(piece) ? -1 : 1);
    const double ahead_m = traffic::distance_m(corridor, own.x_m, *x_m);
    vehicle.is_ahead = ahead_m + model.centre_x_m() > (own.front_m - own.rear_m) / 2.0;
    vehicle.gap_m = vehicle.is_ahead ? ahead_m - model.rear_overhang_m - own.front_m
                                     : -ahead_m - model.front_m() - own.rear_m;
    vehicle.speed_mps =
        glm::dot(other.velocity_mps, other.world_from_vehicle.orientation * Vec3(1, 0, 0));
    vehicle.is_ambulance =
        model.kind == ParticipantKind::ambulance && other.lamps.has(Lamp::beacon);
    seen.push_back(vehicle);
  }
  return seen;
}

}  // namespace septet::car_io
