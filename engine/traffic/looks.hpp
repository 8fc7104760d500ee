#pragma once
/// What vehicles of traffic look like beyond what their driving depends on: models of one outline take each other's place.
///
/// Traffic drives a handful of models, of which it knows length, width and axles. Of vehicles with that outline a road shows many: among
/// saloons taxis, among lorries tankers and coaches. Who is which is a function of its id alone, so that nothing that drives depends on it.

#include "engine/world/snapshot.hpp"

namespace septet::traffic {

/// A model with `model`'s length, width, height, axles and mass: `model` itself for most.
ModelIndex look_of(ModelIndex model, ParticipantId id);

}  // namespace septet::traffic
