#pragma once
/// Placed meshes of participants: wheels that turn, lamps that light, and the glow and pool of light around them.

#include <functional>
#include <span>
#include <vector>

#include "engine/instant/frame_input.hpp"
#include "engine/instant/scene_summary.hpp"

namespace septet::instant {

/// Lamp that is lit now.
struct LampGlow {
  Vec3 position_m{0.0};    ///< World.
  bool beam = false;       ///< Headlamp, far brighter ahead than to its sides.
  glm::vec3 facing{0.0f};  ///< Direction, unit, world axes; zero: all around.
  glm::vec3 color{1.0f};   ///< Emission of its material, radiance.
  float radius_m = 0.3f;
  double road_z_m = 0.0;   ///< World height of the road below it, which mirrors it when wet.
  float main_beam = 0.0f;  ///< Share to which a headlamp's main beam is lit in addition to the dipped one, 0 to 1.
};

/// Place and direction of a vehicle's headlight (engine/light/beam.hpp): near the eye one record a lamp, from further
/// away one for the pair.
struct Headlight {
  Vec3 position_m{0.0};  ///< World; for a pair the middle between the lamps.
  /// Direction, unit, world axes; the level from which the beam's angles count.
  glm::vec3 direction{1.0f, 0.0f, 0.0f};
  float intensity = 0.0f;  ///< Peak intensity of the dipped beam, for a pair that of both, in units of 8000 cd.
  float main_beam = 0.0f;  ///< Share to which the main beam is lit in addition to the dipped one, 0 to 1.
};

/// Beacon that flashes now and lights its surroundings (engine/light/beacon.hpp).
struct BeaconLight {
  Vec3 position_m{0.0};  ///< World.
  /// Horizontal intensity, by colour: the emission of its lens, not dimmed as for the shown lens, times the mean area
  /// of its sides.
  glm::vec3 intensity{0.0f};
  glm::vec2 ahead{1.0f, 0.0f};  ///< Heading of its vehicle, unit, on the level.
};

/// Body that stands on the ground and hides the sky from it: a box above its footprint.
struct GroundContact {
  RigidTransform world_from_body;  ///< Middle of the footprint, on the ground; x along it.
  float half_length_m = 0.0f, half_width_m = 0.0f, height_m = 0.0f;
  float clearance_m = 0.1f;  ///< Gap below the body.
  float share_of_sky = 1.0f;
};

struct PlacedParticipants {
  std::vector<PlacedMesh> meshes;  ///< Ordered by mesh.
  std::vector<LampGlow> glows;
  std::vector<Headlight> headlights;
  std::vector<BeaconLight> beacons;
};

/// Integration time of an eye or a film, s: a shorter flash appears as bright as its share of it.
inline constexpr double taken_in_s = 0.04;

/// Share of its light that the lamp of this role emits, 0 to 1. Lamps of vehicle state are on or off; beacons flash
/// with time, those to the left and to the right of the vehicle's middle in turn: two pulses of 60 ms, twice a second,
/// as the mean over `taken_in_s` around the instant, so that pictures 40 ms apart together hold all of their light,
/// whenever they are taken.
float shining(scene::PartRole role, Lamps lamps, double simulated_time_s, double beacon_y_m);

/// Pose of a part in its vehicle now: steered, rolled and lifted.
RigidTransform vehicle_from_part(const scene::Instance& part, const DrawnParticipant& participant);

/// Places participants. Parts that are invisible from around `eye_m`, by their level of detail, are left out; lamps
/// glow where they are visible. `share_of_sky` returns that of a participant at a pose.
PlacedParticipants place_participants(
    std::span<const DrawnParticipant> participants, std::span<const scene::Prototype> prototypes,
    std::span<const MeshSummary> meshes, double simulated_time_s, const Vec3& eye_m,
    const std::function<float(const RigidTransform& world_from_vehicle)>& share_of_sky);

}  // namespace septet::instant
