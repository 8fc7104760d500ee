#pragma once
/// The members of a rigid transform, for engine/core/archive.hpp.

#include "engine/core/archive.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet {

SEPTET_MEMBERS(RigidTransform, position_m, orientation)

}  // namespace septet
