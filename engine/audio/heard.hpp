#pragma once
/// Sounds of one tick at the driver's ear, as plain data: the step from a snapshot to the numbers of the synthesis.
///
/// The ear frame is the vehicle frame moved to the driver's head: x forward, y left, z up. Quantities missing from a
/// snapshot are inferred: the load from the accelerator and the engine's speed (on the overrun fuel is cut), slips from
/// the motion of the axles against the wheels' turning, the ground from lane (0: beside the road), wetness and snow, an
/// impact from a velocity that jumps. Non-finite numbers are counted and become silence. Pure functions.

#include <cstdint>
#include <vector>

#include "engine/audio/ground_feel.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::audio {

/// Constants of the driver's car.
struct CarSound {
  int cylinders = 6;
  double idle_radps = 73.0;
  double wheelbase_m = 2.79;
  double wheel_radius_m = 0.32;
  double final_ratio = 3.29;
  Vec3 ear_m{1.4, 0.37, 1.15};  ///< Vehicle frame.
};

/// A box whose inside echoes, such as a stretch of a tunnel.
struct EchoBox {
  RigidTransform box_from_world;
  Vec3 min_m{0.0}, max_m{0.0};
};

/// The driver's car in one tick.
struct OwnCar {
  bool running = false;                      ///< True for an existing car with a running engine.
  double engine_hz = 0.0;                    ///< Turns a second.
  double load = 0.0;                         ///< Share of the full torque, 0 to 1.
  bool fuel_cut = false;                     ///< On the overrun there is no combustion.
  double speed_mps = 0.0;                    ///< Along the car, either sign.
  double air_mps = 0.0;                      ///< Against the air.
  double wheel_hz = 0.0;                     ///< Turns a second.
  double front_slip = 0.0, rear_slip = 0.0;  ///< Slip of the contact over the ground, as a share of the speed.
  double looseness = 0.0;                    ///< 0 on a paved road, 1 on gravel or grass.
  GroundFeel ground;                         ///< Default without roads: a good one, without lines.
  double wetness = 0.0, snow = 0.0;
  double rain_mm_per_h = 0.0;  ///< On the roof: 0 in a tunnel, 0 as snow.
  bool indicator_lit = false, horn = false, reversing = false;
  double blow_mps = 0.0;  ///< Change of velocity within this tick, beyond the tyres' limit; 0: no impact.
  /// Jolt of a kerb, a hole, a piece under a wheel: likewise of the vertical velocity alone, beyond a road's.
  double bump_mps = 0.0;
  int pieces = 0;          ///< Pieces broken off in this tick.
  double tunnel = 0.0;     ///< 0 in the open to 1 inside, over 20 m at its mouth.
  double low_share = 1.0;  ///< Share of the low frequencies, which may move a shaker: less while its output is cut.
};

/// Another participant in one tick.
struct OtherSound {
  ParticipantId id = 0;
  ParticipantKind kind = ParticipantKind::car;
  Vec3 position_m{0.0};  ///< Ear frame.
  double doppler = 1.0;  ///< Heard frequency over emitted one.
  double speed_mps = 0.0;
  double engine_hz = 0.0, load = 0.0;
  bool siren = false, horn = false;
  double siren_s = 0.0;  ///< Time in its siren's melody, sounding or not.
  double blow_mps = 0.0;
  double level_db = 0.0;  ///< dB(A) at the ear outside of the car, for choosing the loudest.
};

struct Heard {
  OwnCar car;
  std::vector<OtherSound> others;  ///< The loudest, ascending id.
  std::uint32_t bad_numbers = 0;   ///< Non-finite numbers in this tick.
};

inline constexpr std::size_t most_others = 16;
inline constexpr double speed_of_sound_mps = 343.3;

/// Heard over emitted frequency. Velocities in any one frame at rest in the air; `to_listener` points from source to
/// listener.
double doppler_factor(const Vec3& to_listener, const Vec3& source_mps, const Vec3& listener_mps);

/// `before` is the tick before, or null at the start and behind a gap.
Heard hear(const Snapshot& now, const Snapshot* before, const CarSound& car, const std::vector<EchoBox>& boxes,
           const GroundFeel& ground = {});

/// The vertical jolt of a body between two of its states: `OwnCar::bump_mps`.
double bump_mps(const Participant& now, const Participant& before, double seconds);

/// Jolts of the driver's car between two ticks: `OwnCar::blow_mps` and `bump_mps`.
struct Felt {
  double blow_mps = 0.0, bump_mps = 0.0;
};
Felt felt(const Snapshot& now, const Snapshot& before);

}  // namespace septet::audio
