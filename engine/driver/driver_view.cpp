#include "engine/driver/driver_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/road/body_lanes.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/seen_participants.hpp"

namespace septet::driver {
namespace {

constexpr double acceleration_seen_in_s = 0.5;
constexpr double gap_step_m = 60.0;          ///< Gaps are those along the lane, as well as eyes measure them.
constexpr double foresight_s = 1.0;          ///< A vehicle that crosses a line is noticed this much earlier.
constexpr double crossing_foreseen_s = 4.0;  ///< The way of one who comes across is thought on for this long.
constexpr double would_brake_mps2 =
    4.0;                            ///< A vehicle that can still stop like this before the lanes is taken to do so.
constexpr double across_cos = 0.7;  ///< Who moves at more than 45° to the road comes across.

Vec2 ground_position(const Participant& participant) { return Vec2(participant.world_from_vehicle.position_m); }

/// Along the corridor; 0 off it.
double x_on(const traffic::Corridor& corridor, const road::RoadPosition& place) {
  const traffic::CorridorPiece* piece = traffic::piece_of(corridor, place);
  return piece ? traffic::x_on_piece(*piece, place.s_m) : 0.0;
}

/// Place on the corridor, where other roads of a junction overlap: the one nearest along it to the expected place.
std::optional<road::Location> on_corridor(const road::RoadNetwork& network, const traffic::Corridor& corridor,
                                          const std::optional<road::Location>& found, const Vec2& place,
                                          double expected_x_m) {
  const auto x_of = [&](const road::Location& location) {
    return traffic::x_of(network, corridor, location.position, location.lanes.lane);
  };
  if (!found || x_of(*found) || network.roads[found->position.road].junction == road::no_index) return found;
  std::optional<road::Location> nearest;
  double least_m = 0.0;
  for (const road::Location& location : road::roads_holding(network, place)) {
    const auto x_m = x_of(location);
    if (!x_m || location.lanes.lane == 0) continue;
    const double off_m = std::abs(traffic::distance_m(corridor, expected_x_m, *x_m));
    if (nearest && off_m >= least_m) continue;
    nearest = location;
    least_m = off_m;
  }
  return nearest ? nearest : found;
}

/// Offset from the lane's centre to the driver's left, for an offset towards +t.
double to_the_left(const traffic::CorridorPiece& piece, double towards_t_m) {
  return piece.along_s ? towards_t_m : -towards_t_m;
}

/// Across the road towards +t.
double sideways_mps(const road::RoadNetwork& network, const road::RoadPosition& position, const Participant& vehicle) {
  const double along_rad = road::evaluate(network, position).heading_rad;
  return glm::dot(Vec2(vehicle.velocity_mps), Vec2(-std::sin(along_rad), std::cos(along_rad)));
}

/// The lanes that a vehicle lies over now or, moving sideways as it does, soon.
road::LaneRange lanes_taken(const road::RoadNetwork& network, const road::RoadPosition& position,
                            const Participant& vehicle, const VehicleModel& model, double sideways_mps) {
  const Vec3 heads = vehicle.world_from_vehicle.orientation * Vec3(1, 0, 0);
  const road::BodyOutline body{std::atan2(heads.y, heads.x), model.rear_overhang_m, model.front_m(), model.width_m};
  const road::LaneRange now = road::drivable_lanes_under(network, position, body);
  if (std::abs(sideways_mps) < 0.1) return now;
  road::RoadPosition soon_at = position;
  soon_at.t_m += foresight_s * sideways_mps;
  const road::LaneRange soon = road::drivable_lanes_under(network, soon_at, body);
  if (now.empty() || soon.empty()) return now.empty() ? soon : now;
  return {std::min(now.lowest, soon.lowest), std::max(now.highest, soon.highest)};
}

}  // namespace

bool lanes_grow_to_the_right(const traffic::CorridorPiece& piece) { return (piece.side < 0) == piece.along_s; }

std::optional<traffic::Corridor> find_corridor(const road::RoadNetwork& network, const Snapshot& snapshot) {
  const Participant* body = find_participant(snapshot, snapshot.driver_car.participant);
  if (!body) return std::nullopt;
  const auto location = road::locate(network, ground_position(*body));
  if (!location || location->lanes.lane == 0) return std::nullopt;
  return traffic::build_corridor(network, {location->position.road, location->lanes.lane, location->position.s_m, 0.0});
}

std::optional<OwnPlace> see_own_place(const road::RoadNetwork& network, const traffic::Corridor& corridor,
                                      const Snapshot& snapshot, const std::optional<road::RoadPosition>& hint) {
  const Participant* body = find_participant(snapshot, snapshot.driver_car.participant);
  if (!body) return std::nullopt;
  const double was_m = hint ? x_on(corridor, *hint) : 0.0;
  const Vec2 here = ground_position(*body);
  const auto location =
      on_corridor(network, corridor, road::locate(network, here, hint ? &*hint : nullptr), here, was_m);
  if (!location || location->lanes.lane == 0) return std::nullopt;
  const auto x_m = traffic::x_of(network, corridor, location->position, location->lanes.lane);
  if (!x_m) return std::nullopt;
  const VehicleModel& model = vehicle_models()[body->model];
  const Vec3 forward = body->world_from_vehicle.orientation * Vec3(1, 0, 0);
  OwnPlace own;
  own.position = location->position;
  own.x_m = *x_m;
  own.lane = std::abs(location->lanes.lane) + traffic::piece_at(corridor, *x_m).lane_shift;
  own.offset_m = to_the_left(traffic::piece_at(corridor, *x_m), location->lanes.offset_m);
  own.across_m = to_the_left(traffic::piece_at(corridor, *x_m), location->position.t_m);
  own.half_width_m = model.width_m / 2.0;
  const double room_m =
      (road::lane_width_m(network, own.position.road, location->lanes.lane, own.position.s_m) - model.width_m) / 2.0;
  own.room_left_m = room_m - own.offset_m;
  own.room_right_m = room_m + own.offset_m;
  own.speed_mps = snapshot.driver_car.speed_mps;
  own.acceleration_mps2 = glm::dot(body->acceleration_mps2, forward);
  own.front_m = model.front_m();
  own.rear_m = model.rear_overhang_m;
  return own;
}

namespace {

/// True for one who comes across the driver's road; `ahead`: its direction.
bool comes_across(const Participant& other, const Vec2& ahead) {
  const Vec2 moves = Vec2(other.velocity_mps);
  return glm::length(moves) > 0.3 && std::abs(glm::dot(moves, ahead)) < across_cos * glm::length(moves);
}

/// The place that counts of one who comes across: where he is, if that is in lanes of the driver's side, else where he will be
/// when the car has come to him, as he moves now. A vehicle without siren that can still stop before it will not be there.
Vec2 place_across(const road::RoadNetwork& network, const Participant& other, const road::RoadPosition& hint, int side,
                  const OwnPlace& own, double ahead_m) {
  const Vec2 here = ground_position(other), moves = Vec2(other.velocity_mps);
  const VehicleModel shape = shape_of(other);
  const auto now = road::locate(network, here, &hint);
  if (now && now->lanes.lane * side > 0 && !lanes_taken(network, now->position, other, shape, 0.0).empty()) return here;
  const double until_s = std::clamp((ahead_m - own.front_m) / std::max(own.speed_mps, 1.0), 0.0, crossing_foreseen_s);
  const bool may_stop = shape.kind != ParticipantKind::pedestrian && !other.lamps.has(Lamp::siren);
  const double stops_m = glm::dot(moves, moves) / (2.0 * would_brake_mps2) + shape.front_m();
  if (may_stop && until_s * glm::length(moves) > stops_m) return here;
  return here + until_s * moves;
}

}  // namespace

std::vector<SeenVehicle> see_vehicles(const road::RoadNetwork& network, const traffic::Corridor& corridor,
                                      std::span<const Participant> around, ParticipantId self, const OwnPlace& own) {
  std::vector<SeenVehicle> seen;
  const auto body = std::ranges::find(around, self, &Participant::id);
  if (body == around.end()) return seen;
  const Vec2 here = ground_position(*body);
  // The search along the road begins where another would be if it ran straight on.
  const double ahead_along_s = traffic::piece_at(corridor, own.x_m).along_s ? 1.0 : -1.0;
  const Vec2 forward = ahead_along_s * Vec2(body->world_from_vehicle.orientation * Vec3(1, 0, 0));
  for (const Participant& other : around) {
    if (other.id == self || glm::distance(ground_position(other), here) > looked_for_within_m) continue;
    road::RoadPosition hint = own.position;
    hint.s_m += glm::dot(ground_position(other) - here, forward);
    const VehicleModel model = shape_of(other);
    const int side = traffic::piece_at(corridor, own.x_m).side;
    const double ahead_of_car_m = glm::dot(ground_position(other) - here, ahead_along_s * forward);
    const bool across = ahead_of_car_m > own.front_m && comes_across(other, forward);
    const Vec2 there = across ? place_across(network, other, hint, side, own, ahead_of_car_m) : ground_position(other);
    const auto location = on_corridor(network, corridor, road::locate(network, there, &hint), there,
                                      own.x_m + glm::dot(there - here, ahead_along_s * forward));
    // On a route x_of tells sides apart.
    if (!location || (!corridor.is_route && location->lanes.lane * side <= 0)) continue;
    const double sideways = sideways_mps(network, location->position, other);
    const road::LaneRange lanes = lanes_taken(network, location->position, other, model, sideways);
    if (lanes.empty()) continue;
    const auto x_m = traffic::x_of(network, corridor, location->position, lanes.lowest);
    if (!x_m) continue;
    const Vec3 heads = other.world_from_vehicle.orientation * Vec3(1, 0, 0);
    SeenVehicle vehicle;
    vehicle.id = other.id;
    const int shift = traffic::piece_at(corridor, *x_m).lane_shift;
    vehicle.lane = std::abs(location->lanes.lane) + shift;
    vehicle.innermost_lane = std::min(std::abs(lanes.lowest), std::abs(lanes.highest)) + shift;
    vehicle.outermost_lane = std::max(std::abs(lanes.lowest), std::abs(lanes.highest)) + shift;
    const double ahead_m = traffic::length_along_lane_m(network, corridor, own.lane, own.x_m,
                                                        traffic::distance_m(corridor, own.x_m, *x_m), gap_step_m);
    const traffic::CorridorPiece& piece = traffic::piece_at(corridor, *x_m);
    vehicle.x_m = *x_m;
    vehicle.across_m = to_the_left(piece, location->position.t_m);
    vehicle.across_soon_m = vehicle.across_m + foresight_s * to_the_left(piece, sideways);
    vehicle.half_width_m = model.width_m / 2.0;
    vehicle.is_ahead = ahead_m + model.centre_x_m() > (own.front_m - own.rear_m) / 2.0;
    vehicle.gap_m =
        vehicle.is_ahead ? ahead_m - model.rear_overhang_m - own.front_m : -ahead_m - model.front_m() - own.rear_m;
    // Who comes across goes nowhere along the road.
    vehicle.speed_mps =
        across ? ahead_along_s * glm::dot(Vec2(other.velocity_mps), forward) : glm::dot(other.velocity_mps, heads);
    vehicle.is_ambulance = model.kind == ParticipantKind::ambulance && other.lamps.has(Lamp::beacon);
    if (other.lamps.has(Lamp::indicator_left) && other.lamps.has(Lamp::indicator_right)) vehicle.warned_ago_s = 0.0;
    seen.push_back(vehicle);
  }
  return seen;
}

std::vector<SeenVehicle> remembered_vehicles(std::vector<SeenVehicle> seen, double ago_s, double own_speed_mps) {
  for (SeenVehicle& vehicle : seen) {
    const double opens_mps = vehicle.speed_mps - own_speed_mps;
    vehicle.gap_m += ago_s * (vehicle.is_ahead ? opens_mps : -opens_mps);
  }
  return seen;
}

void see_accelerations(std::span<const SeenVehicle> before, double dt_s, std::vector<SeenVehicle>& now) {
  const double share = 1.0 - std::exp(-dt_s / acceleration_seen_in_s);
  for (SeenVehicle& vehicle : now) {
    const auto last = std::ranges::lower_bound(before, vehicle.id, {}, &SeenVehicle::id);
    if (last == before.end() || last->id != vehicle.id) continue;
    vehicle.warned_ago_s = std::min(vehicle.warned_ago_s, last->warned_ago_s + dt_s);
    const double rate_mps2 = (vehicle.speed_mps - last->speed_mps) / dt_s;
    vehicle.acceleration_mps2 = last->acceleration_mps2 + share * (rate_mps2 - last->acceleration_mps2);
  }
}

}  // namespace septet::driver
