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
  glm::vec3 facing{0.0f};  ///< Unit, world axes; zero: all around.
  glm::vec3 color{1.0f};   ///< Emission of its material, radiance.
  float radius_m = 0.3f;
};

/// Where the headlights of one vehicle stand and point. They light what they reach where it is dark: at night, under roofs by day.
struct Headlight {
  Vec3 position_m{0.0};                   ///< World.
  glm::vec3 direction{1.0f, 0.0f, 0.0f};  ///< Unit, world axes.
  /// Along the axis, in units of 8000 cd. A hundred times a real dipped beam's, for nights are exposed as bright rooms are.
  float intensity = 240.0f;
};

struct PlacedParticipants {
  std::vector<PlacedMesh> meshes;  ///< Ordered by mesh.
  std::vector<LampGlow> glows;
  std::vector<Headlight> headlights;
};

/// Does the lamp of this role shine? Lamps of vehicle state; beacons flash with time, those to the left and to the right of
/// the vehicle's middle in turn: two pulses of 60 ms, twice a second.
bool shines(scene::PartRole role, Lamps lamps, double simulated_time_s, double beacon_y_m);

/// Where a part stands in its vehicle now: steered, rolled and lifted.
RigidTransform vehicle_from_part(const scene::Instance& part, const DrawnParticipant& participant);

/// Parts that cannot be seen from around `eye_m`, for their level of detail, are left out; lamps glow where they are seen.
/// `share_of_sky` answers for the place of a participant.
PlacedParticipants place_participants(std::span<const DrawnParticipant> participants,
                                      std::span<const scene::Prototype> prototypes, std::span<const MeshSummary> meshes,
                                      double simulated_time_s, const Vec3& eye_m,
                                      const std::function<float(const Vec3& place_m)>& share_of_sky);

}  // namespace septet::instant
