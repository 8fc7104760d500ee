#pragma once
/// Hours of driving as the product runs them, without screens or log: deviations of the simulated driver from people.
///
/// A drive is the shipped motorway with its ambulance and traffic; at the road's end the next one begins with another
/// seed.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/simulation/effects/effect_surroundings.hpp"
#include "logging/session/records.hpp"
#include "logging/study/measures/glances.hpp"
#include "logging/study/measures/lane_changes.hpp"
#include "logging/study/measures/lateral_position.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/session_log.hpp"
#include "tests/sim-server/simulated_drive.hpp"

namespace septet::server {

/// Counts over one or many drives.
struct DrivingRecord {
  double time_s = 0.0, way_m = 0.0;
  int hard_brakings = 0;  ///< Decelerations beyond 5 m/s² over a tenth of a second.
  double hardest_mps2 = 0.0;
  int own_collisions = 0;    ///< Caused by the driver.
  int other_collisions = 0;  ///< Caused by others.
  int stops = 0;             ///< Times at a standstill.
  double off_lanes_s = 0.0;  ///< With the front axle off every lane for driving.
  int lane_changes = 0;
  int unseen_changes = 0;  ///< Without a glance at that side's mirror in the six seconds before the line is crossed.
  int glances = 0;         ///< Including those for lane changes.
  double glance_s = 0.0;   ///< Total…
  double longest_glance_s = 0.0;
  /// Sums over samples of the lateral position and its square, without lane changes; and of time headways below 4 s.
  double lateral_samples = 0.0, lateral_m = 0.0, lateral_m2 = 0.0;
  double headway_samples = 0.0, headway_s = 0.0, short_headways = 0.0;  ///< Short: below 1 s.
  std::vector<std::string> incidents;  ///< A line for each collision, stop and braking harder than 4 m/s².

  void add(const DrivingRecord& other) {
    time_s += other.time_s;
    way_m += other.way_m;
    hard_brakings += other.hard_brakings;
    hardest_mps2 = std::max(hardest_mps2, other.hardest_mps2);
    own_collisions += other.own_collisions;
    other_collisions += other.other_collisions;
    stops += other.stops;
    off_lanes_s += other.off_lanes_s;
    lane_changes += other.lane_changes;
    unseen_changes += other.unseen_changes;
    glances += other.glances;
    glance_s += other.glance_s;
    longest_glance_s = std::max(longest_glance_s, other.longest_glance_s);
    lateral_samples += other.lateral_samples;
    lateral_m += other.lateral_m;
    lateral_m2 += other.lateral_m2;
    headway_samples += other.headway_samples;
    headway_s += other.headway_s;
    short_headways += other.short_headways;
    incidents.insert(incidents.end(), other.incidents.begin(), other.incidents.end());
  }
};

inline std::string describe(const DrivingRecord& r) {
  const double hours = r.time_s / 3600.0, lateral = std::max(r.lateral_samples, 1.0),
               following = std::max(r.headway_samples, 1.0);
  const double mean_m = r.lateral_m / lateral;
  return fmt::format(
      "{:.3f} h, {:.1f} km; braked harder than 5 m/s2 {} times, {:.1f} at most; collisions: own {}, others' {}; stops "
      "{}; off the lanes "
      "{:.1f} s; lane changes {:.0f} an hour, {} without a look; a glance every {:.1f} s, mean {:.2f} s, longest "
      "{:.1f} s; lateral position {:+.2f} m, SD "
      "{:.3f} m; time headway below 4 s: mean {:.2f} s, below 1 s {:.1f} %",
      hours, r.way_m / 1000.0, r.hard_brakings, r.hardest_mps2, r.own_collisions, r.other_collisions, r.stops,
      r.off_lanes_s, r.lane_changes / std::max(hours, 1e-9), r.unseen_changes, r.time_s / std::max(1, r.glances),
      r.glance_s / std::max(1, r.glances), r.longest_glance_s, mean_m,
      std::sqrt(std::max(0.0, r.lateral_m2 / lateral - mean_m * mean_m)), r.headway_s / following,
      100.0 * r.short_headways / following);
}

/// Watches the snapshots of one drive.
class DriveWatch {
 public:
  static constexpr double hard_mps2 = 5.0, noted_mps2 = 4.0, history_s = 3.0;

  DriveWatch(std::string name, std::shared_ptr<const simulation::Model> model)
      : name_(std::move(name)), model_(std::move(model)) {}

  void see(const Snapshot& snapshot) {
    if (!logging::is_sample_due(snapshot.tick, simulation::tick_rate_hz)) return;
    const Participant* car = find_participant(snapshot, snapshot.driver_car.participant);
    const DriverCar& own = snapshot.driver_car;
    const double dt_s = snapshot.simulated_time_s - record.time_s;
    record.time_s = snapshot.simulated_time_s;
    record.way_m += own.speed_mps * dt_s;
    record.off_lanes_s += own.lane == 0 ? dt_s : 0.0;
    if (last_speed_mps_ && dt_s > 0.0) {
      const double braking_mps2 = (*last_speed_mps_ - own.speed_mps) / dt_s;
      record.hardest_mps2 = std::max(record.hardest_mps2, braking_mps2);
      if (braking_mps2 > noted_mps2 && !is_noted_) note(snapshot, fmt::format("brakes with {:.1f} m/s2", braking_mps2));
      if (braking_mps2 > hard_mps2 && !is_braking_hard_) {
        ++record.hard_brakings;
        note(snapshot, fmt::format("brakes hard, with {:.1f} m/s2", braking_mps2));
      }
      is_noted_ = braking_mps2 > (is_noted_ ? noted_mps2 / 2.0 : noted_mps2);
      is_braking_hard_ = braking_mps2 > (is_braking_hard_ ? hard_mps2 / 2.0 : hard_mps2);
    }
    last_speed_mps_ = own.speed_mps;
    const bool stands = own.speed_mps < 0.3;
    if (stands && !stands_) {
      ++record.stops;
      note(snapshot, "stops");
    }
    stands_ = stands;
    samples.push_back(logging::take_sample(snapshot, find_leader(snapshot, model_->roads)));
    look_for_collisions(snapshot, *car);
    remember(snapshot, *car);
  }

  /// After a collision the drive is no longer representative.
  bool has_collided() const { return record.own_collisions + record.other_collisions > 0; }

  DrivingRecord finish() {
    const auto changes = logging::find_lane_changes(samples);
    record.lane_changes = static_cast<int>(changes.size());
    const auto glances = logging::find_glances(samples);
    for (const logging::LaneChange& change : changes)
      record.unseen_changes += std::ranges::none_of(glances, [&](const logging::Glance& glance) {
        return glance.area == (change.lanes_to_left > 0 ? "left mirror" : "right mirror") &&
               glance.start_s < change.simulated_time_s && glance.start_s > change.simulated_time_s - 6.0;
      });
    for (const logging::Glance& glance : glances) {
      ++record.glances;
      record.glance_s += glance.duration_s;
      record.longest_glance_s = std::max(record.longest_glance_s, glance.duration_s);
    }
    const auto lateral = logging::compute_lateral_position_statistics(samples, changes);
    record.lateral_samples = static_cast<double>(lateral.samples);
    record.lateral_m = record.lateral_samples * lateral.mean_m;
    record.lateral_m2 = record.lateral_samples * (lateral.sd_m * lateral.sd_m + lateral.mean_m * lateral.mean_m);
    for (const logging::Sample& sample : samples) {
      const double headway_s =
          sample.leader ? sample.leader->distance_headway_m / std::max(sample.speed_mps, 1.0) : 1e9;
      if (headway_s > 4.0) continue;
      record.headway_samples += 1.0;
      record.headway_s += headway_s;
      record.short_headways += headway_s < 1.0 ? 1.0 : 0.0;
    }
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
    const Vec3 away =
        glm::conjugate(car.world_from_vehicle.orientation) *
        (simulation::body_box(other).world_from_box.position_m - simulation::body_box(car).world_from_box.position_m);
    return {away.x, away.y};
  }

  void remember(const Snapshot& snapshot, const Participant& car) {
    Instant now{snapshot.simulated_time_s, snapshot.driver_car, {}};
    for (const Participant& other : snapshot.participants)
      if (other.id != car.id &&
          glm::distance(other.world_from_vehicle.position_m, car.world_from_vehicle.position_m) < 40.0)
        now.others.emplace_back(other.id, seen_from(car, other));
    past_.push_back(std::move(now));
    while (past_.front().time_s < snapshot.simulated_time_s - history_s) past_.pop_front();
  }

  void look_for_collisions(const Snapshot& snapshot, const Participant& car) {
    for (const Participant& other : snapshot.participants) {
      if (other.id == car.id ||
          glm::distance(other.world_from_vehicle.position_m, car.world_from_vehicle.position_m) > 40.0)
        continue;
      const auto contact = simulation::contact_of(simulation::body_box(car), simulation::body_box(other));
      if (!contact || has_collided()) continue;
      const bool own_fault = is_own_fault(snapshot, car, other);
      ++(own_fault ? record.own_collisions : record.other_collisions);
      const Vec2 away = seen_from(car, other);
      note(snapshot,
           fmt::format(
               "{} collision with {} ({}), {:.1f} m ahead, {:.1f} m to the left, its speed {:.1f} m/s, {:.2f} m deep",
               own_fault ? "own" : "another's", other.id, vehicle_models()[other.model].name, away.x, away.y,
               glm::length(other.velocity_mps), contact->depth_m));
    }
  }

  /// True if the driver caused it, by driving into an obstacle or by leaving the lane; false if struck from behind in
  /// the own lane, or by a vehicle that entered it within the last seconds.
  bool is_own_fault(const Snapshot& snapshot, const Participant& car, const Participant& other) const {
    const double half_width_m = vehicle_models()[car.model].width_m / 2.0;
    const auto in_lane = [&](const DriverCar& own) {
      return own.lane != 0 && std::abs(own.lateral_position_m) + half_width_m < own.lane_width_m / 2.0 + 0.1;
    };
    if (!in_lane(snapshot.driver_car)) return true;
    for (const Instant& instant : past_)
      if (instant.time_s > snapshot.simulated_time_s - 2.0 &&
          (!in_lane(instant.own) || instant.own.lane != snapshot.driver_car.lane))
        return true;
    if (seen_from(car, other).x < 0.0) return false;
    const double apart_m = half_width_m + vehicle_models()[other.model].width_m / 2.0 + 0.2;
    for (const Instant& instant : past_)
      for (const auto& [id, away] : instant.others)
        if (id == other.id && std::abs(away.y) > apart_m) return false;  // It was beside the car's path: it cut in.
    return true;
  }

  /// Records the incident and the vehicles around: forward and left in the car's frame, with speed and acceleration.
  void note(const Snapshot& snapshot, const std::string& what) {
    const DriverCar& own = snapshot.driver_car;
    const Participant* car = find_participant(snapshot, own.participant);
    std::string around;
    for (const Participant& other : snapshot.participants) {
      const Vec2 away = seen_from(*car, other);
      if (other.id == car->id || away.x < -30.0 || away.x > 80.0 || std::abs(away.y) > 6.0) continue;
      const Vec3 heads = other.world_from_vehicle.orientation * Vec3(1, 0, 0);
      around += fmt::format(" {} ({:.0f} {:.1f} m, {:.1f} m/s, {:.1f} m/s2)", other.id, away.x, away.y,
                            glm::dot(other.velocity_mps, heads), glm::dot(other.acceleration_mps2, heads));
    }
    record.incidents.push_back(fmt::format(
        "{}, {:.1f} s: {}; {:.1f} m/s in lane {}, {:.2f} m left of its middle, s {:.0f} m; around:{}", name_,
        snapshot.simulated_time_s, what, own.speed_mps, own.lane, own.lateral_position_m, own.road_s_m, around));
  }

  std::string name_;
  std::shared_ptr<const simulation::Model> model_;
  std::deque<Instant> past_;
  std::optional<double> last_speed_mps_;
  bool is_noted_ = false, is_braking_hard_ = false, stands_ = false;
};

/// One drive, for the given time or until a collision.
inline DriveWatch watch_drive(const std::string& scenario, const std::string& driver, std::uint64_t seed,
                              double seconds) {
  const LoadedDrive loaded = shipped_drive(scenario, "seven-screens", seed);
  const auto drive = simulated_drive(loaded, driver, seed);
  DriveWatch watch(fmt::format("{} {} seed {}", scenario, driver, seed), loaded.model);
  while (watch.record.time_s < seconds - 1e-6 && !watch.has_collided()) {
    const auto tick = drive->next(std::nullopt);
    if (!tick || !*tick) break;  // The end of the road.
    watch.see(drive->newest());
  }
  return watch;
}

}  // namespace septet::server
