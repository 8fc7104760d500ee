#pragma once
/// Viewpoint of an instant: a participant's eyes, or a place beside them.

#include <optional>
#include <string>

#include "engine/world/snapshot.hpp"

namespace septet::frame {

struct Viewpoint {
  RigidTransform world_from_views;      ///< Frame of the views' eyes and axes: a vehicle's, or that of any place.
  std::optional<ParticipantId> inside;  ///< Vehicle of the eyes: its inside, shadow and light are drawn.
};

/// Viewpoint of the driver, in the frame of his car; of the first participant if the snapshot has no driver.
Viewpoint driver_viewpoint(const Snapshot& shown);

/// Viewpoint of a rig's screens at somebody's eyes: the rig's eye point, `rig_eye_m` in the frame of its car, lies at
/// theirs, and its axes are those of their vehicle. Empty: they are not there.
std::optional<Viewpoint> viewpoint_of(const Snapshot& shown, ParticipantId participant, const Vec3& rig_eye_m);

/// Somebody at whose eyes a replay's screens stand.
struct Eyes {
  ParticipantId participant = 0;
  std::string name;  ///< In words, for the caption.
};

}  // namespace septet::frame
