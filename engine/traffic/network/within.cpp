#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

/// Number of a vehicle's claim on a way; 0, before all others: it is there without one.
std::uint64_t claim_on(const TownVehicle& vehicle, WayIndex way) {
  for (std::size_t k = 0; k < vehicle.claims.size(); ++k)
    if (vehicle.route[k] == way) return vehicle.claims[k];
  return 0;
}

/// Who has stood within a junction for long and longer than one with an earlier claim, who stands as well, takes that
/// claim's number: the other one waits for somebody else.
void go_first_if_stuck(TownVehicle& vehicle, std::uint64_t own, TownVehicle& other, std::uint64_t his) {
  constexpr double stuck_s = 5.0;
  if (vehicle.stands_s <= stuck_s || vehicle.stands_s <= other.stands_s || other.stands_s <= 1.0 || his == 0) return;
  std::ranges::replace(vehicle.claims, own, his);
  std::ranges::replace(other.claims, his, own);
}

}  // namespace

double wait_within_mps2(const LaneGraph& graph, const Presences& presences, TownState& town, std::size_t index) {
  TownVehicle& vehicle = town.vehicles[index];
  const auto self = static_cast<std::int32_t>(index);
  double begin_m = 0.0, nearest_m = no_leader, most_mps2 = no_leader;
  for (std::size_t k = 0; k < vehicle.claims.size(); ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    const double front_m = vehicle.front_m - begin_m;
    begin_m += way.length_m;
    if (front_m > way.length_m) continue;
    for (const WayConflict& conflict : graph.conflicts_of(way)) {
      const double to_begin_m = conflict.whole_from_m - front_m;
      if (conflict.kind == WayConflict::Kind::diverging || to_begin_m < 0.0) continue;
      for (const Presence& other : presences.on(conflict.with)) {
        if (other.who == self || !other.claims || other.rear_m > conflict.with_whole_to_m) continue;
        const bool is_in_it = other.front_m > conflict.with_whole_from_m;
        TownVehicle* rival = other.who < 0 ? nullptr : &town.vehicles[static_cast<std::size_t>(other.who)];
        const auto is_before = [&] { return claim_on(*rival, conflict.with) < vehicle.claims[k]; };
        if (to_begin_m <= nearest_m && !is_in_it && rival != nullptr && is_before())
          go_first_if_stuck(vehicle, vehicle.claims[k], *rival, claim_on(*rival, conflict.with));
        const bool is_earlier = is_in_it || rival == nullptr || is_before();
        if (!is_earlier) continue;
        // He may go on braking, and does not hurry.
        const double braking = rival == nullptr ? 0.0 : std::min(rival->acceleration_mps2, 0.0);
        const double his_mps = std::max(0.1, other.speed_mps + braking);
        const double clears_s = (conflict.with_whole_to_m - other.rear_m) / his_mps;
        // One who is faster than the way's bends allow is still before them.
        const double arrives_s = travel_s(to_begin_m, vehicle.speed_mps, vehicle.driver.following.acceleration_mps2,
                                          std::max(vehicle.speed_mps, most_mps_on(way)));
        if (arrives_s >= clears_s + behind_s) continue;
        nearest_m = std::min(nearest_m, to_begin_m);
        most_mps2 = std::min(most_mps2, acceleration_before(to_begin_m, clears_s + behind_s, vehicle.speed_mps));
      }
    }
  }
  return most_mps2;
}

}  // namespace septet::traffic
