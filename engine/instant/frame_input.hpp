#pragma once
/// Content that one frame shows of a snapshot: participants, effects, weather and views, as plain data from which
/// `describe` (instant.hpp) makes the description of the instant.
///
/// World frame, metres, radians, seconds of simulated time. The same FrameInput gives the same description.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/instant/ice_body.hpp"
#include "engine/instant/mirror_glass.hpp"
#include "engine/instant/view.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::instant {

/// Shown part of a participant. The driver's car in the rig is a real one: only its shadow and the pool of its
/// headlights are drawn.
enum class Shown : std::uint8_t { whole, shadow_and_light };

/// Meshes that replace those of a prototype's parts, one a part, such as a body with dents. Null: the part keeps its
/// own; one without triangles: the part is not there, and its lamp does not shine.
using ReshapedParts = std::vector<std::shared_ptr<const scene::SurfaceMesh>>;

/// Participant as the frame shows it: interpolated pose, appearance, lit lamps, wheels.
struct DrawnParticipant {
  std::uint32_t prototype = 0;  ///< Indexes ResolvedScene::prototypes; not drawn until the prototype is there.
  RigidTransform world_from_vehicle;
  glm::vec3 paint{1.0f};  ///< Linear Rec. 709.
  Lamps lamps;
  double front_steer_rad = 0.0;
  double wheel_spin_rad = 0.0;
  std::array<double, 4> wheel_lift_m{};  ///< Front left, front right, rear left, rear right.
  std::array<double, 4> thrown_rad{};    ///< Joints of a person who was thrown (ThrownJoints, limbs.hpp).
  glm::vec3 stretch{1.0f};               ///< Of its prototype, along its axes: a box (participant_shape.hpp).
  double speed_mps = 0.0;                ///< Pedestrians swing their limbs by it.
  double steering_wheel_rad = 0.0;       ///< Turns the part about its object's x axis, positive to the left.
  Shown shown = Shown::whole;
  std::shared_ptr<const ReshapedParts> reshaped;  ///< Null: shape of its prototype.
  std::uint32_t number = 0;                       ///< Distinguishes it from others by its number plate.
  // Causes of the spray that it raises (spray.hpp).
  Vec3 velocity_mps{0.0};  ///< World frame.
  double yaw_rate_radps = 0.0;
  double tail_x_m = -0.8;  ///< Rear end, vehicle frame.
  bool heavy = false, raises_spray = false;
};

/// Triangles of this instant alone, such as debris between two keyframes. They cast shadows and are culled as a whole.
struct DynamicMesh {
  /// The material is that of its first part; not drawn if there is no such prototype.
  std::uint32_t prototype = 0;
  Vec3 origin_m{0.0};                     ///< World.
  float radius_m = 0.0f;                  ///< Around the origin.
  glm::vec3 paint{1.0f};                  ///< Linear Rec. 709, for materials that take it.
  std::optional<std::uint32_t> material;  ///< In the stead of the prototype's: indexes ResolvedScene::materials.
  std::uint32_t number = 0;               ///< Of the participant whose number plate it shows.
  bool seen = true;  ///< False: casts a shadow only, because something else draws it (FrameInput::ice).
  std::vector<scene::SurfaceVertex>
      vertices;  ///< Relative to the origin along the world's axes; three a triangle, ccw in front.
};

/// Radiance of an opaque flame of full glow; a glow of g has g² of it.
inline constexpr glm::vec3 flame_radiance{9.0f, 3.4f, 0.7f};

/// Ball of smoke whose density falls off as a Gaussian.
struct SmokePuff {
  Vec3 position_m{0.0};             ///< World.
  float radius_m = 0.5f;            ///< Standard deviation of the density.
  float extinction_area_m2 = 0.0f;  ///< Optical depth through its middle is this over 2π radius².
  glm::vec3 albedo{0.25f};          ///< Albedo of its scattering, linear Rec. 709.
  float glow = 0.0f;                ///< Share of flame in it, 0 to 1.
  std::uint32_t seed = 0;           ///< Turns its pattern.
};

/// Cover of surfaces by soot in a box of cells, interpolated between them. Zero outside.
struct SootField {
  RigidTransform world_from_field;  ///< Origin at the lower corner.
  double cell_m = 1.0;
  int nx = 0, ny = 0, nz = 0;
  std::vector<std::uint8_t> cover;  ///< Share of the light that is absorbed, in 1/255; x runs fastest.
};

/// Line of text over the picture.
struct OverlayText {
  std::string text;                ///< UTF-8.
  float x_px = 0.0f, y_px = 0.0f;  ///< Upper left of the line's box, in the target; its middle if `centered`.
  float height_px = 18.0f;         ///< Height of one line.
  glm::vec4 color{1.0f};           ///< sRGB and opacity.
  glm::vec4 background{0.0f};      ///< sRGB and opacity of the box behind the text.
  float least_box_px = 0.0f;       ///< Least width of the box.
  bool centered = false;
};

struct FrameInput {
  double simulated_time_s = 0.0;  ///< Moves clouds and flashes beacons.
  Environment environment;
  std::vector<FrameView> views;
  std::vector<MirrorGlass> mirrors;  ///< Mirrors in the first view; their pictures lie beside each other.
  std::vector<DrawnParticipant> participants;
  std::vector<DynamicMesh> meshes;
  /// Transparent bodies; the shadow is cast by a mesh of the same shape that is not `seen`.
  std::vector<ice::IceBody> ice;
  std::vector<ice::IceBody> glass;         ///< Frost and cracks on panes: bodies with Look::on_glass.
  std::uint32_t ice_surroundings_px = 64;  ///< Side of each of the six pictures of its surroundings.
  /// Keeps the surroundings of the frame before, if there are any, since the world stands still.
  bool ice_surroundings_kept = false;
  std::vector<SmokePuff> smoke;
  SootField soot;
  std::vector<OverlayText> overlay;
};

/// Drawn form of a participant in a snapshot (or between two of them).
DrawnParticipant drawn_participant(const Participant& participant, std::uint32_t prototype);

}  // namespace septet::instant
