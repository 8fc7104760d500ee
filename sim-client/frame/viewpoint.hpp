#pragma once
/// Through whose eyes an instant is seen, or from which place beside them.

#include <optional>

#include "engine/world/snapshot.hpp"

namespace septet::frame {

struct Viewpoint {
  RigidTransform world_from_views;  ///< The frame of the views' eyes and axes: a vehicle's, or that of any place.
  std::optional<ParticipantId>
      inside;  ///< Whose eyes they are: of that vehicle its inside is drawn, its shadow and its light.
};

/// The driver's, in the frame of his car; where the snapshot has none, those of the first participant.
Viewpoint driver_viewpoint(const Snapshot& shown);

/// Where who drives such a vehicle has the eyes, vehicle frame. The seats are on the left.
Vec3 eye_in(const VehicleModel& model);

}  // namespace septet::frame
