#pragma once
/// Appearance of traffic's vehicles beyond the data of their driving: models of one outline replace each other.
///
/// Traffic drives a handful of models, of which it knows length, width and axles. A road shows many vehicles of one
/// outline: among saloons taxis, among lorries tankers and coaches. The appearance is a function of the id alone, so
/// that driving does not depend on it.

#include "engine/world/snapshot.hpp"

namespace septet::traffic {

/// A model with `model`'s length, width, height, axles and mass: `model` itself for most.
ModelIndex look_of(ModelIndex model, ParticipantId id);

}  // namespace septet::traffic
