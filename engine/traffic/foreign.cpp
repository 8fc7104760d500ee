#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double over_the_line_m = 0.2;
/// One who has stood for so long, not behind another and without a beacon, is gone round like a wreck.
constexpr double given_up_s = 1.0, given_up_mps = 0.1;
constexpr double queue_m = 15.0, queue_mps = 2.0;
constexpr double flash_s = 0.5;  ///< An indicator lit within this time is on.

/// State of the left and the right indicator.
struct Signals {
  bool left = false, right = false;
};

Signals signals_of(const Lamps& lamps, double dt_s, std::array<double, 2>& since_s) {
  since_s[0] = lamps.has(Lamp::indicator_left) ? 0.0 : since_s[0] + dt_s;
  since_s[1] = lamps.has(Lamp::indicator_right) ? 0.0 : since_s[1] + dt_s;
  return {since_s[0] < flash_s, since_s[1] < flash_s};
}

bool signals_emergency(const ForeignVehicle& vehicle) {
  return vehicle.lamps.has(Lamp::beacon) || vehicle.lamps.has(Lamp::siren);
}

void place_in_corridor(const road::RoadNetwork& network, const ForeignVehicle& vehicle, std::int32_t index,
                       double acceleration_mps2, const Signals& signals, const road::Location& place,
                       const CorridorTraffic& traffic, ForeignTraffic& found) {
  const auto x = x_of(network, traffic.corridor, place.position, place.lanes.lane);
  if (!x) return;
  const VehicleModel model = vehicle.shape();
  const CorridorPiece& piece = piece_at(traffic.corridor, *x);
  const int lane = std::abs(place.lanes.lane);
  const double offset_left = piece.along_s ? place.lanes.offset_m : -place.lanes.offset_m;
  const double half_width = 0.5 * model.width_m;
  LaneEntry entry;
  entry.x_m = *x + 0.5 * model.length_m;
  entry.length_m = static_cast<float>(model.length_m);
  // Speed is the component along the traffic.
  entry.speed_mps = glm::length(vehicle.velocity_mps);
  entry.acceleration_mps2 = static_cast<float>(acceleration_mps2);
  entry.lateral_m = static_cast<float>(-lane * traffic.table.lane_width_m + offset_left);
  entry.half_width_m = static_cast<float>(half_width);
  entry.vehicle = -1 - index;
  const double width = road::lane_width_m(network, place.position.road, place.lanes.lane, place.position.s_m);
  const double over = std::abs(offset_left) + half_width - 0.5 * width;
  entry.straddles = over > over_the_line_m;
  found.entries.push_back({lane, entry});
  // Over the line: it is an obstacle in the next lane too.
  const bool over_left = entry.straddles && offset_left > 0.0;
  const bool over_right = entry.straddles && !over_left;
  // An indicated change claims its place: no vehicle changes into it. It is passed as long as there is room.
  const bool both = signals.left && signals.right;  // Hazard lights indicate no side.
  entry.straddles = true;
  if (over_left || (signals.left && !both)) found.entries.push_back({lane - 1, entry});
  if (over_right || (signals.right && !both)) found.entries.push_back({lane + 1, entry});
  if (signals_emergency(vehicle)) {
    found.emergencies.push_back({entry.x_m, entry.length_m, entry.lateral_m, half_width});
  }
}

/// It stands in the way as it lies, in each lane that it reaches into; as one that stands, wherever it slides to. It is
/// passed where there is room.
void place_adrift(const road::RoadNetwork& network, const ForeignVehicle& vehicle, std::int32_t index,
                  const road::RoadPosition* hint, const std::vector<CorridorTraffic>& corridors,
                  std::vector<ForeignTraffic>& found) {
  constexpr int along = 5;  // Less than a lane's width apart on the longest vehicle.
  const VehicleModel model = vehicle.shape();
  std::vector<road::Location> points;
  for (int k = 0; k < along; ++k)
    for (const double side : {-0.5, 0.5}) {
      const double x_m = model.front_m() - model.length_m * k / (along - 1);
      const Vec3 point_m = vehicle.world_from_vehicle * Vec3(x_m, side * model.width_m, 0.0);
      const auto place = road::locate(network, Vec2(point_m), hint, 20.0, point_m.z);
      if (place && place->lanes.lane != 0) points.push_back(*place);
    }
  for (std::size_t c = 0; c < corridors.size(); ++c) {
    const CorridorTraffic& traffic = corridors[c];
    Wreck lying;
    double first_x_m = 0.0, from_m = 0.0, to_m = 0.0;
    for (const road::Location& point : points) {
      const auto x = x_of(network, traffic.corridor, point.position, point.lanes.lane);
      if (!x) continue;
      const int lane = std::abs(point.lanes.lane);
      const double left_m = piece_at(traffic.corridor, *x).along_s ? point.lanes.offset_m : -point.lanes.offset_m;
      const double lateral_m = -lane * traffic.table.lane_width_m + left_m;
      if (lying.lanes.empty()) {
        first_x_m = *x;
        lying.right_m = lying.left_m = lateral_m;
      }
      const double ahead_m = distance_m(traffic.corridor, first_x_m, *x);
      from_m = std::min(from_m, ahead_m);
      to_m = std::max(to_m, ahead_m);
      lying.right_m = std::min(lying.right_m, lateral_m);
      lying.left_m = std::max(lying.left_m, lateral_m);
      if (std::ranges::find(lying.lanes, lane) == lying.lanes.end()) lying.lanes.push_back(lane);
    }
    if (lying.lanes.empty()) continue;
    lying.rear_x_m = wrap_x(traffic.corridor, first_x_m + from_m);
    lying.length_m = to_m - from_m;
    LaneEntry entry;
    entry.x_m = wrap_x(traffic.corridor, first_x_m + to_m);
    entry.length_m = static_cast<float>(lying.length_m);
    entry.lateral_m = static_cast<float>(0.5 * (lying.right_m + lying.left_m));
    entry.half_width_m = static_cast<float>(0.5 * (lying.left_m - lying.right_m));
    entry.vehicle = -1 - index;
    entry.straddles = true;
    for (const int lane : lying.lanes) found[c].entries.push_back({lane, entry});
    found[c].wrecks.push_back(std::move(lying));
  }
}

/// True for one who stands behind somebody of the traffic who is slow himself.
bool is_in_queue(const road::RoadNetwork& network, const road::Location& place, double front_from_middle_m,
                 const std::vector<CorridorTraffic>& corridors) {
  return std::ranges::any_of(corridors, [&](const CorridorTraffic& traffic) {
    const auto x = x_of(network, traffic.corridor, place.position, place.lanes.lane);
    const int lane = std::abs(place.lanes.lane);
    if (!x || lane >= static_cast<int>(traffic.order.lanes.size())) return false;
    std::uint32_t hint = 0;
    const LaneEntry* ahead = neighbours(traffic, lane, *x + front_from_middle_m, -1, hint).ahead;
    return ahead != nullptr && ahead->vehicle >= 0 && ahead->speed_mps < queue_mps &&
           gap_to(traffic, lane, *x + front_from_middle_m, ahead) < queue_m;
  });
}

}  // namespace

std::vector<ForeignTraffic> place_foreign(const road::RoadNetwork& network, std::span<const ForeignVehicle> foreign,
                                          double dt_s, TrafficState& state) {
  state.foreign_places.resize(foreign.size());
  state.foreign_speeds_mps.resize(foreign.size(), no_leader);
  state.foreign_stands_s.resize(foreign.size(), 0.0);
  state.foreign_signals_s.resize(foreign.size(), {no_leader, no_leader});
  std::vector<ForeignTraffic> found(state.corridors.size());
  for (std::size_t i = 0; i < foreign.size(); ++i) {
    const double now_mps = glm::length(foreign[i].velocity_mps);
    const double before_mps = std::exchange(state.foreign_speeds_mps[i], now_mps);
    const VehicleModel model = foreign[i].shape();
    const Vec3 middle = foreign[i].world_from_vehicle * Vec3(model.centre_x_m(), 0.0, 0.0);
    auto& hint = state.foreign_places[i];
    const auto place = road::locate(network, {middle.x, middle.y}, hint ? &*hint : nullptr);
    double& stands_s = state.foreign_stands_s[i];
    stands_s = now_mps < given_up_mps ? stands_s + dt_s : 0.0;
    const bool is_in_the_way = stands_s > given_up_s && !signals_emergency(foreign[i]) && place &&
                               place->lanes.lane != 0 &&
                               !is_in_queue(network, *place, 0.5 * model.length_m, state.corridors);
    if (foreign[i].adrift || is_in_the_way) {
      if (place) hint = place->position;
      place_adrift(network, foreign[i], static_cast<std::int32_t>(i), hint ? &*hint : nullptr, state.corridors, found);
      continue;
    }
    if (!place || place->lanes.lane == 0) continue;
    hint = place->position;
    const Signals signals = signals_of(foreign[i].lamps, dt_s, state.foreign_signals_s[i]);
    const double change_mps = now_mps - before_mps;
    // A vehicle put elsewhere has not braked.
    const double braking_mps2 = change_mps > -hardest_braking_mps2 * 2.0 * dt_s ? change_mps / dt_s : 0.0;
    for (std::size_t c = 0; c < state.corridors.size(); ++c) {
      place_in_corridor(network, foreign[i], static_cast<std::int32_t>(i), braking_mps2, signals, *place,
                        state.corridors[c], found[c]);
    }
  }
  return found;
}

}  // namespace septet::traffic
