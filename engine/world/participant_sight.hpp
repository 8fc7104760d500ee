#pragma once
/// Participants as eyes meet them: their boxes, how much of them hides what is behind, and where their own eyes are.
///
/// World frame, metres. Pure functions.

#include <optional>

#include "engine/sight/line_of_sight.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet {

/// The participant's box, without mirrors or limbs.
sight::Box box_of(const Participant& participant);

/// Height over the ground up to which a vehicle hides what is behind it: of a car to the lower edge of its windows, 0.93 m
/// as models are drawn, of who stands or rides nothing, of all others to the top.
double opaque_height_m(const VehicleModel& model);

/// That part of its box; empty where it hides nothing.
std::optional<sight::Box> opaque_box_of(const Participant& participant);

/// Eyes of who drives it, vehicle frame, in the middle of its width.
Vec3 driver_eyes_m(const VehicleModel& model);

}  // namespace septet
