#include "engine/driver/ambulance_tracks.hpp"

#include <algorithm>
#include <cmath>

namespace septet::driver {
namespace {

constexpr double point_every_m = 1.0, kept_behind_m = 20.0;
constexpr double lost_at = 1.5;  ///< Multiple of the distance within which an ambulance is followed.
constexpr double room_beside_m = 0.25;
/// A vehicle this near, bumper to bumper, is beside: the path over is closed.
constexpr double beside_behind_m = 15.0, beside_ahead_m = 8.0;

const SeenVehicle* nearest_ambulance(std::span<const SeenVehicle> vehicles) {
  const SeenVehicle* nearest = nullptr;
  for (const SeenVehicle& vehicle : vehicles)
    if (vehicle.is_ambulance && vehicle.is_ahead && (!nearest || vehicle.gap_m < nearest->gap_m)) nearest = &vehicle;
  return nearest;
}

/// True if a vehicle's body, now or soon, lies over a part of the road's width.
bool lies_over(const SeenVehicle& vehicle, double right_m, double left_m) {
  const double reach_m = vehicle.half_width_m + room_beside_m;
  return std::max(vehicle.across_m, vehicle.across_soon_m) + reach_m > right_m &&
         std::min(vehicle.across_m, vehicle.across_soon_m) - reach_m < left_m;
}

void begin_way(TracksState& state, double to, double duration_s) {
  const WayPoint now = point_on_way(state.way, state.way_s);
  state.way = {now.at, now.rate_ps, now.rate_change_ps2, to, duration_s};
  state.way_s = 0.0;
  state.follows = to > 0.0;
}

}  // namespace

void look_at_tracks(TracksState& state, const traffic::Corridor& corridor, const OwnPlace& own,
                    std::span<const SeenVehicle> vehicles, double within_m, double duration_s) {
  const auto ahead_m = [&](double x_m) { return traffic::distance_m(corridor, own.x_m, x_m); };
  const SeenVehicle* ambulance = nearest_ambulance(vehicles);
  if (ambulance && ambulance->gap_m < lost_at * within_m) {
    if (state.ambulance != ambulance->id) state.points.clear();
    state.ambulance = ambulance->id;
    if (state.points.empty() || traffic::distance_m(corridor, state.points.back().x_m, ambulance->x_m) > point_every_m)
      state.points.push_back({ambulance->x_m, ambulance->across_m});
  }
  std::erase_if(state.points, [&](const auto& point) { return ahead_m(point.x_m) < -kept_behind_m; });
  const bool near = ambulance && ambulance->gap_m < (state.follows ? lost_at : 1.0) * within_m;
  const bool driven_here = !state.points.empty() && ahead_m(state.points.front().x_m) < own.front_m;
  const bool follow = near && driven_here;
  if (follow == state.follows) return;
  if (!follow) return begin_way(state, 0.0, duration_s);
  const double there_m = across_at(state, own.x_m);
  // Width that the body will sweep and does not cover yet: the own leader and follower are not beside.
  const bool to_the_left = there_m > own.across_m;
  const double right_m = to_the_left ? own.across_m + own.half_width_m : there_m - own.half_width_m;
  const double left_m = to_the_left ? there_m + own.half_width_m : own.across_m - own.half_width_m;
  for (const SeenVehicle& vehicle : vehicles)
    if (vehicle.gap_m < (vehicle.is_ahead ? beside_ahead_m : beside_behind_m) && lies_over(vehicle, right_m, left_m))
      return;
  begin_way(state, 1.0, duration_s);
}

void advance_tracks(TracksState& state, double dt_s) { state.way_s += dt_s; }

double share_of_tracks(const TracksState& state, double ahead_s) {
  return point_on_way(state.way, state.way_s + ahead_s).at;
}

double across_at(const TracksState& state, double x_m) {
  const auto& points = state.points;
  if (points.empty()) return 0.0;
  const auto after = std::ranges::find_if(points, [&](const auto& point) { return point.x_m >= x_m; });
  if (after == points.begin()) return points.front().across_m;
  if (after == points.end()) return points.back().across_m;
  const auto& before = *(after - 1);
  const double part = (x_m - before.x_m) / (after->x_m - before.x_m);
  return before.across_m + part * (after->across_m - before.across_m);
}

std::optional<Obstacle> obstacle_in_tracks(const TracksState& state, const LaneScene& scene,
                                           const SpeedParameters& speed) {
  std::optional<Obstacle> hardest;
  double least_mps2 = 0.0;
  const bool still_crosses = share_of_tracks(state, 0.0) < 0.99;
  for (const SeenVehicle& vehicle : scene.vehicles) {
    if (!vehicle.is_ahead) continue;
    const double there_m = across_at(state, vehicle.x_m), here_m = still_crosses ? scene.own.across_m : there_m;
    if (!vehicle.is_ambulance && !lies_over(vehicle, std::min(here_m, there_m) - scene.own.half_width_m,
                                            std::max(here_m, there_m) + scene.own.half_width_m))
      continue;
    const Obstacle obstacle{vehicle.gap_m, vehicle.speed_mps, vehicle.acceleration_mps2};
    const double wish_mps2 = wished_acceleration_mps2(speed, scene.own.speed_mps, scene.desired_speed_mps, obstacle);
    if (hardest && wish_mps2 >= least_mps2) continue;
    hardest = obstacle;
    least_mps2 = wish_mps2;
  }
  return hardest;
}

}  // namespace septet::driver
