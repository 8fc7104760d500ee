#pragma once
/// A thing of the scene as a model's file, for a modelling program or another drive.

#include <string>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/scene/store.hpp"

namespace septet::server {

/// Bytes of a .glb: the object with all that hangs below it, as it is drawn from near by, around its own origin. Error:
/// it has no shape.
Expected<Bytes> exported_model(const scene::Store& store, scene::NodeId object, const std::string& name);

}  // namespace septet::server
