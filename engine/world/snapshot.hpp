#pragma once
/// The snapshot: everything a screen, a log or a film needs to show one instant of the world.
///
/// The server takes one per tick after its last stage; from then on it is const. Poses are in the world frame, double
/// precision; the codec (wire_snapshot.hpp) quantises them with stated bounds.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/world/driver_input.hpp"
#include "engine/world/lamps.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet {

using ParticipantId = std::uint32_t;
using Tick = std::uint64_t;

/// The state of one rigid participant, sufficient to draw it between two ticks.
struct Participant {
  ParticipantId id = 0;
  ModelIndex model = 0;
  std::uint8_t paint = 0;  ///< Index into the palette of body colours.
  Lamps lamps;
  RigidTransform world_from_vehicle;
  Vec3 velocity_mps{0.0};            ///< Velocity of the origin, world frame.
  Vec3 acceleration_mps2{0.0};       ///< World frame.
  Vec3 angular_velocity_radps{0.0};  ///< World frame.
  double front_steer_rad = 0.0;      ///< Mean road-wheel angle of the front axle, positive to the left.
  /// Rolling angle of the wheels, in [0, 2π); phase of the step of a walking person (limbs.hpp).
  double wheel_spin_rad = 0.0;
  double wheel_spin_radps = 0.0;
  /// Height of each wheel's centre over rest (front left, right, rear left, right); ThrownJoints of a thrown pedestrian.
  std::array<double, 4> wheel_lift_m{};
};

/// Data for the driver's instruments, actuators and logs beyond the car's Participant.
struct DriverCar {
  ParticipantId participant = 0;
  double speed_mps = 0.0;  ///< Along the car's x axis.
  double engine_radps = 0.0;
  std::int8_t gear = 0;
  double steering_wheel_rad = 0.0;
  double steering_torque_nm = 0.0;  ///< Torque at the hand wheel, positive turns it to the left.
  double accelerator = 0.0, brake = 0.0, clutch = 0.0;
  double yaw_rate_radps = 0.0;
  double gaze_heading_rad = 0.0;
  // Position of the car on the road; lane 0 means off every lane.
  std::uint32_t road = 0;  ///< Index in the road network.
  std::int32_t lane = 0;   ///< OpenDRIVE lane id.
  double road_s_m = 0.0;
  double lateral_position_m = 0.0;  ///< From the centre of the lane, positive to the left as the driver sees it.
  double lane_width_m = 0.0;
  Head head;  ///< The same for all screens of the rig.
};

/// Weather and light (OpenSCENARIO 1.3 Environment).
struct Environment {
  double sun_azimuth_rad = 4.0;  ///< OpenSCENARIO: clockwise from north, 0 to 2π.
  double sun_elevation_rad = 0.7;
  double sun_illuminance_lux = 80000.0;
  double visibility_m = 20000.0;  ///< Meteorological range of the fog.
  double cloud_cover = 0.2;       ///< 0 to 1.
  double rain_mm_per_h = 0.0;     ///< Rain as water; below 274.65 K it falls as snow.
  double road_wetness = 0.0;      ///< 0 dry to 1 standing water.
  double snow_cover = 0.0;        ///< 0 to 1.
  double temperature_k = 288.15;
  double wind_speed_mps = 0.0;
  double wind_direction_rad = 0.0;  ///< Towards, counter-clockwise from x.

  bool operator==(const Environment&) const = default;
};

/// Keyframe of one effect (smoke, debris, …): opaque here, decoded by the effect that wrote it. It stays in the
/// snapshots, unchanged, until the effect's next one replaces it, so that a resting effect costs nothing and a late
/// joiner has it.
struct EffectKeyframe {
  std::uint32_t id = 0;
  std::uint16_t kind = 0;
  Bytes data;
  Tick tick = 0;  ///< Its instant; effects are simulated a little ahead, so it may lie in the future.
  bool operator==(const EffectKeyframe&) const = default;
};

/// Numbers that became NaN or infinite and were reset, since the start.
struct Diagnostics {
  std::uint32_t bad_numbers = 0;
  std::uint32_t collisions = 0;
  std::uint32_t input_stale_ticks = 0;
  bool operator==(const Diagnostics&) const = default;
};

enum class GameEnd : std::uint8_t { none, lost, crash, time };

/// Standing of a game (engine/simulation/game.hpp).
struct GameStanding {
  std::uint32_t level = 1;
  GameEnd end = GameEnd::none;
  double points = 0.0;
  double survived_s = 0.0;
  double leader_m = 0.0;  ///< Distance from the driver's car to its leader.
  double away_s = 0.0;    ///< Time for which the leader has been too far away.
  bool operator==(const GameStanding&) const = default;
};

struct Snapshot {
  Tick tick = 0;
  double simulated_time_s = 0.0;
  std::uint64_t state_hash = 0;
  Environment environment;
  DriverCar driver_car;
  std::vector<Participant> participants;  ///< Ascending id.
  std::vector<EffectKeyframe> effects;    ///< Ascending id.
  Diagnostics diagnostics;
  std::optional<GameStanding> game;  ///< Present where the scenario is played as a game.
};

/// The participant with this id, or null. `participants`: ascending id. Logarithmic time.
const Participant* find_participant(const std::vector<Participant>& participants, ParticipantId id);
Participant* find_participant(std::vector<Participant>& participants, ParticipantId id);
const Participant* find_participant(const Snapshot& snapshot, ParticipantId id);

}  // namespace septet
