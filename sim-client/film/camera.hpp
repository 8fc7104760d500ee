#pragma once
/// A shot's camera at an instant: what it hangs on, and the view that follows from where it looks. Pure functions.

#include "sim-client/film/camera_path.hpp"
#include "sim-client/frame/client_frame.hpp"

namespace septet::film {

/// What a camera hangs on, for the whole shot.
struct Pivot {
  std::optional<ParticipantId> participant;  ///< None: a fixed place.
  Vec3 in_views_m{0.0};  ///< In the viewpoint's frame, whose origin is the participant's or the place.
};

/// Who a shot means, in the world at its beginning, and where on them the camera hangs: their eyes, or their middle if it is
/// outside. `driver_eye_m` is that of the rig that was driven with, vehicle frame. Error: there is nobody of that name, or the
/// camera would go below the road.
Expected<Pivot> find_pivot(const Shot& shot, const Snapshot& world, const Vec3& driver_eye_m,
                           const std::vector<Look>& path);

/// The frame in which the camera hangs and looks. Through a participant's eyes it sways with the vehicle; outside it stays level.
/// A participant that is gone is answered by `before`, which holds still.
frame::Viewpoint viewpoint_at(const Shot& shot, const Pivot& pivot, const Snapshot& world,
                              const frame::Viewpoint& before);

/// The view in that frame, for a picture of this size.
frame::ScreenViews views_at(const Shot& shot, const Pivot& pivot, const Look& look, std::uint32_t width_px,
                            std::uint32_t height_px);

}  // namespace septet::film
