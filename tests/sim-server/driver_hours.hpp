#pragma once
/// Hours of driving as the product does them, without screens or log: what the simulated driver did that people do not.
///
/// A drive is the shipped motorway with its ambulance and traffic; at the road's end the next one begins with another seed.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "logging/measures/glances.hpp"
#include "logging/measures/lane_changes.hpp"
#include "logging/records.hpp"
#include "sim-server/crashes.hpp"
#include "sim-server/driver_seat.hpp"
#include "sim-server/effect_surroundings.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {

/// What is counted over one or many drives.
struct DrivingRecord {
  double time_s = 0.0, way_m = 0.0;
  int hard_brakings = 0;        ///< Times that the car slowed by more than 5 m/s² over a tenth of a second.
  int own_collisions = 0;       ///< That the driver made.
  int other_collisions = 0;     ///< That others made.
  int stops = 0;                ///< Times at a standstill.
  double off_lanes_s = 0.0;     ///< With the front axle off every lane for driving.
  int lane_changes = 0, glances = 0;
  std::vector<std::string> incidents;  ///< A line for each braking, collision and stop.

  void add(const DrivingRecord& other) {
    time_s += other.time_s;
    way_m += other.way_m;
    hard_brakings += other.hard_brakings;
    own_collisions += other.own_collisions;
    other_collisions += other.other_collisions;
    stops += other.stops;
    off_lanes_s += other.off_lanes_s;
    lane_changes += other.lane_changes;
    glances += other.glances;
    incidents.insert(incidents.end(), other.incidents.begin(), other.incidents.end());
  }
};

/// Watches the snapshots of one drive.
class DriveWatch {
 public:
  static constexpr double hard_mps2 = 5.0, history_s = 3.0;

  explicit DriveWatch(std::string name) : name_(std::move(name)) {}

  void see(const Snapshot& snapshot) {
    if (!logging::is_sample_due(snapshot.tick, tick_rate_hz)) return;
    const Participant* car = find_participant(snapshot, snapshot.driver_car.participant);
    const DriverCar& own = snapshot.driver_car;
    const double dt_s = snapshot.simulated_time_s - record.time_s;
    record.time_s = snapshot.simulated_time_s;
    record.way_m += own.speed_mps * dt_s;
    record.off_lanes_s += own.lane == 0 ? dt_s : 0.0;
    if (last_speed_mps_ && dt_s > 0.0) {
      const double braking_mps2 = (*last_speed_mps_ - own.speed_mps) / dt_s;
      if (braking_mps2 > hard_mps2 && !is_braking_hard_) {
        ++record.hard_brakings;
        note(snapshot, fmt::format("brakes with {:.1f} m/s2", braking_mps2));
      }
      is_braking_hard_ = braking_mps2 > (is_braking_hard_ ? hard_mps2 / 2.0 : hard_mps2);
    }
    last_speed_mps_ = own.speed_mps;
    const bool stands = own.speed_mps < 0.3;
    if (stands && !stands_) {
      ++record.stops;
      note(snapshot, "stops");
    }
    stands_ = stands;
    samples.push_back(logging::take_sample(snapshot, std::nullopt));
    look_for_collisions(snapshot, *car);
    remember(snapshot, *car);
  }

  /// After a collision the drive says nothing more about driving.
  bool has_collided() const { return record.own_collisions + record.other_collisions > 0; }

  DrivingRecord finish() {
    record.lane_changes = static_cast<int>(logging::find_lane_changes(samples).size());
    record.glances = static_cast<int>(logging::find_glances(samples).size());
    return record;
  }

  DrivingRecord record;
  std::vector<logging::Sample> samples;

 private:
  struct Instant {
    double time_s = 0.0;
    DriverCar own;
    std::vector<std::pair<ParticipantId, Vec2>> others;  ///< Within 40 m: middle of the body in the car's frame.
  };

  static Vec2 seen_from(const Participant& car, const Participant& other) {
    const Vec3 away = glm::conjugate(car.world_from_vehicle.orientation) *
                      (body_box(other).world_from_box.position_m - body_box(car).world_from_box.position_m);
    return {away.x, away.y};
  }

  void remember(const Snapshot& snapshot, const Participant& car) {
    Instant now{snapshot.simulated_time_s, snapshot.driver_car, {}};
    for (const Participant& other : snapshot.participants)
      if (other.id != car.id && glm::distance(other.world_from_vehicle.position_m, car.world_from_vehicle.position_m) < 40.0)
        now.others.emplace_back(other.id, seen_from(car, other));
    past_.push_back(std::move(now));
    while (past_.front().time_s < snapshot.simulated_time_s - history_s) past_.pop_front();
  }

  void look_for_collisions(const Snapshot& snapshot, const Participant& car) {
    for (const Participant& other : snapshot.participants) {
      if (other.id == car.id || glm::distance(other.world_from_vehicle.position_m, car.world_from_vehicle.position_m) > 40.0) continue;
      const auto contact = contact_of(body_box(car), body_box(other));
      if (!contact || has_collided()) continue;
      const bool own_fault = is_own_fault(snapshot, car, other);
      ++(own_fault ? record.own_collisions : record.other_collisions);
      const Vec2 away = seen_from(car, other);
      note(snapshot, fmt::format("{} collision with {} ({}), {:.1f} m ahead, {:.1f} m to the left, its speed {:.1f} m/s, {:.2f} m deep",
                                 own_fault ? "own" : "another's", other.id, vehicle_models()[other.model].name, away.x, away.y,
                                 glm::length(other.velocity_mps), contact->depth_m));
    }
  }

  /// The driver made it by driving into what was in the way, or by leaving the lane. Who is struck from behind in the own lane, or
  /// by somebody who came into it within the last seconds, did not.
  bool is_own_fault(const Snapshot& snapshot, const Participant& car, const Participant& other) const {
    const double half_width_m = vehicle_models()[car.model].width_m / 2.0;
    const auto in_lane = [&](const DriverCar& own) {
      return own.lane != 0 && std::abs(own.lateral_position_m) + half_width_m < own.lane_width_m / 2.0 + 0.1;
    };
    if (!in_lane(snapshot.driver_car)) return true;
    for (const Instant& instant : past_)
      if (instant.time_s > snapshot.simulated_time_s - 2.0 && (!in_lane(instant.own) || instant.own.lane != snapshot.driver_car.lane)) return true;
    if (seen_from(car, other).x < 0.0) return false;
    const double apart_m = half_width_m + vehicle_models()[other.model].width_m / 2.0 + 0.2;
    for (const Instant& instant : past_)
      for (const auto& [id, away] : instant.others)
        if (id == other.id && std::abs(away.y) > apart_m) return false;  // It was beside the car's way: it cut in.
    return true;
  }

  /// What happened, and who was around: forward and left in the car's frame, with speed and acceleration.
  void note(const Snapshot& snapshot, const std::string& what) {
    const DriverCar& own = snapshot.driver_car;
    const Participant* car = find_participant(snapshot, own.participant);
    std::string around;
    for (const Participant& other : snapshot.participants) {
      const Vec2 away = seen_from(*car, other);
      if (other.id == car->id || away.x < -30.0 || away.x > 80.0 || std::abs(away.y) > 6.0) continue;
      const Vec3 heads = other.world_from_vehicle.orientation * Vec3(1, 0, 0);
      around += fmt::format(" {} ({:.0f} {:.1f} m, {:.1f} m/s, {:.1f} m/s2)", other.id, away.x, away.y, glm::dot(other.velocity_mps, heads),
                            glm::dot(other.acceleration_mps2, heads));
    }
    record.incidents.push_back(fmt::format("{}, {:.1f} s: {}; {:.1f} m/s in lane {}, {:.2f} m left of its middle, s {:.0f} m; around:{}", name_,
                                           snapshot.simulated_time_s, what, own.speed_mps, own.lane, own.lateral_position_m, own.road_s_m, around));
  }

  std::string name_;
  std::deque<Instant> past_;
  std::optional<double> last_speed_mps_;
  bool is_braking_hard_ = false, stands_ = false;
};

/// One drive, for as long as given or until a collision.
inline DriveWatch watch_drive(const std::string& scenario, const std::string& driver, std::uint64_t seed, double seconds) {
  const LoadedDrive loaded = shipped_drive(scenario, "seven-screens", seed);
  auto seat = open_driver_seat(rig::Car{}, driver, seed, loaded.model);
  REQUIRE(seat.has_value());
  auto drive = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, seed), std::move(*seat));
  REQUIRE(drive.has_value());
  DriveWatch watch(fmt::format("{} {} seed {}", scenario, driver, seed));
  while (watch.record.time_s < seconds - 1e-6 && !watch.has_collided()) {
    const auto tick = (*drive)->next(std::nullopt);
    if (!tick || !*tick) break;  // The end of the road.
    watch.see((*drive)->newest());
  }
  return watch;
}

}  // namespace septet::server
