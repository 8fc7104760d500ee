#pragma once
/// A drive in which the driver follows the ambulance, as the product runs it: figures of the driver's view.

#include <algorithm>
#include <string>

#include <fmt/core.h>

#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/simulation/effects/effect_surroundings.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "tests/sim-server/simulated_drive.hpp"

namespace septet::server {

struct AmbulanceChase {
  double time_s = 0.0;
  double ambulance_mps = 0.0, driver_mps = 0.0,
         traffic_mps = 0.0;        ///< Means; traffic moving along within 400 m of the ambulance.
  double farthest_m = 0.0;         ///< Between the origins of the two.
  double least_traffic = 1e9;      ///< Number of these.
  int driver_collisions = 0;       ///< Collisions of the driver's car, each participant counted once.
  int ambulance_overlaps_s10 = 0;  ///< Tenths of a second in which the ambulance's body overlaps another's.
  std::string first_overlap;
};

inline AmbulanceChase chase_ambulance(const std::string& scenario, const std::string& driver, std::uint64_t seed,
                                      double seconds) {
  constexpr double settled_s = 15.0;
  const LoadedDrive loaded = shipped_drive(scenario, "seven-screens", seed);
  const auto drive = simulated_drive(loaded, driver, seed);
  AmbulanceChase chase;
  double samples = 0.0, others = 0.0;
  while (chase.time_s < seconds) {
    const auto ended = drive->next(std::nullopt);
    if (!ended || !*ended) break;  // The end of the road.
    const Snapshot& now = drive->newest();
    chase.time_s = now.simulated_time_s;
    chase.driver_collisions = static_cast<int>(now.diagnostics.collisions);
    if (now.tick % 12 != 0) continue;
    const auto ambulance = std::ranges::find_if(now.participants, [](const Participant& p) {
      return vehicle_models()[p.model].kind == ParticipantKind::ambulance && p.lamps.has(Lamp::beacon);
    });
    REQUIRE(ambulance != now.participants.end());
    const Participant* car = find_participant(now, simulation::driver_participant);
    const Vec3 ahead = ambulance->world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
    for (const Participant& other : now.participants) {
      if (other.id == ambulance->id ||
          glm::distance(other.world_from_vehicle.position_m, ambulance->world_from_vehicle.position_m) > 20.0)
        continue;
      if (!simulation::contact_of(simulation::body_box(*ambulance), simulation::body_box(other))) continue;
      ++chase.ambulance_overlaps_s10;
      if (chase.first_overlap.empty())
        chase.first_overlap =
            fmt::format("({:.1f} s: {} {})", now.simulated_time_s, vehicle_models()[other.model].name, other.id);
    }
    if (chase.time_s < settled_s) continue;
    double near = 0.0;
    for (const Participant& other : now.participants) {
      const double along_mps = glm::dot(other.velocity_mps, ahead);
      const bool goes_along = glm::dot(other.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0), ahead) > 0.0;
      if (other.id == car->id || other.id == ambulance->id || !goes_along) continue;
      if (glm::distance(other.world_from_vehicle.position_m, ambulance->world_from_vehicle.position_m) > 400.0)
        continue;
      chase.traffic_mps += along_mps;
      near += 1.0;
    }
    others += near;
    chase.least_traffic = std::min(chase.least_traffic, near);
    samples += 1.0;
    chase.ambulance_mps += glm::length(ambulance->velocity_mps);
    chase.driver_mps += now.driver_car.speed_mps;
    chase.farthest_m = std::max(
        chase.farthest_m, glm::distance(car->world_from_vehicle.position_m, ambulance->world_from_vehicle.position_m));
  }
  chase.ambulance_mps /= std::max(1.0, samples);
  chase.driver_mps /= std::max(1.0, samples);
  chase.traffic_mps /= std::max(1.0, others);
  return chase;
}

inline std::string in_words(std::uint64_t seed, const AmbulanceChase& chase) {
  return fmt::format(
      "seed {}, {:.0f} s: ambulance {:.1f} m/s, driver {:.1f}, traffic {:.1f} (at least {:.0f} vehicles); ambulance "
      "over traffic {:.2f}, driver over traffic {:.2f}; "
      "driver at most {:.0f} m behind, {} collisions; ambulance in others {:.1f} s {}",
      seed, chase.time_s, chase.ambulance_mps, chase.driver_mps, chase.traffic_mps, chase.least_traffic,
      chase.ambulance_mps / chase.traffic_mps, chase.driver_mps / chase.traffic_mps, chase.farthest_m,
      chase.driver_collisions, 0.1 * chase.ambulance_overlaps_s10, chase.first_overlap);
}

inline void check_chase(const AmbulanceChase& chase) {
  CHECK(chase.ambulance_mps >= 1.5 * chase.traffic_mps);
  CHECK(chase.driver_mps >= 1.5 * chase.traffic_mps);
  CHECK(chase.farthest_m < 100.0);
  CHECK(chase.least_traffic > 80.0);
  CHECK(chase.driver_collisions == 0);
  CHECK(chase.ambulance_overlaps_s10 == 0);
}

}  // namespace septet::server
