#pragma once
/// Viewpoint of an instant: a participant's eyes, or a place beside them.

#include <optional>

#include "engine/world/snapshot.hpp"

namespace septet::frame {

struct Viewpoint {
  RigidTransform world_from_views;      ///< Frame of the views' eyes and axes: a vehicle's, or that of any place.
  std::optional<ParticipantId> inside;  ///< Vehicle of the eyes: its inside, shadow and light are drawn.
};

/// Viewpoint of the driver, in the frame of his car; of the first participant if the snapshot has no driver.
Viewpoint driver_viewpoint(const Snapshot& shown);

/// Eye point of the driver of such a vehicle, vehicle frame. The seats are on the left.
Vec3 eye_in(const VehicleModel& model);

}  // namespace septet::frame
