#pragma once
/// From participants to placed meshes: wheels that turn, lamps that light, and the glow and pool of light around them.

#include <functional>
#include <span>
#include <vector>

#include "engine/instant/frame_input.hpp"
#include "engine/instant/scene_summary.hpp"

namespace septet::instant {

/// A lamp that shines now.
struct LampGlow {
  Vec3 position_m{0.0};    ///< World.
  bool beam = false;       ///< A headlamp, far brighter ahead than to its sides.
  glm::vec3 facing{0.0f};  ///< Unit, world axes; zero: all around.
  glm::vec3 color{1.0f};   ///< Emission of its material, radiance.
  float radius_m = 0.3f;
  double road_z_m = 0.0;   ///< World; of the road below it, which mirrors it when it is wet.
  float main_beam = 0.0f;  ///< Of a headlamp: how far its main beam is lit beside the dipped one, 0 to 1.
};

/// Where the headlights of one vehicle stand and point (engine/light/beam.hpp): near the eye each lamp's beam by itself, from further away the pair's as one.
struct Headlight {
  Vec3 position_m{0.0};                   ///< World; of a pair the middle between them.
  glm::vec3 direction{1.0f, 0.0f, 0.0f};  ///< Unit, world axes; the level from which the beam's angles count.
  float intensity = 0.0f;  ///< Where the dipped beam is brightest, of a pair both together, in units of 8000 cd.
  float main_beam = 0.0f;  ///< How far the main beam is lit beside the dipped one, 0 to 1.
};

/// A beacon that flashes now and lights what is around it (engine/light/beacon.hpp).
struct BeaconLight {
  Vec3 position_m{0.0};  ///< World.
  /// On the level, by colour: the emission of its lens, not dimmed as a lens that is shown, times the mean area of its
  /// sides.
  glm::vec3 intensity{0.0f};
  glm::vec2 ahead{1.0f, 0.0f};  ///< Of its vehicle, unit, on the level.
};

/// A body that stands on the ground and hides the sky from it: a box above its footprint.
struct GroundContact {
  RigidTransform world_from_body;  ///< The footprint's middle, on the ground; x along it.
  float half_length_m = 0.0f, half_width_m = 0.0f, height_m = 0.0f;
  float clearance_m = 0.1f;  ///< Below it.
  float share_of_sky = 1.0f;
};

struct PlacedParticipants {
  std::vector<PlacedMesh> meshes;  ///< Ordered by mesh.
  std::vector<LampGlow> glows;
  std::vector<Headlight> headlights;
  std::vector<BeaconLight> beacons;
};

/// What an eye or a film takes in at once, s: a flash that is shorter is seen as bright as its share of that.
inline constexpr double taken_in_s = 0.04;

/// How much of its light the lamp of this role sends out, 0 to 1. Lamps of vehicle state are on or off; beacons flash with time, those to the left and to
/// the right of the vehicle's middle in turn: two pulses of 60 ms, twice a second, as the mean over `taken_in_s` around the instant, so
/// that pictures 40 ms apart have all of their light between them, whenever they are taken.
float shining(scene::PartRole role, Lamps lamps, double simulated_time_s, double beacon_y_m);

/// Where a part stands in its vehicle now: steered, rolled and lifted.
RigidTransform vehicle_from_part(const scene::Instance& part, const DrawnParticipant& participant);

/// Parts that cannot be seen from around `eye_m`, for their level of detail, are left out; lamps glow where they are seen.
/// `share_of_sky` answers for a participant that stands so.
PlacedParticipants place_participants(
    std::span<const DrawnParticipant> participants, std::span<const scene::Prototype> prototypes,
    std::span<const MeshSummary> meshes, double simulated_time_s, const Vec3& eye_m,
    const std::function<float(const RigidTransform& world_from_vehicle)>& share_of_sky);

}  // namespace septet::instant
