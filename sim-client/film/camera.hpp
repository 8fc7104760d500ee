#pragma once
/// Camera of a film shot at an instant: its anchor (pivot) and the resulting view. Pure functions.

#include "logging/session/participants.hpp"
#include "sim-client/film/camera_path.hpp"
#include "sim-client/frame/client_frame.hpp"

namespace septet::film {

/// Anchor of the camera for the whole shot.
struct Pivot {
  std::optional<ParticipantId> participant;  ///< Empty: a fixed place.
  Vec3 in_views_m{0.0};  ///< Anchor in the viewpoint's frame, whose origin is the participant or the place.
  double least_above_ground_m = 0.0;  ///< Of a camera outside: so high the anchor stays over who has fallen.
};

/// Resolves the participant that a shot names, in the world at the shot's beginning, and the camera's anchor on them:
/// their eyes, or their middle if it is outside. `driver_eye_m` is the driver's eye of the session's rig, vehicle frame;
/// `names` are the session's. Error: no participant of that name, or the camera would go below the road.
Expected<Pivot> find_pivot(const Shot& shot, const Snapshot& world, const Vec3& driver_eye_m,
                           const std::vector<Look>& path, const logging::ParticipantNames& names);

/// Frame in which the camera is placed and looks. Through a participant's eyes it sways with the vehicle; outside it
/// stays level and above the ground, also about a person who is thrown and lies. For a participant that is gone it returns `before`, so the camera holds still.
frame::Viewpoint viewpoint_at(const Shot& shot, const Pivot& pivot, const Snapshot& world,
                              const frame::Viewpoint& before);

/// View in that frame, for a picture of this size.
frame::ScreenViews views_at(const Shot& shot, const Pivot& pivot, const Look& look, std::uint32_t width_px,
                            std::uint32_t height_px);

}  // namespace septet::film
